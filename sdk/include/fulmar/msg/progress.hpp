// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Progress of the flight along the plan.
struct Progress {
  std::uint32_t item = 0;           ///< index of the active waypoint
  std::uint32_t items = 0;          ///< number of waypoints in the plan
  std::uint32_t reached = 0;        ///< number of waypoints passed since the start
  std::uint32_t circuits = 0;       ///< number of circuits of the whole list
  bool finished = false;            ///< true after the last waypoint of a plan that ends in an orbit
  double distance_m = 0;            ///< horizontal distance to the active waypoint
  double miss_m = 0;                ///< closest horizontal distance to the path point of the waypoint passed
                                    ///< last
  bool joining = false;             ///< on the way from another place to the route of the plan
  std::uint32_t plan_revision = 0;  ///< revision of the plan
};

}  // namespace fulmar
