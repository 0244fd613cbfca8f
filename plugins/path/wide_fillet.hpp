// SPDX-License-Identifier: BSD-3-Clause
// Radius of a fillet in wind, when the bank limit is not sufficient for the planned one.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/earth/wind_triangle.hpp"

namespace fulmar::path {

/// Least radius of a turn over the ground at a bank in wind, at its fastest part: Vg^2 / (g tan(bank)
/// cos(crab)), Beard & McLain (2012), (9.14). `turn_rad` right positive.
inline double radius_in_wind(double course_rad, double turn_rad, double airspeed_mps,
                             const Vec3<Ned>& wind_mps, double bank_rad) {
  constexpr double g = 9.80665;
  constexpr int samples = 8;
  double widest_m = 0;
  for (int i = 0; i <= samples; ++i) {
    const double course = course_rad + turn_rad * i / samples;
    const WindTriangle way = fly_course(course, airspeed_mps, wind_mps);
    const double crab = std::max(std::cos(course - way.heading_rad), 0.5);  // as in the bank feed-forward
    const double Vg = way.ground_speed_mps;
    widest_m = std::max(widest_m, Vg * Vg / (g * std::tan(bank_rad) * crab));
  }
  return widest_m;
}

/// A cheap upper bound of `radius_in_wind` for any turn.
inline double radius_in_any_wind(double airspeed_mps, const Vec3<Ned>& wind_mps, double bank_rad) {
  constexpr double g = 9.80665;
  const double wind = std::hypot(wind_mps.north, wind_mps.east), fastest = airspeed_mps + wind;
  const double sine = wind / std::max(airspeed_mps, 1.0), crab = std::sqrt(std::max(1 - sine * sine, 0.25));
  return fastest * fastest / (g * std::tan(bank_rad) * crab);
}

/// Radius of a fillet for which the bank limit allows `held_m`. The planned fillet is left to the outside by
/// up to about (1 - cos(turn)) times the difference of the radii. The wider one, tangent to the same legs,
/// cuts the corner by (1/cos(turn/2) - 1) times that. A third of the way between them gives the smallest
/// error.
inline double wider_fillet_m(double planned_m, double held_m) {
  constexpr double share = 1.0 / 3;
  return planned_m + share * std::max(held_m - planned_m, 0.0);
}

}  // namespace fulmar::path
