# SPDX-License-Identifier: BSD-3-Clause
"""The aircraft of `sim_aero` without host and mission: one, or thousands in one call.

    import fulmar_sim

    sim = fulmar_sim.Simulation("fulmar:airframes/anaconda.yaml", n=1000, threads=2)
    rows = sim.fly(height=100, airspeed=17)
    actions = sim.trim                  # (n, 4), named by sim.action_names
    rows = sim.step(actions)            # (n, 26), named by sim.row_names

Metres, seconds, kilograms, radians. Arrays are of float64, one row an aircraft; what is not, is converted. The same seed, start and actions
give the same flight to the bit, whatever the number of threads.
"""
import ctypes
import os
import pathlib

import numpy

__all__ = ["Error", "Simulation"]


class Error(ValueError):
    """An error, in one sentence; for a file with its name and line. The state has not changed."""


# The messages of the Python side: code and sentence.
_TEXTS = {
    "choice_unknown": "{} is {}; valid: {}",
    "copy_unsupported": "a simulation cannot be copied or pickled: make another one and give it this one's state with set_state",
    "file_name_expected": "airframe is {} and must be the name of a file",
    "file_name_invalid": "airframe is {}: no file is named so",
    "library_missing": "fulmar_sim: there is no libfulmar_sim.so in a folder lib/ above {}; build it: ninja -C build fulmar_sim",
    "number_expected": "{} is {} and must be a number",
    "numbers_expected": "{}: numbers are expected, {} was given",
    "numbers_masked": "{}: some are masked",
    "rows_expected": "{}: rows of numbers are expected",
    "selection_invalid": "only is {} and must be an index below {}, a list of them, or {} bools",
    "shape_invalid": "{}: the shape is {} and must be {}",
    "simulation_closed": "the simulation is gone",
    "whole_number_expected": "{} is {} and must be a whole number from {} to {}",
}


def _sentence(code, *values):
    """The text of a message; with FULMAR_MESSAGES=codes simulation.code(value, ...), as in fulmar/diagnostic.hpp."""
    if os.environ.get("FULMAR_MESSAGES") != "codes":
        return _TEXTS[code].format(*values)
    return f"simulation.{code}" + (f"({', '.join(map(str, values))})" if values else "")


def _load():
    """<prefix>/lib/libfulmar_sim.so, for <prefix>/lib/python3/dist-packages/fulmar_sim or <build>/lib/python/fulmar_sim."""
    for folder in pathlib.Path(__file__).resolve().parents:
        if folder.name == "lib" and (folder / "libfulmar_sim.so").exists():
            return ctypes.CDLL(str(folder / "libfulmar_sim.so"))
    raise ImportError(_sentence("library_missing", __file__))


def _declare(name, *arguments, result=ctypes.c_int):
    function = getattr(_library, "fulmar_sim_" + name)
    function.argtypes, function.restype = arguments, result
    return function


_library = _load()
_pointer, _double, _unsigned, _text = ctypes.c_void_p, ctypes.c_double, ctypes.c_uint, ctypes.c_char_p
_error = _declare("error", result=_text)
_rows_are = _declare("rows_are", result=_text)
_actions_are = _declare("actions_are", result=_text)
_new = _declare("new", _text, ctypes.c_size_t, _unsigned, _double, _double, _unsigned, ctypes.c_uint64, result=_pointer)
_delete = _declare("delete", _pointer, result=None)
_reset = _declare("reset", _pointer, _pointer, ctypes.c_uint64)
_start_in_flight = _declare("start_in_flight", _pointer, _pointer, _pointer)
_trim = _declare("trim", _pointer, _pointer)
_set_wind = _declare("set_wind", _pointer, _pointer)
_step = _declare("step", _pointer, _pointer, _unsigned, _pointer)
_rows = _declare("rows", _pointer, _pointer)
_set_rows = _declare("set_rows", _pointer, _pointer, _pointer)

_TURBULENCE = ("none", "light", "moderate", "severe")
_ROWS, _ACTIONS = tuple(_rows_are().decode().split()), tuple(_actions_are().decode().split())
_PIECE = 10**6  # steps of aircraft in one call, about half a second: in between Python can be interrupted


def _told():
    return Error(_error().decode(errors="replace"))


def _is_bool(value):
    return isinstance(value, (bool, numpy.bool_))


def _whole(value, what, least, most):
    if _is_bool(value) or not isinstance(value, (int, numpy.integer)) or not least <= value <= most:
        raise Error(_sentence("whole_number_expected", what, repr(value), least, most))
    return int(value)


def _number(value, what):
    if _is_bool(value) or not isinstance(value, (int, float, numpy.integer, numpy.floating)):
        raise Error(_sentence("number_expected", what, repr(value)))
    return float(value)


def _numbers(values, what):
    """A copy that no other thread changes; float64 in rows."""
    try:
        given = numpy.asarray(values)
    except ValueError:  # rows that are not of one length
        raise Error(_sentence("rows_expected", what)) from None
    if given.dtype.kind not in "iuf":
        raise Error(_sentence("numbers_expected", what, type(values).__name__ if given.ndim == 0 else given.dtype))
    if numpy.ma.is_masked(values):
        raise Error(_sentence("numbers_masked", what))
    return numpy.array(given, dtype=float, order="C")


def _file(airframe):
    try:
        name = os.fsencode(airframe)
    except TypeError:
        raise Error(_sentence("file_name_expected", repr(airframe))) from None
    if b"\0" in name:
        raise Error(_sentence("file_name_invalid", repr(airframe)))
    return name


class Simulation:
    """Aircraft of one airframe, at rest on the ground, heading north.

    airframe         an airframe file, or one that is shipped: "fulmar:airframes/anaconda.yaml"
    n                how many aircraft; each takes 75 kB
    threads          that share a step; the caller's own is one of them
    dt               s, one step of the model, at most 0.1
    seed             of turbulence; aircraft i draws from a seed of its own, made of this one and i
    origin_altitude  m above sea level, of height 0; -1000 to 20000
    turbulence       "none", "light", "moderate", "severe"

    Methods take `only`, the selected aircraft: an index, a list of them, or an array of n bools; without it all.
    Rows are (n, 26), a new array each time. Columns, as `row_names` names them:

     0.. 2  north_m east_m down_m               from the origin
     3.. 5  v_north_mps v_east_mps v_down_mps   over the ground
     6.. 9  q_w q_x q_y q_z                     attitude, body to north-east-down
    10..12  p_radps q_radps r_radps             body rate
    13..15  airspeed_mps alpha_rad beta_rad
    16..18  f_x_mps2 f_y_mps2 f_z_mps2          specific force at the centre of gravity, body axes
    19..21  aileron_rad elevator_rad rudder_rad where the surfaces are
        22  propeller_radps
        23  on_ground                           1 when something touches it
        24  crashed                             1: it hit the ground, and stays there
        25  departed                            1: the motion is no number or absurdly fast; 2, 3: angle of attack, sideslip
                                                beyond the airframe's tables. It stays where it is, and other columns mean little
    """

    row_names = _ROWS
    action_names = _ACTIONS
    _sim, _n = None, 0

    def __init__(self, airframe, n=1, *, threads=1, dt=0.0025, seed=1, origin_altitude=0.0, turbulence="none"):
        self.__del__()  # what it was before
        self._n = _whole(n, "n", 1, 10**5)
        if turbulence not in _TURBULENCE:
            raise Error(_sentence("choice_unknown", "turbulence", repr(turbulence), ", ".join(_TURBULENCE)))
        self._sim = _new(_file(airframe), self._n, _whole(threads, "threads", 1, 256), _number(dt, "dt"),
                         _number(origin_altitude, "origin_altitude"), _TURBULENCE.index(turbulence), _whole(seed, "seed", 0, 2**64 - 1))
        if not self._sim:
            raise _told()

    def __del__(self):
        sim, self._sim = self._sim, None
        if sim:
            _delete(sim)

    def __reduce_ex__(self, protocol):
        raise Error(_sentence("copy_unsupported"))

    @property
    def n(self):
        """Number of aircraft."""
        return self._n

    @property
    def state(self):
        """The present rows."""
        rows = numpy.empty((self._n, len(_ROWS)))
        self._call(_rows, rows.ctypes.data)
        return rows

    def set_state(self, rows, only=None):
        """Sets position, velocity, attitude, body rate, surfaces and propeller from these rows (n, 26); the other columns follow from them.
        Gusts continue, and the springs of the gear keep their state. Returns the rows."""
        rows, only = self._array(rows, len(_ROWS), "rows"), self._only(only)
        self._call(_set_rows, self._data(only), rows.ctypes.data)
        return self.state

    def reset(self, seed=1, only=None):
        """Resets to the initial state with this seed; the wind stays. Returns the rows."""
        only = self._only(only)
        self._call(_reset, self._data(only), _whole(seed, "seed", 0, 2**64 - 1))
        return self.state

    def fly(self, height, airspeed, heading=0.0, only=None):
        """Starts steady level flight above the origin: height in m, airspeed in m/s, heading in rad, each one number or an array (n,).
        Returns the rows."""
        starts = numpy.empty((self._n, 3))
        for column, (value, what) in enumerate(((height, "height"), (airspeed, "airspeed"), (heading, "heading"))):
            value = _numbers(value, what)
            if value.shape not in ((), (self._n,)):
                raise Error(_sentence("shape_invalid", what, value.shape, f"{(self._n,)}, or one number is given"))
            starts[:, column] = value
        only = self._only(only)
        self._call(_start_in_flight, self._data(only), starts.ctypes.data)
        return self.state

    @property
    def trim(self):
        """The actions (n, 4) of the steady flight of each aircraft's last `fly`; zeros before."""
        actions = numpy.empty((self._n, len(_ACTIONS)))
        self._call(_trim, actions.ctypes.data)
        return actions

    def set_wind(self, wind):
        """Steady velocity of the air in m/s, north, east, down: (3,) for all, or (n, 3)."""
        wind = self._array(wind, 3, "wind")
        self._call(_set_wind, wind.ctypes.data)

    def step(self, actions, steps=1):
        """`steps` steps of `dt` under these actions, (n, 4), or (4,) for all: throttle 0 to 1; aileron, elevator, rudder in rad.
        Surfaces and throttle are limited to those of the aircraft. Returns the rows."""
        actions = self._array(actions, len(_ACTIONS), "actions")
        rows = numpy.empty((self._n, len(_ROWS)))
        left, most = _whole(steps, "steps", 1, 2**32 - 1), max(1, _PIECE // self._n)
        while left:
            piece = min(left, most)
            self._call(_step, actions.ctypes.data, piece, rows.ctypes.data)
            left -= piece
        return rows

    def _call(self, function, *arguments):
        if not self._sim:
            raise Error(_sentence("simulation_closed"))
        if function(self._sim, *arguments):
            raise _told()

    def _array(self, values, columns, what):
        values = _numbers(values, what)
        if values.shape == (columns,):
            values = numpy.tile(values, (self._n, 1))
        if values.shape != (self._n, columns):
            raise Error(_sentence("shape_invalid", what, values.shape, f"{(self._n, columns)} or {(columns,)}"))
        return values

    def _only(self, only):
        if only is None:
            return None
        wrong = _sentence("selection_invalid", repr(only), self._n, self._n)
        try:
            chosen = numpy.asarray(only)
        except ValueError:
            raise Error(wrong) from None
        if chosen.size == 0 and chosen.ndim == 1:
            chosen = chosen.astype(int)
        if chosen.dtype.kind not in "iub" or (chosen.dtype.kind == "b" and chosen.shape != (self._n,)):
            raise Error(wrong)
        mask = numpy.zeros(self._n, dtype=bool)
        try:
            mask[chosen] = True
        except IndexError:
            raise Error(wrong) from None
        return mask

    @staticmethod
    def _data(array):
        return None if array is None else array.ctypes.data
