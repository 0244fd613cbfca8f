// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::ros_bridge_messages {

inline constexpr MessageText waypoint_not_finite{"ros_bridge.waypoint_not_finite",
                                                 "a number of the waypoint is not finite"};

}  // namespace fulmar::ros_bridge_messages
