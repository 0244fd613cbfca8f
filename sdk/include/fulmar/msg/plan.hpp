// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class WaypointFrame : std::uint8_t {
  local,    ///< position_m, from the origin
  geodetic  ///< latitude, longitude, altitude
};

enum class PlanEnd : std::uint8_t {
  circuit,  ///< after the last waypoint comes the first
  orbit     ///< orbit the last waypoint
};

/// A point to fly over or around. In a plan that has left the planner the local position is always there.
struct Waypoint {
  WaypointFrame frame = WaypointFrame::local;
  bool has_course = false;  ///< pass in the direction `course_rad`, joined by Dubins paths; else corners are
                            ///< rounded by fillets
  Vec3<Ned> position_m;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above mean sea level
  double course_rad = 0;
  double airspeed_mps = 0;  ///< of the leg that ends here; 0: the plan's
  std::uint32_t id = 0;     ///< given by the planner, from 1; stays with it whatever is edited around it
};

template <>
inline constexpr std::string_view appended_from<Waypoint> = "id";

/// The list of waypoints in force. `revision` grows with every change.
struct Plan {
  std::uint32_t revision = 0;
  PlanEnd end = PlanEnd::circuit;
  double turn_radius_m = 50;
  double airspeed_mps = 15;     ///< of legs that name none
  std::uint32_t jumps = 0;      ///< grows with every order to fly to `jump_item` at once
  std::uint32_t jump_item = 0;  ///< index of a waypoint
  List<Waypoint, 1024> waypoints;
};

}  // namespace fulmar
