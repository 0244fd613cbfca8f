// SPDX-License-Identifier: BSD-3-Clause
// A kinematic aircraft for closed-loop tests: coordinated turns in wind, first-order roll, airspeed and climb
// behind simple autopilot loops.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::test {

struct Kinematic {
  double north = 0, east = 0, height = 50, psi = 0, roll = 0, roll_c = 0, Va = 17, climb = 0;
  double wind_north = 0, wind_east = 0;
  bool knows_wind = true;

  VehicleState state() const {
    VehicleState s;
    const double vn = Va * std::cos(psi) + wind_north, ve = Va * std::sin(psi) + wind_east;
    s.position_m = {north, east, -height};
    s.velocity_mps = {vn, ve, -climb};
    s.roll_rad = roll;
    s.yaw_rad = wrap_pi(psi);
    s.height_m = height;
    s.climb_rate_mps = climb;
    s.ground_speed_mps = std::hypot(vn, ve);
    s.course_rad = std::atan2(ve, vn);
    s.airspeed_mps = Va;
    s.wind_mps = {wind_north, wind_east, 0};
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
    s.wind_valid = knows_wind;
    return s;
  }

  /// Autopilot loops as a successive-loop controller would have them, then the aircraft.
  void step(const GuidanceCommand& command, double dt) {
    constexpr double g = 9.80665;
    const VehicleState s = state();
    const double wanted = std::clamp(
        2.0 * wrap_pi(command.course_rad - s.course_rad) + command.roll_feedforward_rad, -0.785, 0.785);
    const double smooth = wanted + std::exp(-dt / 0.1) * (roll_c - wanted);
    roll_c += std::clamp(smooth - roll_c, -1.0 * dt, 1.0 * dt);
    roll += dt / 0.25 * (roll_c - roll);
    psi += dt * g / Va * std::tan(roll);
    Va += dt / 1.5 * (command.airspeed_mps - Va);
    const double climb_c = std::clamp(command.climb_rate_mps + 0.4 * (command.height_m - height), -4.0, 4.0);
    climb += dt / 0.5 * (climb_c - climb);
    north += dt * (Va * std::cos(psi) + wind_north);
    east += dt * (Va * std::sin(psi) + wind_east);
    height += dt * climb;
  }
};

}  // namespace fulmar::test
