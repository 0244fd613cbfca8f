// SPDX-License-Identifier: BSD-3-Clause
// Wind triangle: ground velocity = air velocity + wind. Beard & McLain, Small Unmanned Aircraft (2012),
// section 2.4, in the horizontal plane.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/frames.hpp"

namespace fulmar {

/// Heading and ground speed on a course. Without a solution in this wind, `feasible` is false, and the
/// heading compensates as much cross wind as possible without flying backwards.
struct WindTriangle {
  double heading_rad = 0;       ///< direction of the air velocity
  double ground_speed_mps = 0;  ///< along the course; negative: backwards
  bool feasible = true;         ///< true if the course can be held with a ground speed above 0
};

/// `airspeed_mps` is the horizontal part of the true airspeed: Va cos(gamma_a).
inline WindTriangle fly_course(double course_rad, double airspeed_mps, double wind_north_mps,
                               double wind_east_mps) {
  const double c = std::cos(course_rad), s = std::sin(course_rad);
  const double along = c * wind_north_mps + s * wind_east_mps;
  const double across = -s * wind_north_mps + c * wind_east_mps;  // from the left
  if (airspeed_mps <= 0) return {course_rad, along, false};
  const double sine = -across / airspeed_mps;  // sine of the crab angle
  WindTriangle triangle;
  triangle.heading_rad = wrap_pi(course_rad + std::asin(std::clamp(sine, -1.0, 1.0)));
  const double forward = airspeed_mps * std::sqrt(std::max(1 - sine * sine, 0.0));
  triangle.ground_speed_mps = along + forward;
  triangle.feasible = std::abs(sine) < 1 && triangle.ground_speed_mps > 0;
  return triangle;
}

/// The same; the vertical wind is ignored.
inline WindTriangle fly_course(double course_rad, double airspeed_mps, const Vec3<Ned>& wind_mps) {
  return fly_course(course_rad, airspeed_mps, wind_mps.north, wind_mps.east);
}

/// Air velocity from ground velocity and wind.
inline Vec3<Ned> air_velocity(const Vec3<Ned>& ground_mps, const Vec3<Ned>& wind_mps) {
  return ground_mps - wind_mps;
}

/// Minimum airspeed for `ground_speed_mps` on a course.
inline double airspeed_for_ground_speed(double course_rad, double ground_speed_mps,
                                        const Vec3<Ned>& wind_mps) {
  const double north = ground_speed_mps * std::cos(course_rad) - wind_mps.north;
  const double east = ground_speed_mps * std::sin(course_rad) - wind_mps.east;
  return std::hypot(north, east);
}

/// Bank of a coordinated level turn over the ground, of signed curvature (1/m, right positive). Beard &
/// McLain, chapter 10: the centripetal acceleration is that of the ground path, V_g^2 kappa, and lift tilts
/// about the air velocity: tan(phi) = V_g^2 kappa / (g cos(chi - psi)).
inline double bank_for_curvature(double curvature_ratio, double ground_speed_mps, double crab_rad,
                                 double gravity_mps2 = 9.80665) {
  return std::atan(ground_speed_mps * ground_speed_mps * curvature_ratio /
                   (gravity_mps2 * std::max(std::cos(crab_rad), 0.1)));
}

}  // namespace fulmar
