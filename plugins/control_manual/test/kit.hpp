// SPDX-License-Identifier: BSD-3-Clause
// States and sticks for the tests of this plugin.
#pragma once
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <numbers>

#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace kit {

inline constexpr double deg = std::numbers::pi / 180;

/// Level at 70 m, to the north, by default at the Anaconda's cruise speed.
inline fulmar::VehicleState level(double airspeed = 17) {
  fulmar::VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.origin_altitude_m = fulmar::test::FlightModel::field_m;
  s.attitude_valid = s.velocity_valid = s.height_valid = s.airspeed_valid = true;
  return s;
}

/// Sticks without dead zone and expo, and the throttle where cruise is.
inline fulmar::Rc stick(double roll = 0, double pitch = 0, double throttle = 0.57, double yaw = 0) {
  fulmar::Rc rc;
  rc.roll_frac = roll;
  rc.pitch_frac = pitch;
  rc.yaw_frac = yaw;
  rc.throttle_frac = throttle;
  rc.link = true;
  return rc;
}

/// A bench of one of the laws, with the Anaconda and straight sticks.
template <class C>
struct Hand : fulmar::Bench<C> {
  Hand() {
    this->params.airframe.value = fulmar::test::anaconda();
    this->params.airframe.is_given = true;
    this->params.sticks.dead_zone.value = this->params.sticks.expo.value = 0;
  }
  /// A frame and a state now, then a step.
  fulmar::Status fly(const fulmar::Rc& rc, const fulmar::VehicleState& state = level(), double dt = 0.01) {
    this->set(this->in.rc, rc);
    this->set(this->in.state, state);
    return this->step(dt);
  }
};

}  // namespace kit
