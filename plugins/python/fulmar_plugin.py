# SPDX-License-Identifier: BSD-3-Clause
"""Messages, ports, parameters and status for components in Python.

    import fulmar_plugin as f

    class MyLaw:
        class Inputs:  state = f.In("VehicleState"); command = f.In("GuidanceCommand")
        class Outputs: attitude = f.Out("AttitudeCommand"); height_error_m = f.Probe()
        class Params:  course_kp = f.Param(1.2, "rad/rad", 0, 5, "roll per course error")
        def step(self, tick, inp, p, out): ...

The plugin `python`, which hosts scripts, makes this module; names that begin with _ are internal.
"""
import collections
import ctypes
import enum
import math
from ctypes import c_bool, c_char, c_double, c_int64, c_uint8, c_uint32, c_uint64

from fulmar_plugin_texts import choices as _choices, text as _text

unknown_std = 1e9  # unknown standard deviation


class Status(enum.IntEnum):
    ok = 0
    degraded = 1
    failed = 2


ok, degraded, failed = Status


def wrap_pi(angle_rad):
    """The same angle in [-pi, pi]."""
    return angle_rad if abs(angle_rad) <= math.pi else math.remainder(angle_rad, 2 * math.pi)


def clamp(x, low, high):
    return low if x < low else high if x > high else x


class DeclarationError(Exception):
    """An invalid component or message; `path` leads to it: ("MyLaw", "Inputs", "state")."""

    def __init__(self, path, sentence):
        super().__init__(".".join(path) + ": " + sentence)
        self.path = path


# ---- messages ------------------------------------------------------------------------------------------------------------------

f32, u8, i32, u32, i64, u64 = ctypes.c_float, c_uint8, ctypes.c_int32, c_uint32, c_int64, c_uint64

# numbers of fulmar_kind and fulmar_shape (fulmar/abi.h)
_SCALARS = {bool: (1, c_bool), c_bool: (1, c_bool), u8: (2, u8), i32: (3, i32), u32: (4, u32), int: (5, i64), i64: (5, i64), u64: (6, u64),
            f32: (7, f32), float: (8, c_double), c_double: (8, c_double)}
_CTYPES = {kind: element for kind, element in _SCALARS.values()}
_F32, _F64, _ENUM, _TEXT, _STRUCT = 7, 8, 9, 10, 11
_SCALAR, _ARRAY, _LIST = 0, 1, 2
_units = []  # (suffix, printed, min, max): the rules of fulmar/detail/units.hpp, set by the plugin
_Element = collections.namedtuple("_Element", "kind ctype type labels")
_Field = collections.namedtuple("_Field", "name unit kind shape offset count stride items min max labels type")


class Text:
    """In a message: text of at most size - 1 bytes."""

    def __init__(self, size):
        self.size = size


class Array:
    """In a message: always `count` elements."""

    def __init__(self, element, count):
        self.element, self.count = element, count


class List:
    """In a message: at most `capacity` items; only `count` items are logged and sent."""

    def __init__(self, element, capacity):
        self.element, self.count = element, capacity


class _Items(ctypes.Structure):
    """A list in a message: `count` and `items`."""
    __slots__ = ()

    def __len__(self):
        return self.count

    def __getitem__(self, i):
        if not -self.count <= i < self.count:
            raise IndexError(f"item {i} of {self.count}")
        return self.items[i % self.count]

    def __iter__(self):
        return (self.items[i] for i in range(self.count))

    def append(self, item):
        if self.count == len(self.items):
            raise IndexError(f"the list is full: {self.count} items")
        self.items[self.count] = item
        self.count += 1

    def clear(self):
        self.count = 0

    def numpy(self):
        """The first `count` items, as a view."""
        import numpy
        return numpy.ctypeslib.as_array(self.items)[:self.count]


class _MessageType(type(ctypes.Structure)):
    def __new__(mcs, name, bases, body):
        described = body.pop("_described_", None)
        defaults = {}
        if "_fields_" not in body and bases != (ctypes.Structure,):
            described, defaults = _declare(name, body)
        body.setdefault("__slots__", ())
        cls = super().__new__(mcs, name, bases, body)
        if described is not None:
            cls._message = cls
            cls._described = [f._replace(offset=getattr(cls, _raw(f)).offset) for f in described]
            cls._table = 0
            cls._initial = _initial(cls, defaults)
        return cls


class Message(ctypes.Structure, metaclass=_MessageType):
    """Base of every message. Example: class Wobble(f.Message): amplitude_rad: float = 0.1"""
    _initial = b""

    def __init__(self, *values, **named):
        ctypes.memmove(ctypes.addressof(self), self._initial, len(self._initial))
        super().__init__(*values, **named)

    def copy(self):
        """A separate message: the message of a port changes with the next sample."""
        other = self._message()
        ctypes.memmove(ctypes.addressof(other), ctypes.addressof(self), ctypes.sizeof(other))
        return other

    def set(self, other):
        """Copies every field of a message of the same type, or the elements of a sequence."""
        if isinstance(other, self._message):
            ctypes.memmove(ctypes.addressof(self), ctypes.addressof(other), ctypes.sizeof(self._message))
        else:
            for field, value in zip(self._described, other, strict=True):
                setattr(self, field.name, value)

    def numpy(self):
        """A view: a structured scalar (state["roll_rad"]), or the elements of a vector or quaternion."""
        import numpy
        if self._message in (Ned, Body, Quat):
            return numpy.frombuffer(self, numpy.float64, ctypes.sizeof(self._message) // 8)
        return numpy.ndarray((), numpy.dtype(self._message), self)

    def __iter__(self):
        return (getattr(self, f.name) for f in self._described)

    def __eq__(self, other):
        return isinstance(other, Message) and self._message is other._message and \
            ctypes.string_at(ctypes.addressof(self), ctypes.sizeof(self._message)) == \
            ctypes.string_at(ctypes.addressof(other), ctypes.sizeof(self._message))

    __hash__ = None

    def __repr__(self):
        return self._message.__name__ + "(" + ", ".join(f"{f.name}={getattr(self, f.name)!r}" for f in self._described) + ")"


def _raw(field):
    """A text is stored under another name than the property that converts it to str."""
    return "_" + field.name if field.kind == _TEXT else field.name


def _text_property(name, size):
    raw = "_" + name

    def write(self, value):
        setattr(self, raw, value.encode()[:size - 1])

    return property(lambda self: getattr(self, raw).decode(errors="replace"), write)


def _body(fields):
    """Class body of a message: ctypes fields, text properties, one enum per enumerated field: Path.Kind.orbit."""
    body = {"_fields_": [], "_described_": [f for f, _ in fields]}
    for field, element in fields:
        ctype = element.ctype
        if field.shape == _ARRAY:
            ctype = ctype * field.count
        elif field.shape == _LIST:
            ctype = type("Items", (_Items,), {"__slots__": (), "_fields_": [("count", c_uint32), ("items", ctype * field.count)]})
            field = field._replace(items=ctype.items.offset)
            body["_described_"] = [field if f.name == field.name else f for f in body["_described_"]]
        body["_fields_"].append((_raw(field), ctype))
        if field.kind == _TEXT:
            body[field.name] = _text_property(field.name, field.stride)
        if field.labels:
            body[field.name.title().replace("_", "")] = enum.IntEnum(field.name, field.labels, start=0)
    return body


def _declare(name, body):
    """Converts the annotations of a class to fields, by the rules of C++ messages."""
    foreign = isinstance(body.get("ros_type"), str)
    annotations = body.pop("__annotations__", {})
    if not annotations:
        raise DeclarationError((name,), _text("fields_missing"))
    scope = dict(globals())
    module = __import__("sys").modules.get(body.get("__module__"))
    scope.update(vars(module) if module else {})
    fields, defaults = [], {}
    for key, kind in annotations.items():
        kind = eval(kind, scope) if isinstance(kind, str) else kind  # from __future__ import annotations
        shape = _ARRAY if isinstance(kind, Array) else _LIST if isinstance(kind, List) else _SCALAR
        element = _element((name, key), kind.element if shape != _SCALAR else kind)
        needs_unit = not foreign and (element.kind in (_F32, _F64) or element.ctype in (Ned, Body))
        unit, low, high = _unit((name, key), element, needs_unit)
        fields.append((_Field(key, unit, element.kind, shape, 0, kind.count if shape != _SCALAR else 1, ctypes.sizeof(element.ctype), 0, low,
                              high, element.labels, element.type), element))
        if key in body:
            defaults[key] = body.pop(key)
    described = _body(fields)
    body.update({k: v for k, v in described.items() if k != "_described_"})
    return described["_described_"], defaults


def _element(path, kind):
    if isinstance(kind, Text):
        return _Element(_TEXT, c_char * kind.size, None, None)
    if isinstance(kind, type) and issubclass(kind, enum.IntEnum):
        if [e.value for e in kind] != list(range(len(kind))):
            raise DeclarationError(path, _text("enum_values_invalid", kind.__name__))
        return _Element(_ENUM, u8, None, [e.name for e in kind])
    if isinstance(kind, type) and issubclass(kind, Message) and kind is not Message:
        return _Element(_STRUCT, kind, kind, None)
    if isinstance(kind, type) and kind in _SCALARS:
        number, ctype = _SCALARS[kind]
        return _Element(number, ctype, None, None)
    raise DeclarationError(path, _text("field_type_invalid", repr(kind)))


def _unit(path, element, needed):
    """(unit, min, max) for the suffix of the name."""
    name = path[-1]
    for suffix, printed, low, high in _units:
        if name.endswith(suffix) and len(name) > len(suffix):
            if needed:
                return printed, low, high
            return (printed if suffix == "_ns" and element.kind in (5, 6) else ""), -math.inf, math.inf
    if needed:
        raise DeclarationError(path, _text("unit_missing", " ".join(u[0] for u in _units)))
    return "", -math.inf, math.inf


def _initial(cls, defaults):
    """The bytes of a new message: its defaults, and those of its nested messages."""
    buffer = bytearray(ctypes.sizeof(cls))
    for f in cls._described:
        if f.type:
            for i in range(f.count):
                at = f.offset + f.items + i * f.stride
                buffer[at:at + f.stride] = f.type._initial
    cls._initial = bytes(buffer)
    return bytes(cls(**defaults)) if defaults else cls._initial


_shared = {}


def _share(tables):
    """Makes the classes of the messages of the plugin. `tables`: dicts, a nested type before the type that holds it."""
    classes = []
    for t in tables:
        fields = []
        for f in map(_Field._make, t["fields"]):
            nested = classes[f.type] if f.type is not None else None
            ctype = nested or (c_char * f.stride if f.kind == _TEXT else u8 if f.kind == _ENUM else _CTYPES[f.kind])
            fields.append((f._replace(type=nested), _Element(f.kind, ctype, nested, f.labels)))
        name = {"Vec3Ned": "Ned", "Vec3Body": "Body"}.get(t["name"], t["name"])
        cls = _MessageType(name, (Message,), {"__module__": __name__, **_body(fields)})
        if ctypes.sizeof(cls) != t["size"] or [f.offset for f in cls._described] != [f[4] for f in t["fields"]]:
            raise RuntimeError(f"{name} has another layout in Python")
        cls._table = t["table"]
        if t["initial"] is not None:
            cls._initial = t["initial"]
        classes.append(cls)
        globals()[name] = cls
        if name not in ("Ned", "Body", "Quat"):
            _shared[name] = cls


def _message(path, kind, scope):
    if isinstance(kind, type) and issubclass(kind, Message) and kind is not Message:
        return kind
    if not isinstance(kind, str):
        raise DeclarationError(path, _text("message_type_invalid", repr(kind)))
    own = scope.get(kind)
    if kind in _shared:
        return _shared[kind]
    if isinstance(own, type) and issubclass(own, Message):
        return own
    raise DeclarationError(path, _text("message_unknown", kind, _choices(kind, sorted(_shared))))


# ---- ports ---------------------------------------------------------------------------------------------------------------------

class _Port:
    flags, capacity = 0, 1

    def __init__(self, message):
        self.message = message


class In(_Port):
    """The latest sample: inp.state.roll_rad, .fresh, .stale, .age_s, .valid_at_ns, .sequence. It exists whenever step is called."""
    kind = 1


class Optional(In):
    """As In, but step is called without it too: if inp.gnss and inp.gnss.fresh: ..."""
    flags = 1


class Queue(_Port):
    """Every sample since the last step: for edit in inp.edits: edit.kind, edit.valid_at_ns. len(), .lost."""
    kind, flags = 2, 1

    def __init__(self, message, capacity=64):
        self.message, self.capacity = message, capacity


class Request(Queue):
    """Requests, each answered in the step that reads it: for ask in inp.edit: ask.accept() or ask.refuse("no such waypoint")."""
    kind = 3

    def __init__(self, message, capacity=16):
        super().__init__(message, capacity)


class Out(_Port):
    """Published in every step: out.attitude.roll_rad = 0.1"""
    kind = 17


class Event(_Port):
    """May be left unpublished: out.plan.publish(plan), out.plan.publish(plan, valid_at_ns), or fill it and call out.plan.publish()."""
    kind = 18


class OutQueue(_Port):
    """None, one or several per step: out.edits.push(edit), out.edits.push(edit, valid_at_ns)."""
    kind = 19

    def __init__(self, message, capacity=16):
        self.message, self.capacity = message, capacity


class Probe:
    """One number for the log: out.roll_error_rad = e. Its name ends in its unit."""
    kind, flags, capacity, message = 20, 0, 1, None


# ---- parameters ----------------------------------------------------------------------------------------------------------------

_REQUIRED, _LIVE = 2, 1


class _Param:
    """Common properties of all parameters, as far as their kind does not override them."""
    unit, text, choices, type, capacity, data, low, high = "", "", [], None, 0, None, 0.0, 0.0
    initial = (0.0, 0.0, 0.0)

    def _common(self, doc, setup=False):
        self.doc, self.flags = doc, 0 if setup else _LIVE


class Param(_Param):
    """A number: Param(1.2, "rad/rad", 0, 5, "roll per course error")."""
    kind = 1

    def __init__(self, value=0.0, unit="", min=-math.inf, max=math.inf, doc="", setup=False):
        self._common(doc, setup)
        self.unit, self.initial, self.low, self.high = unit, (float(value), 0.0, 0.0), float(min), float(max)


class Flag(_Param):
    kind, high = 2, 1.0

    def __init__(self, value=False, doc="", setup=False):
        self._common(doc, setup)
        self.initial = (1.0 if value else 0.0, 0.0, 0.0)


class Count(_Param):
    kind = 3

    def __init__(self, value=0, min=0, max=2**31 - 1, doc="", setup=False):
        self._common(doc, setup)
        self.initial, self.low, self.high = (float(value), 0.0, 0.0), float(min), float(max)


class Choice(_Param):
    """One of several names: Choice("hold", ["hold", "takeoff"]); p.law == "hold"."""
    kind = 4

    def __init__(self, value, choices, doc="", setup=False):
        self._common(doc, setup)
        self.choices = list(choices)
        if value not in self.choices:
            raise ValueError(f"'{value}' is none of the choices {', '.join(self.choices)}")
        self.initial, self.high = (float(self.choices.index(value)), 0.0, 0.0), len(self.choices) - 1.0


class TextParam(_Param):
    kind = 5

    def __init__(self, value="", size=64, doc=""):
        self._common(doc, True)
        self.text, self.capacity = value, size


class Vector(_Param):
    """A vector of a frame: Vector((3, -4, 0), "ned", "m/s", -30, 30); p.wind.north."""
    kind = 6

    def __init__(self, value=(0, 0, 0), frame="ned", unit="", min=-math.inf, max=math.inf, doc="", setup=False):
        self._common(doc, setup)
        self.unit, self.initial, self.low, self.high = unit, tuple(map(float, value)), float(min), float(max)
        if frame not in ("ned", "body"):
            raise ValueError(f"'{frame}' is no frame. Valid: ned, body")
        self.type = Ned if frame == "ned" else Body


class Record(_Param):
    """A YAML file that the host reads into a message: Record("Airframe"); p.airframe.mass_kg, p.airframe.given."""
    kind = 7

    def __init__(self, message, doc="", required=False):
        self.doc, self.flags, self.message = doc, _REQUIRED if required else 0, message


class Blob(_Param):
    """The bytes of a file: p.table.data, p.table.name, p.table.given."""
    kind = 8

    def __init__(self, doc="", required=False):
        self.doc, self.flags = doc, _REQUIRED if required else 0
