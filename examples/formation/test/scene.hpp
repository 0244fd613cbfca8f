// SPDX-License-Identifier: BSD-3-Clause
// Aircraft for the tests of this folder: one at a fixed place, and one that follows commands.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/testing.hpp"

namespace fulmar::formation::testing {

/// Level, straight, without wind.
inline VehicleState flying(Vec3<Ned> at, double course, double speed = 17) {
  VehicleState s;
  s.position_m = at;
  s.velocity_mps = {speed * std::cos(course), speed * std::sin(course), 0};
  s.height_m = -at.down;
  s.course_rad = s.yaw_rad = course;
  s.ground_speed_mps = s.airspeed_mps = speed;
  s.origin_latitude_deg = 40.25;
  s.origin_longitude_deg = -111.6;
  s.origin_altitude_m = 1387;
  s.origin_valid = s.attitude_valid = s.position_valid = s.velocity_valid = s.height_valid = s.wind_valid =
      true;
  return s;
}

/// Coordinated turns in wind; bank, airspeed and height follow their commands with lags.
struct Point {
  double north = 0, east = 0, height = 70, psi = 0, roll = 0, Va = 17, wind_north = 0, wind_east = 0;

  VehicleState state() const {
    VehicleState s = flying({north, east, -height}, 0);
    s.velocity_mps = {Va * std::cos(psi) + wind_north, Va * std::sin(psi) + wind_east, 0};
    s.ground_speed_mps = std::hypot(s.velocity_mps.north, s.velocity_mps.east);
    s.course_rad = std::atan2(s.velocity_mps.east, s.velocity_mps.north);
    s.yaw_rad = wrap_pi(psi);
    s.roll_rad = roll;
    s.airspeed_mps = Va;
    s.wind_mps = {wind_north, wind_east, 0};
    return s;
  }
  void step(const GuidanceCommand& c, double dt) {
    const double wanted = 2 * wrap_pi(c.course_rad - state().course_rad) + c.roll_feedforward_rad;
    roll += dt / 0.3 * (std::clamp(wanted, -0.785, 0.785) - roll);
    psi += dt * 9.80665 / Va * std::tan(roll);
    Va += dt / 1.0 * (c.airspeed_mps - Va);
    height += dt * std::clamp(0.5 * (c.height_m - height), -3.0, 4.0);
    north += dt * (Va * std::cos(psi) + wind_north);
    east += dt * (Va * std::sin(psi) + wind_east);
  }
};

}  // namespace fulmar::formation::testing
