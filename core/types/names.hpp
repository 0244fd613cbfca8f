// SPDX-License-Identifier: BSD-3-Clause
// Maximum lengths of names in the host's own messages, including the terminating zero. A longer name is
// rejected before the flight, so that a log never holds part of a name.
#pragma once
#include <cstddef>

namespace fulmar::core {

inline constexpr std::size_t component_room = 48;  // components and roles
inline constexpr std::size_t name_room = 64;       // phases, parameters, ports

}  // namespace fulmar::core
