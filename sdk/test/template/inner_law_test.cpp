// SPDX-License-Identifier: BSD-3-Clause
// Textbook figures of the generated law of `fulmar new`. Its own test states the contract alone.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#define MyLaw InnerTemplate
#include "sdk/template/roles/inner.hpp"
#undef MyLaw

TEST_CASE("a command to the right moves the aileron right, a nose too high brings the elevator down") {
  Bench<InnerTemplate> bench;
  AttitudeCommand command;
  command.roll_rad = 0.1;
  command.throttle_frac = 0.6;
  VehicleState state;
  state.pitch_rad = 0.05;
  state.airspeed_mps = 17;
  bench.set(bench.in.attitude, command);
  bench.set(bench.in.state, state);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(1.2 * 0.1));
  CHECK(bench.out.actuators.elevator_rad == doctest::Approx(4.0 * 0.05));
  CHECK(bench.out.actuators.rudder_rad == doctest::Approx(0));
  CHECK(bench.out.actuators.throttle_frac == doctest::Approx(0.6));
}

TEST_CASE("the rates of a steady turn are not damped") {
  Bench<InnerTemplate> bench;
  AttitudeCommand command;
  VehicleState state;
  command.roll_rad = state.roll_rad = 0.5;
  state.airspeed_mps = 20;
  const double chi_dot = 9.80665 / 20 * std::tan(0.5);
  state.rate_radps = {0, chi_dot * std::sin(0.5), chi_dot * std::cos(0.5)};
  bench.set(bench.in.attitude, command);
  bench.set(bench.in.state, state);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.actuators.elevator_rad == doctest::Approx(0));
  CHECK(bench.out.actuators.rudder_rad == doctest::Approx(0));
}

TEST_CASE("no surface moves beyond its throw") {
  Bench<InnerTemplate> bench;
  bench.params.airframe.value.aileron.limit_rad = 0.3;
  AttitudeCommand command;
  command.roll_rad = 3;
  bench.set(bench.in.attitude, command);
  bench.set(bench.in.state, VehicleState{});
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.3));
}
