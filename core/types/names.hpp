// SPDX-License-Identifier: BSD-3-Clause
// How long the names may be that the host's own messages tell: their fields have this room, the zero at the
// end included. What would not fit is refused before the flight, so that a log never holds part of a name.
#pragma once
#include <cstddef>

namespace fulmar::core {

inline constexpr std::size_t component_room = 48;  // components and roles
inline constexpr std::size_t name_room = 64;       // phases, parameters, ports

}  // namespace fulmar::core
