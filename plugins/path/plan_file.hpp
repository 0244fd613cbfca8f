// SPDX-License-Identifier: BSD-3-Clause
// Content of a plan file. It becomes a Plan when the planner is configured.
#pragma once
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/runway.hpp"

namespace fulmar::path {

inline constexpr double not_given = unknown_std;

/// Either north, east, up of the origin, or latitude, longitude, altitude above mean sea level.
struct PlanFileWaypoint {
  double north_m = not_given, east_m = not_given, up_m = not_given;  ///< local position, from the origin
  double lat_deg = not_given, lon_deg = not_given, alt_msl_m = not_given;  ///< geodetic position, WGS-84,
                                                                           ///< altitude above mean sea level
  double course_rad = not_given;    ///< course at the waypoint; without it
                                    ///< a fillet at the corner
  double airspeed_mps = not_given;  ///< airspeed on the leg that ends here;
                                    ///< without it the airspeed of the plan
};

struct PlanFile {
  Text<64> name;
  PlanEnd end = PlanEnd::circuit;  ///< continuation after the last waypoint
  double airspeed_mps = 15;        ///< airspeed of legs without their own
  double turn_radius_m = 50;       ///< radius of turns
  List<PlanFileWaypoint, 1024> waypoints;
  Runway runway;       ///< runway of a landing with this plan
  bool given = false;  // false: no plan
};

}  // namespace fulmar::path

namespace fulmar {

/// Bounds beyond the range of small aircraft detect a wrong unit.
template <>
inline constexpr std::array<FieldRange, 8> field_ranges<path::PlanFileWaypoint>{{{"north_m", -1e5, 1e5},
                                                                                 {"east_m", -1e5, 1e5},
                                                                                 {"up_m", -1e5, 1e5},
                                                                                 {"lat_deg", -90, 90},
                                                                                 {"lon_deg", -360, 360},
                                                                                 {"alt_msl_m", -1e5, 1e5},
                                                                                 {"course_rad", -7, 7},
                                                                                 {"airspeed_mps", 3, 300}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<path::PlanFile>{
    {{"airspeed_mps", 3, 300}, {"turn_radius_m", 1, 1e5}}};

}  // namespace fulmar
