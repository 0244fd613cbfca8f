// SPDX-License-Identifier: BSD-3-Clause
// States and signals for the tests of this plugin.
#pragma once
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <numbers>
#include <vector>

#include "plugins/signal/attitude.hpp"
#include "plugins/signal/guidance.hpp"
#include "plugins/signal/surfaces.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace kit {

using namespace fulmar;
using signal::Shape;

inline constexpr double deg = std::numbers::pi / 180;

/// Level at 70 m, at the Anaconda's cruise speed.
inline VehicleState level() {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = 17;
  s.attitude_valid = s.velocity_valid = s.height_valid = s.airspeed_valid = true;
  return s;
}

inline signal::SignalParams signal_of(Shape shape, double duration = 4, double f0 = 0.5, double f1 = 3) {
  signal::SignalParams p;
  p.shape.value = shape;
  p.duration.value = duration;
  p.frequency.value = f0;
  p.frequency_end.value = f1;
  return p;
}

/// A bench of one of the components, with the Anaconda, at once and without a delay.
template <class C>
struct Stand : Bench<C> {
  VehicleState state = level();
  Stand() {
    this->params.bounds.airframe.value = test::anaconda();
    this->params.bounds.airframe.is_given = true;
    this->params.signal.delay.value = 0;
  }
  template <class Command>
  Status fly(const In<Command>& port, const Command& command, double dt = 0.01) {
    this->retune();
    this->set(port, command);
    this->set(this->in.signal.state, state);
    return this->step(dt);
  }
};

}  // namespace kit
