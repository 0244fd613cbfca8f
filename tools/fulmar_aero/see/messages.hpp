// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText level_flight_missing{"aero.level_flight_missing", "no level flight exists"};
inline constexpr MessageText page_is_input{
    "aero.page_is_input", {"page"}, "'{page}' is an input of the page; name another file with -o"};
inline constexpr MessageText surfaces_not_in_file{
    "aero.surfaces_not_in_file",
    {"airframe"},
    "{airframe}: an airframe file has no surfaces; give its geometry file to show them"};

}  // namespace fulmar::aero_messages
