// SPDX-License-Identifier: BSD-3-Clause
// What a plan asks of its aircraft and of its place: waypoints inside the fence, airspeed and bank that the
// airframe has.
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

#include "fulmar/flight/path/fence.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/plan.hpp"

namespace fulmar::path {

/// Refuses a waypoint outside the fence. One that waits for the origin is not looked at.
inline void check_fence(const Plan& plan, const safety::Fence& fence, const Origin& origin) {
  safety::Polygon polygon;
  polygon.set(fence, origin);
  for (std::uint32_t i = 0; i < plan.waypoints.count; ++i) {
    const Waypoint& w = plan.waypoints[i];
    if (w.frame == WaypointFrame::geodetic && !origin.given) continue;
    const double up_m = -w.position_m.down;
    const double room_m = polygon.room_m(w.position_m.north, w.position_m.east);
    const std::string which = "waypoint " + std::to_string(i + 1) + " of the plan is ";
    if (room_m < 0)
      throw std::runtime_error(which + std::to_string(std::lround(-room_m)) + " m outside the fence");
    if (up_m > fence.ceiling_m || up_m < fence.floor_m)
      throw std::runtime_error(which + "at " + std::to_string(std::lround(up_m)) + " m, " +
                               (up_m > fence.ceiling_m ? "above the ceiling" : "below the floor") +
                               " of the fence");
  }
}

/// A warning of an airspeed that the airframe does not fly; "" of one that it does.
inline std::array<char, 96> airspeed_doubt(const Plan& plan, const FlightLimits& limits) {
  std::array<char, 96> words{};
  const auto look = [&](double Va) {
    if (words[0] != 0 || Va <= 0 || (Va >= limits.airspeed_min_mps && Va <= limits.airspeed_max_mps)) return;
    std::snprintf(words.data(), words.size(),
                  "%.0f m/s is beyond the airframe's %.0f to %.0f m/s, flown at the limit", Va,
                  limits.airspeed_min_mps, limits.airspeed_max_mps);
  };
  look(plan.airspeed_mps);
  for (const Waypoint& w : plan.waypoints) look(w.airspeed_mps);
  return words;
}

/// The same of a turn radius that takes more bank than the airframe has. r = Va^2 / (g tan phi).
inline std::array<char, 96> radius_doubt(const Plan& plan, const FlightLimits& limits) {
  constexpr double g_mps2 = 9.80665, degrees = 180 / std::numbers::pi;
  std::array<char, 96> words{};
  const double Va2 = plan.airspeed_mps * plan.airspeed_mps;
  const double least_m = Va2 / (g_mps2 * std::tan(limits.roll_max_rad));
  if (plan.turn_radius_m < least_m)
    std::snprintf(words.data(), words.size(),
                  "turn_radius %.0f m takes %.0f deg of bank; roll_max %.0f deg gives %.0f m",
                  plan.turn_radius_m, degrees * std::atan(Va2 / (g_mps2 * plan.turn_radius_m)),
                  degrees * limits.roll_max_rad, least_m);
  return words;
}

}  // namespace fulmar::path
