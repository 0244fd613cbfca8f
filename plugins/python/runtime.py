# SPDX-License-Identifier: BSD-3-Clause
"""Python side of the plugin: opens a script, describes its components, makes their instances, explains their exceptions.

Ports are ctypes structures at fixed addresses. The plugin copies samples in before a call and results out after it; Python reads and
writes this memory without new objects. The data behind a message (_META, ...) has the layout of the structs in instance.hpp.
"""
import ast
import collections
import ctypes
import gc
import inspect
import linecache
import os
import sys
import traceback
import types
from ctypes import c_bool, c_char, c_double, c_int64, c_uint32, c_uint64

import fulmar_plugin as f

_META = [("valid_at_ns", c_int64), ("age_s", c_double), ("sequence", c_uint64), ("fresh", c_bool), ("stale", c_bool), ("present", c_bool)]
_ITEM_META = [("valid_at_ns", c_int64), ("_verdict", c_uint32), ("_reason", c_char * 124)]
_EVENT_META = [("_valid_at_ns", c_int64), ("_written", c_bool), ("_dated", c_bool)]


class Tick(ctypes.Structure):
    """One pass of the loop. Time is flight time, 0 at the first armed tick; dt is the time since this component's previous step."""
    __slots__ = ()
    _fields_ = [("now_ns", c_int64), ("dt_ns", c_int64), ("index", c_uint64), ("now_s", c_double), ("dt_s", c_double)]


class _Head(ctypes.Structure):
    _fields_ = [("count", c_uint32), ("lost", c_uint32)]


def _view(message, meta, members):
    """A message with the port's properties of its sample. A field of the message of the same name has priority: fresh is then fresh_."""
    names = {d.name for d in message._described}
    fields = [(name + "_" if name in names else name, kind) for name, kind in meta]
    view = type(f.Message)(message.__name__, (message,), {"__slots__": ("_array",), "_fields_": fields, **members})
    return view, getattr(view, fields[0][0]).offset


def _cached_numpy(self):
    """The view of a port's message: made once, valid for every sample."""
    try:
        return self._array
    except AttributeError:
        self._array = f.Message.numpy(self)
        return self._array


def _accept(self):
    self._verdict = 1


def _fitting(words, room):
    """As fit_words() of the SDK: a text that does not fit ends in dots after a whole word or character."""
    if len(words) < room:
        return words
    cut = words[: room - 4].decode(errors="ignore")
    head, _, _ = (cut + words[room - 4 : room - 3].decode(errors="ignore")).rpartition(" ")
    return (head if len(head.encode()) > room // 2 else cut).encode() + b"..."


def _refuse(self, reason):
    self._verdict = 2
    self._reason = _fitting(reason.encode(), 124)


def _publish(self, message=None, valid_at_ns=None):
    if message is not None and message is not self:
        self.set(message)
    self._written = True
    self._dated = valid_at_ns is not None
    if valid_at_ns is not None:
        self._valid_at_ns = valid_at_ns


class _InQueue:
    """The samples since the last step, oldest first. They are views: copy() a sample to keep it."""
    __slots__ = ("_head", "_items", "_views")

    def __len__(self):
        return self._head.count

    def __getitem__(self, i):
        return self._views[:self._head.count][i]

    def __iter__(self):
        return iter(self._views[:self._head.count])

    @property
    def lost(self):
        """Number of samples without room since the last step."""
        return self._head.lost


class _OutQueue:
    __slots__ = ("_head", "_items", "_stamps", "_tick")

    def push(self, message, valid_at_ns=None):
        """False without room; the loss is counted and reported to the reader."""
        n = self._head.count
        if n == len(self._items):
            self._head.lost += 1
            return False
        self._items[n].set(message)
        self._stamps[n] = self._tick.now_ns if valid_at_ns is None else valid_at_ns
        self._head.count = n + 1
        return True


class _Blob:
    __slots__ = ("data", "name", "given")

    def __init__(self):
        self.data, self.name, self.given = b"", "", False


# ---- from a class to tables ----------------------------------------------------------------------------------------------------

_Described = collections.namedtuple("_Described", "cls name doc inputs outputs params vehicle")


def _members(cls, inner, kinds, what):
    """The declarations of an inner class, those of its bases first. None without such a class."""
    holder = getattr(cls, inner, None)
    if holder is None:
        return {}
    found = {}
    for base in reversed(holder.__mro__[:-1]):
        for name, value in vars(base).items():
            if name.startswith("_") or isinstance(value, (staticmethod, classmethod, types.FunctionType)):
                continue
            if not isinstance(value, kinds):
                raise f.DeclarationError((cls.__name__, inner, name), f._text("declaration_invalid", repr(value), what))
            found[name] = value
    return found


def _ports(cls, inner, kinds, what, scope):
    ports = []
    for name, port in _members(cls, inner, kinds, what).items():
        path = (cls.__name__, inner, name)
        message = None if port.message is None else f._message(path, port.message, scope)
        if message is None and not any(name.endswith(u[0]) and len(name) > len(u[0]) for u in f._units):
            raise f.DeclarationError(path, f._text("probe_unit_missing"))
        ports.append((name, port.kind, port.flags, port.capacity, message))
    return ports


def _params(cls, scope):
    params = []
    for name, p in _members(cls, "Params", f._Param, "parameter; Params holds Param, Flag, Count, Choice, TextParam, Vector, Record and Blob").items():
        message, data = p.type, None
        if p.kind == f.Record.kind:
            message = f._message((cls.__name__, "Params", name), p.message, scope)
            data = message._initial
        params.append((name, p.kind, p.flags, p.unit, p.doc, p.initial, p.low, p.high, p.text, p.choices, message, p.capacity, data))
    return params


def _describe(cls, scope):
    inputs = _ports(cls, "Inputs", (f.In, f.Queue), "input; Inputs holds In, Optional, Queue and Request", scope)
    outputs = _ports(cls, "Outputs", (f.Out, f.Event, f.OutQueue, f.Probe), "output; Outputs holds Out, Event, OutQueue and Probe", scope)
    vehicle = hasattr(cls, "read")
    if vehicle and not hasattr(cls, "write"):
        raise f.DeclarationError((cls.__name__,), f._text("vehicle_incomplete"))
    return _Described(cls, cls.__name__, inspect.cleandoc(cls.__doc__ or ""), inputs, outputs, _params(cls, scope), vehicle)


def _is_component(value, module):
    if not isinstance(value, type) or value.__module__ != module.__name__ or value.__name__.startswith("_"):
        return False
    return any(hasattr(value, inner) for inner in ("Inputs", "Outputs", "Params"))


def _components(module, name):
    found = []
    for cls in vars(module).values():
        if not _is_component(cls, module) or any(d.cls is cls for d in found):
            continue
        if not hasattr(cls, "step") and not hasattr(cls, "read"):
            raise f.DeclarationError((cls.__name__,), f._text("step_missing"))
        found.append(_describe(cls, vars(module)))
    if not found:
        raise ImportError(f"{name}: " + f._text("component_missing"))
    return found


# ---- opening -------------------------------------------------------------------------------------------------------------------

_opened = 0
_siblings = {}  # module -> state of its file at the import


def _forget_changed(folder):
    """Modules in the folder of the script are imported again when their file has changed."""
    for name, was in list(_siblings.items()):
        module = sys.modules.get(name)
        if module is None or _file_state(module) != was:
            sys.modules.pop(name, None)
            del _siblings[name]


def _file_state(module):
    try:
        info = os.stat(module.__file__)
        return info.st_mtime_ns, info.st_size, info.st_ino
    except (AttributeError, TypeError, OSError):
        return None


def _remember(folder):
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and name not in _siblings and os.path.dirname(file) == folder:
            _siblings[name] = _file_state(module)


def _open(file, text):
    """Runs the script in a separate module. -> (module, components, version)"""
    global _opened
    _opened += 1
    name, folder = os.path.basename(file), os.path.dirname(file)
    _forget_changed(folder)
    module = types.ModuleType(f"fulmar_script_{_opened}_{os.path.splitext(name)[0]}")
    module.__file__ = file
    sys.modules[module.__name__] = module  # dataclasses, pickle and enum search there
    source = text.decode(errors="replace")
    linecache.cache[file] = len(source), None, source.splitlines(keepends=True), file
    if folder not in sys.path:
        sys.path.insert(0, folder)
    try:
        exec(compile(text, file, "exec", dont_inherit=True), vars(module))
        components = _components(module, name)
    except BaseException:
        sys.modules.pop(module.__name__, None)
        raise
    _remember(folder)
    return module, components, str(getattr(module, "__version__", "0"))


def _close(module):
    sys.modules.pop(module.__name__, None)


# ---- instances -----------------------------------------------------------------------------------------------------------------

_METHODS = ("step", "read", "write", "configure", "retune", "activate", "deactivate")


class _Instance:
    """The plugin's data of a component: its object, the arguments of its calls, and the addresses of their memory."""


def _address(thing):
    return ctypes.addressof(thing)


def _input(kind, capacity, message):
    """-> (object for the author, owner of the memory, numbers for the plugin)"""
    size = ctypes.sizeof(message)
    if kind == f.In.kind:
        present = "present_" if any(d.name == "present" for d in message._described) else "present"
        view, meta = _view(message, _META, {"numpy": _cached_numpy, "__bool__": lambda self: getattr(self, present)})
        one = view()
        return one, one, (_address(one), size, meta, 0, 1, 0)
    members = {"numpy": _cached_numpy}
    if kind == f.Request.kind:
        members.update(accept=_accept, refuse=_refuse)
    view, meta = _view(message, _ITEM_META, members)
    queue = _InQueue()
    queue._head, queue._items = _Head(), (view * capacity)()
    queue._views = list(queue._items)
    return queue, queue, (_address(queue._items), size, meta, ctypes.sizeof(view), capacity, _address(queue._head))


def _output(kind, capacity, message, tick):
    size = ctypes.sizeof(message)
    if kind == f.OutQueue.kind:
        queue = _OutQueue()
        queue._head, queue._items, queue._stamps, queue._tick = _Head(), (message * capacity)(), (c_int64 * capacity)(), tick
        return queue, (_address(queue._items), size, _address(queue._stamps), capacity, _address(queue._head))
    if kind == f.Event.kind:
        view, meta = _view(message, _EVENT_META, {"publish": _publish})
        one = view()
        return one, (_address(one), size, meta, 1, 0)
    one = message()
    return one, (_address(one), size, 0, 1, 0)


def _outputs(described, instance):
    """The object `out`: a probe is a number in its structure, every other output a slot."""
    probes = [p[0] for p in described.outputs if p[1] == f.Probe.kind]
    slots = tuple(p[0] for p in described.outputs if p[1] != f.Probe.kind)
    body = {"__slots__": slots, "_fields_": [(name, c_double) for name in probes]}
    cls = type("Outputs", (ctypes.Structure,), body)
    out, last = cls(), type("Last", (), {"__slots__": slots + tuple(probes)})()
    numbers, kept = [], []
    for name, kind, _, capacity, message in described.outputs:
        if kind == f.Probe.kind:
            numbers.append((kind, name, _address(out) + getattr(cls, name).offset, 8, 0, 1, 0, None, None))
            setattr(last, name, 0.0)
            continue
        one, places = _output(kind, capacity, message, instance.tick)
        previous = message() if kind != f.OutQueue.kind else None
        setattr(out, name, one)
        setattr(last, name, None)
        kept.append(previous)
        numbers.append((kind, name, *places, one, previous))
    instance.out, instance.last, instance.outputs = out, last, numbers


def _parameters(described, instance):
    p = type("Params", (), {"__slots__": tuple(param[0] for param in described.params)})()
    numbers = []
    for name, kind, _, _, _, _, _, _, _, choices, message, _, _ in described.params:
        value = None
        address = meta = 0
        if kind == f.Vector.kind:
            value = message()
        elif kind == f.Record.kind:
            view, meta = _view(message, [("given", c_bool)], {})
            value = view()
        elif kind == f.Blob.kind:
            value = _Blob()
        if isinstance(value, ctypes.Structure):
            address = _address(value)
        setattr(p, name, value)
        numbers.append((kind, name, list(choices), address, ctypes.sizeof(message) if message else 0, meta, value))
    instance.p, instance.params = p, numbers


def _make(described, seed):
    instance = _Instance()
    cls = described.cls
    takes_seed = cls.__init__ is not object.__init__ and len(inspect.signature(cls).parameters) > 0
    instance.component = cls(seed) if takes_seed else cls()
    instance.tick = Tick()
    views, instance.inputs = [], []
    for name, kind, _, capacity, message in described.inputs:
        view, _, places = _input(kind, capacity, message)
        views.append(view)
        instance.inputs.append((kind, *places))
    instance.inp = collections.namedtuple("Inputs", [p[0] for p in described.inputs])(*views)
    _outputs(described, instance)
    _parameters(described, instance)
    for method in _METHODS:
        setattr(instance, method, getattr(instance.component, method, None))
    return instance


def _settle():
    """After set-up: present objects stay, and the collector need not scan them in flight. Objects of former flights are collected."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()


def _rebound(out, name, own):
    """The author assigned `out.name = message`: fills the message of the output."""
    given = getattr(out, name)
    setattr(out, name, own)
    if isinstance(own, f.Message) and isinstance(given, own._message):
        own.set(given)
        if hasattr(own, "publish"):
            own.publish()
        return
    wanted = own._message.__name__ if isinstance(own, f.Message) else "a queue: push to it"
    raise TypeError(f._text("output_type_invalid", name, wanted, type(given).__name__))


# ---- faults --------------------------------------------------------------------------------------------------------------------

def _declared_at(source, path):
    """The line of a declaration: ("MyLaw", "Inputs", "state")."""
    body, line = ast.parse(source).body, 0
    for word in path:
        for node in body:
            targets = getattr(node, "targets", None) or [getattr(node, "target", None)]
            names = [getattr(node, "name", None)] + [getattr(t, "id", None) for t in targets]
            if word in names:
                line, body = node.lineno, getattr(node, "body", [])
                break
    return line


def _explain(error, file):
    """One sentence that begins with the place in the author's file."""
    name = os.path.basename(file)
    if isinstance(error, f.DeclarationError):
        line = _declared_at("".join(linecache.cache[file][2]), error.path)
        return f"{name}:{line}: {error}" if line else f"{name}: {error}"
    if isinstance(error, SyntaxError) and error.filename:
        return f"{os.path.basename(error.filename)}:{error.lineno}: {error.msg}"
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if os.path.dirname(frame.filename) == os.path.dirname(file)]
    if not own:
        return str(error) if str(error).startswith(name) else f"{name}: {type(error).__name__}: {error}"
    at = own[-1]
    place = f"{os.path.basename(at.filename)}:{at.lineno}"
    if isinstance(error, ModuleNotFoundError) and error.name:
        return f"{place}: " + f._text("module_missing", error.name)
    where = "" if at.name == "<module>" else f" in {at.name}"
    return f"{place}{where}: {type(error).__name__}: {error}" + (f" [{at.line}]" if at.line else "")


def _tell(error, file):
    """Every line of the traceback, for the terminal."""
    traceback.print_exception(error, file=sys.stderr)
    sys.stderr.flush()
