// SPDX-License-Identifier: BSD-3-Clause
// The shared messages and the rules of names, for the Python side.
#pragma once
#include <pybind11/pybind11.h>

namespace fulmar::python {

/// One dict per type, a nested type before the type that holds it; see _share in fulmar_plugin.py.
pybind11::list message_tables();

/// (suffix, printed, min, max) of every unit.
pybind11::list unit_rules();

}  // namespace fulmar::python
