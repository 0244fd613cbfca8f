// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class WaypointFrame : std::uint8_t {
  local,    ///< position_m, from the origin
  geodetic  ///< latitude, longitude, altitude
};

enum class PlanEnd : std::uint8_t {
  circuit,  ///< the first waypoint follows the last one
  orbit     ///< orbit around the last waypoint
};

/// A point to fly over or around. In a plan from the planner the local position is always defined.
struct Waypoint {
  WaypointFrame frame = WaypointFrame::local;  ///< frame of the position
  bool has_course = false;                     ///< pass in the direction `course_rad`, with Dubins paths;
                                               ///< false: fillets at the corners
  Vec3<Ned> position_m;                        ///< local position, from the origin
  double latitude_deg = 0;                     ///< latitude, WGS-84
  double longitude_deg = 0;                    ///< longitude, WGS-84
  double altitude_m = 0;                       ///< altitude above mean sea level
  double course_rad = 0;                       ///< course at the waypoint
  double airspeed_mps = 0;                     ///< airspeed on the leg that ends here; 0: airspeed of the
                                               ///< plan
  std::uint32_t id = 0;                        ///< number given by the planner, from 1; constant under edits
                                               ///< of other waypoints
};

template <>
inline constexpr std::string_view appended_from<Waypoint> = "id";

/// The active list of waypoints. `revision` increases with every change.
struct Plan {
  std::uint32_t revision = 0;      ///< number of the change
  PlanEnd end = PlanEnd::circuit;  ///< continuation after the last waypoint
  double turn_radius_m = 50;       ///< radius of turns
  double airspeed_mps = 15;        ///< true airspeed of legs that name none
  std::uint32_t jumps = 0;         ///< number of orders to fly to `jump_item` at once
  std::uint32_t jump_item = 0;     ///< index of a waypoint
  List<Waypoint, 1024> waypoints;  ///< waypoints in their order
};

}  // namespace fulmar
