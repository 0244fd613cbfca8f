# SPDX-License-Identifier: BSD-3-Clause
"""The aircraft of `sim_aero` as a Python object, one or a thousand of them in one call.

    import fulmar_sim

    sim = fulmar_sim.Simulation("configs/airframes/anaconda.yaml", n=1000, threads=2)
    rows = sim.fly(height=100, airspeed=17)
    rows = sim.step(actions)            # (n, 4) -> (n, 25), the names in sim.actions and sim.columns

SI and radians. The same seed, start and actions give the same flight to the bit, whatever the number of threads.
"""
import ctypes
import os
import pathlib

import numpy

__all__ = ["Error", "Simulation"]
_ABI = 1
_TURBULENCE = ("none", "light", "moderate", "severe")


class Error(ValueError):
    """What is wrong, in a sentence; for a file with its name and line."""


def _load():
    here = pathlib.Path(__file__).resolve().parent
    near = [up / part / "libfulmar_sim.so" for up in list(here.parents)[:4] for part in ("", "lib")]
    for path in [os.environ["FULMAR_SIM_LIBRARY"]] if "FULMAR_SIM_LIBRARY" in os.environ else near:
        if os.path.exists(path):
            library = ctypes.CDLL(str(path))
            break
    else:
        raise ImportError("libfulmar_sim.so is not there; FULMAR_SIM_LIBRARY names the file")
    found = library.fulmar_sim_abi()
    if found != _ABI:
        raise ImportError(f"{path} speaks version {found} of its interface, this package version {_ABI}")
    return library


_lib = _load()
_handle, _rows, _double, _text = ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double, (ctypes.c_char_p, ctypes.c_size_t)
_lib.fulmar_sim_columns.restype = _lib.fulmar_sim_actions.restype = ctypes.c_char_p
_lib.fulmar_sim_new.restype = _handle
_lib.fulmar_sim_new.argtypes = (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint32, _double, ctypes.c_int, ctypes.c_uint64, *_text)
_lib.fulmar_sim_delete.argtypes = (_handle,)
_lib.fulmar_sim_delete.restype = None
_lib.fulmar_sim_reset.argtypes = (_handle, ctypes.c_uint64, *_text)
_lib.fulmar_sim_stand.argtypes = (_handle, _double, *_text)
_lib.fulmar_sim_fly.argtypes = (_handle, _double, _double, _double, *_text)
_lib.fulmar_sim_set_wind.argtypes = (_handle, _rows, *_text)
_lib.fulmar_sim_step.argtypes = (_handle, _rows, _double, ctypes.c_uint32, _rows, *_text)
_lib.fulmar_sim_rows.argtypes = (_handle, _rows, *_text)
_lib.fulmar_sim_set_rows.argtypes = (_handle, _rows, *_text)


def _whole(value, what, least, most):
    if isinstance(value, bool) or not isinstance(value, (int, numpy.integer)) or not least <= value <= most:
        raise Error(f"{what} is {value!r} and must be a whole number from {least} to {most}")
    return int(value)


class Simulation:
    """`n` aircraft of one airframe, at rest on the ground. `dt` is one step, s; more than 0, at most 0.1."""

    columns = tuple(_lib.fulmar_sim_columns().decode().split())
    actions = tuple(_lib.fulmar_sim_actions().decode().split())

    def __init__(self, airframe, n=1, threads=1, dt=0.0025, seed=1, origin_altitude=0.0, turbulence="none"):
        self._sim = None
        self.n = _whole(n, "n", 1, 10**7)
        self.dt = float(dt)
        threads, seed = _whole(threads, "threads", 1, 256), _whole(seed, "seed", 0, 2**64 - 1)
        if turbulence not in _TURBULENCE:
            raise Error(f"turbulence is {turbulence!r}; valid: {', '.join(_TURBULENCE)}")
        error = ctypes.create_string_buffer(4096)
        self._sim = _lib.fulmar_sim_new(os.fsencode(airframe), self.n, threads, float(origin_altitude),
                                        _TURBULENCE.index(turbulence), seed, error, len(error))
        if not self._sim:
            raise Error(error.value.decode(errors="replace"))
        self._out = numpy.empty((self.n, len(self.columns)))

    def __del__(self):
        if getattr(self, "_sim", None):
            _lib.fulmar_sim_delete(self._sim)
            self._sim = None

    def reset(self, seed=1):
        """As made anew with this seed; the wind stays. Returns the rows."""
        self._call("reset", _whole(seed, "seed", 0, 2**64 - 1))
        return self._read()

    def stand(self, heading=0.0):
        """At rest on the ground."""
        self._call("stand", float(heading))
        return self._read()

    def fly(self, height, airspeed, heading=0.0):
        """Into steady level flight above the origin."""
        self._call("fly", float(height), float(airspeed), float(heading))
        return self._read()

    def set_wind(self, wind):
        """Velocity of the air, north, east, down: three numbers, or an array (n, 3)."""
        wind = numpy.asarray(wind)
        if wind.shape == (3,):
            wind = numpy.ascontiguousarray(numpy.broadcast_to(wind.astype(float), (self.n, 3)))
        self._call("set_wind", self._array(wind, 3, "wind").ctypes.data)

    def step(self, actions, steps=1):
        """`steps` steps under these actions, float64 (n, 4), read without a copy. Returns the rows (n, 25) in one array that the next
        call overwrites: take a copy of what is to be kept."""
        given = self._array(actions, len(self.actions), "actions")
        self._call("step", given.ctypes.data, self.dt, _whole(steps, "steps", 1, 10**9), self._out.ctypes.data)
        return self._out

    @property
    def state(self):
        """A copy of the rows. Assigned, it sets position, velocity, attitude, body rate, surfaces and propeller."""
        return self._read().copy()

    @state.setter
    def state(self, rows):
        self._call("set_rows", self._array(rows, len(self.columns), "state").ctypes.data)

    def _read(self):
        self._call("rows", self._out.ctypes.data)
        return self._out

    def _call(self, name, *arguments):
        error = ctypes.create_string_buffer(1024)
        if getattr(_lib, "fulmar_sim_" + name)(self._sim, *arguments, error, len(error)):
            raise Error(error.value.decode(errors="replace"))

    def _array(self, array, columns, what):
        if not isinstance(array, numpy.ndarray):
            raise Error(f"{what}: a numpy array is expected, found {type(array).__name__}")
        if array.shape != (self.n, columns):
            raise Error(f"{what}: the shape ({self.n}, {columns}) is expected, found {array.shape}")
        if array.dtype != numpy.float64:
            raise Error(f"{what}: float64 is expected, found {array.dtype}")
        return numpy.ascontiguousarray(array)
