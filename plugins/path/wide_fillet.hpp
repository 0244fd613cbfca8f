// SPDX-License-Identifier: BSD-3-Clause
// How wide a fillet is to be in wind, where the bank does not suffice for the one that was planned.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/route_leg.hpp"
#include "fulmar/flight/wind_triangle.hpp"

namespace fulmar::path {

/// Least radius of a turn over the ground at a bank in wind, by its fastest part: Vg^2 / (g tan(bank)
/// cos(crab)), Beard & McLain (2012), (9.14). `turn_rad` right positive.
inline double radius_in_wind(double course_rad, double turn_rad, double airspeed_mps,
                             const Vec3<Ned>& wind_mps, double bank_rad) {
  constexpr double g = 9.80665;
  constexpr int samples = 8;
  double widest_m = 0;
  for (int i = 0; i <= samples; ++i) {
    const double course = course_rad + turn_rad * i / samples;
    const WindTriangle way = fly_course(course, airspeed_mps, wind_mps);
    const double crab = std::max(std::cos(course - way.heading_rad), 0.5);  // as the bank that is fed forward
    const double Vg = way.ground_speed_mps;
    widest_m = std::max(widest_m, Vg * Vg / (g * std::tan(bank_rad) * crab));
  }
  return widest_m;
}

/// Radius for a fillet that was planned as `half` (an arc as long as half of it) behind `line`; the planned
/// one where the bank suffices. A fillet of the planned radius is left to the outside by up to about
/// (1 - cos(turn)) times what it is too tight; one that can be held, tangent to the same legs, cuts the
/// corner by (1/cos(turn/2) - 1) times that. A third of the way from the one to the other leaves the least of
/// both.
inline double wider_fillet_m(const RoutePiece& line, const RoutePiece& half, double airspeed_mps,
                             const Vec3<Ned>& wind_mps, double bank_rad) {
  constexpr double g = 9.80665, share = 1.0 / 3;
  const double fastest = airspeed_mps + std::hypot(wind_mps.north, wind_mps.east);
  if (fastest * fastest < 0.5 * half.radius_m * g * std::tan(bank_rad)) return half.radius_m;
  const double course = std::atan2(line.unit_east_ratio, line.unit_north_ratio);
  const double turn = 2 * sign_of(half.turn) * half.length_m / half.radius_m;
  const double lacks_m = radius_in_wind(course, turn, airspeed_mps, wind_mps, bank_rad) - half.radius_m;
  return half.radius_m + share * std::max(lacks_m, 0.0);
}

}  // namespace fulmar::path
