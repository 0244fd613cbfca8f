// SPDX-License-Identifier: BSD-3-Clause
// What a plan file may hold. It becomes a Plan when the planner is configured.
#pragma once
#include "fulmar/msg/plan.hpp"

namespace fulmar::path {

inline constexpr double not_given = unknown_std;

/// Either north, east, up of the origin, or latitude, longitude, altitude above mean sea level.
struct PlanFileWaypoint {
  double north_m = not_given, east_m = not_given, up_m = not_given;
  double lat_deg = not_given, lon_deg = not_given, alt_msl_m = not_given;
  double course_rad = not_given;    ///< pass in this direction; without it the corner is rounded
  double airspeed_mps = not_given;  ///< of the leg that ends here; without it the plan's
};

struct PlanFile {
  Text<64> name;
  PlanEnd end = PlanEnd::circuit;
  double airspeed_mps = 15;
  double turn_radius_m = 50;
  List<PlanFileWaypoint, 1024> waypoints;
};

}  // namespace fulmar::path
