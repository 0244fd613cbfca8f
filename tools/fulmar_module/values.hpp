// SPDX-License-Identifier: BSD-3-Clause
// Messages as Python values.
#pragma once
#include <pybind11/pybind11.h>

#include "core/types/type.hpp"

namespace fulmar::module {

/// A copy of a message: numpy.record (state.roll_rad, state["roll_rad"], state.position_m[0]); without numpy
/// a dict. Vectors and quaternions are arrays, enums are numbers.
pybind11::object record_of(const core::Type& type, const std::byte* message);

/// One element: a number, a bool, the label of an enum, text, or a record.
pybind11::object value_of(const core::Field& field, const std::byte* at);

}  // namespace fulmar::module
