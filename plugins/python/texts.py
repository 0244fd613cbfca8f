# SPDX-License-Identifier: BSD-3-Clause
"""The messages of fulmar_plugin.py and runtime.py: code and sentence, as in fulmar/diagnostic.hpp."""
import difflib
import os

_TEXTS = {
    "component_missing": "it has no component: a class with Outputs and a method step(self, tick, inp, p, out)",
    "declaration_invalid": "{} is no {}",
    "enum_values_invalid": "the values of {} count from 0, without gaps",
    "field_type_invalid": "{} is no type of a field. Valid: float, f32, bool, int, u8, i32, u32, i64, u64, an IntEnum, Text(n), "
                          "Array(type, n), List(type, n), Ned, Body, Quat and messages",
    "fields_missing": "a message has at least one field: airspeed_mps: float",
    "message_type_invalid": "{} is no message; give its name or class",
    "message_unknown": "there is no message '{}'.{}",
    "module_missing": "there is no Python module '{}'",
    "output_type_invalid": "out.{} is {}, not {}",
    "probe_unit_missing": "the name of a probe ends in its unit: roll_error_rad",
    "step_missing": "it has no method step(self, tick, inp, p, out)",
    "unit_missing": "the name of a number ends in its unit: {}",
    "vehicle_incomplete": "a vehicle has read and write",
}
_writes_codes = os.environ.get("FULMAR_MESSAGES") == "codes"


def text(code, *values):
    """The sentence of a message; with FULMAR_MESSAGES=codes python.code(value, ...)."""
    if not _writes_codes:
        return _TEXTS[code].format(*values)
    return f"python.{code}" + (f"({', '.join(map(str, values))})" if values else "")


def choices(name, valid):
    """End of the message of an unknown name: the nearest name, and all names."""
    near = difflib.get_close_matches(name, valid, 1)
    if _writes_codes:
        return f" [{near[0] if near else ''}] " + ", ".join(valid)
    return (f" Did you mean '{near[0]}'?" if near else "") + " Valid: " + ", ".join(valid) + "."
