// SPDX-License-Identifier: BSD-3-Clause
// States for the tests of this plugin.
#pragma once
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <numbers>

#include "fulmar/msg/vehicle_state.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace kit {

inline constexpr double deg = std::numbers::pi / 180;

/// Level at 70 m through still air, by default at the Anaconda's cruise speed.
inline fulmar::VehicleState level(double north_m = 0, double east_m = 0, double course_rad = 0,
                                  double airspeed_mps = 17) {
  fulmar::VehicleState s;
  s.position_m = {north_m, east_m, -70};
  s.velocity_mps = {airspeed_mps * std::cos(course_rad), airspeed_mps * std::sin(course_rad), 0};
  s.height_m = 70;
  s.course_rad = s.yaw_rad = course_rad;
  s.airspeed_mps = s.ground_speed_mps = airspeed_mps;
  s.specific_force_mps2 = {0, 0, -9.80665};
  s.origin_altitude_m = fulmar::test::FlightModel::field_m;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = s.wind_valid =
      true;
  return s;
}

template <class P>
void give_anaconda(P& params) {
  params.airframe.value = fulmar::test::anaconda();
  params.airframe.is_given = true;
}

}  // namespace kit
