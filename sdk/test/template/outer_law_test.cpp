// SPDX-License-Identifier: BSD-3-Clause
// Textbook figures of the generated law of `fulmar new`. Its own test states the contract alone.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#define MyLaw OuterTemplate
#include "sdk/template/roles/outer.hpp"
#undef MyLaw

TEST_CASE("a course error wraps through north") {
  Bench<OuterTemplate> bench;
  VehicleState state;
  GuidanceCommand command;
  state.course_rad = 3.1;     // just east of south
  command.course_rad = -3.1;  // just west of south: 0.083 rad to the right
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.attitude.roll_rad == doctest::Approx(1.2 * (2 * std::numbers::pi - 6.2)));
}

TEST_CASE("below the commanded height the nose goes up, within its limit") {
  Bench<OuterTemplate> bench;
  VehicleState state;
  GuidanceCommand command;
  command.height_m = 100;
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.25));
  CHECK(bench.out.height_error_m.value == doctest::Approx(100));
}
