// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// How far the plan has been flown.
struct Progress {
  std::uint32_t item = 0;      ///< index of the waypoint that is flown to
  std::uint32_t items = 0;     ///< waypoints in the plan
  std::uint32_t reached = 0;   ///< waypoints passed since the start
  std::uint32_t circuits = 0;  ///< times the whole list was flown
  bool finished = false;       ///< the last waypoint of a plan that ends in an orbit was reached
  double distance_m = 0;       ///< horizontal, to the waypoint that is flown to
  double miss_m = 0;     ///< closest horizontal distance to the path's point of the waypoint passed last
  bool joining = false;  ///< on the way from somewhere else to the plan's route
  std::uint32_t plan_revision = 0;
};

}  // namespace fulmar
