// SPDX-License-Identifier: BSD-3-Clause
// The contract of the role, for any law. Add cases for your own law.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

namespace {

VehicleState flying(double roll_rad = 0, double pitch_rad = 0) {
  VehicleState state;
  state.height_m = 100;
  state.position_m.down = -100;
  state.airspeed_mps = state.ground_speed_mps = 17;
  state.roll_rad = roll_rad;
  state.pitch_rad = pitch_rad;
  state.attitude_valid = state.velocity_valid = state.position_valid = state.height_valid = true;
  state.airspeed_valid = state.origin_valid = state.wind_valid = true;
  return state;
}
AttitudeCommand commanded(double roll_rad = 0, double pitch_rad = 0) {
  AttitudeCommand command;
  command.roll_rad = roll_rad;
  command.pitch_rad = pitch_rad;
  command.throttle_frac = 0.6;
  return command;
}

/// Actuator commands after `seconds` of this input.
Actuators after(double seconds, Bench<MyLaw>& bench, const VehicleState& state,
                const AttitudeCommand& command) {
  for (int i = 0; i < seconds * 100; ++i) {
    bench.set(bench.in.state, state);
    bench.set(bench.in.attitude, command);
    REQUIRE(bench.step(0.01) == Status::ok);
  }
  return bench.out.actuators;
}
Actuators after(double seconds, const VehicleState& state, const AttitudeCommand& command) {
  Bench<MyLaw> bench;
  return after(seconds, bench, state, command);
}

}  // namespace

TEST_CASE("what it says is finite and in range, also far from what is commanded, and takes no memory") {
  Bench<MyLaw> bench;
  for (int i = 0; i < 1000; ++i) {
    VehicleState state = flying(1.5 * std::sin(0.03 * i), 0.8 * std::sin(0.05 * i));
    state.rate_radps = {2 * std::cos(0.03 * i), std::cos(0.05 * i), std::sin(0.02 * i)};
    state.airspeed_mps = 15 + 15 * std::sin(0.01 * i);
    bench.set(bench.in.state, state);
    bench.set(bench.in.attitude, commanded(-std::sin(0.07 * i), 0.5 * std::cos(0.02 * i)));
    REQUIRE(allocations([&] { REQUIRE(bench.step(0.01) == Status::ok); }) == 0);
    REQUIRE(bench.validation_error() == "");
  }
}

TEST_CASE("a command to the right moves the aileron right, a nose too high brings the elevator down") {
  CHECK(after(0.2, flying(), commanded(0.1)).aileron_rad >
        after(0.2, flying(), commanded(-0.1)).aileron_rad + 0.01);
  CHECK(after(0.2, flying(0, 0.1), commanded()).elevator_rad >
        after(0.2, flying(0, -0.1), commanded()).elevator_rad + 0.01);
}

TEST_CASE("more throttle asked for is more throttle given") {
  AttitudeCommand low = commanded(), high = commanded();
  low.throttle_frac = 0.2;
  high.throttle_frac = 0.8;
  CHECK(after(1, flying(), high).throttle_frac > after(1, flying(), low).throttle_frac + 0.1);
}

TEST_CASE("it takes over without a bump from one that flew the same") {
  Bench<MyLaw> before, next;
  const Actuators last = after(2, before, flying(), commanded(0.02, 0.01));
  next.set(next.in.state, flying());
  next.set(next.in.attitude, commanded(0.02, 0.01));
  if constexpr (detail::TakesApplied<MyLaw> || detail::TakesOutputs<MyLaw>)
    REQUIRE(next.activate(before.out) == Status::ok);
  const Actuators first = after(0.01, next, flying(), commanded(0.02, 0.01));
  CHECK(std::abs(first.aileron_rad - last.aileron_rad) < 0.02);
  CHECK(std::abs(first.elevator_rad - last.elevator_rad) < 0.02);
  CHECK(std::abs(first.throttle_frac - last.throttle_frac) < 0.02);
}
