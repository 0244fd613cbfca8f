// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "fulmar/flight/model/modes.hpp"

namespace fulmar::aero {

/// "short period", "Dutch roll", ...
const char* mode_name(ModeKind kind);

/// One line of a table: name, eigenvalue, frequency, damping, times.
std::string mode_heading();
std::string mode_line(const Mode& mode);

}  // namespace fulmar::aero
