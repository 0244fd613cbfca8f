// SPDX-License-Identifier: BSD-3-Clause
// Textbook figures of the generated law of `fulmar new`. Its own test states the contract alone.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#define MyLaw GuideTemplate
#include "sdk/template/roles/guide.hpp"
#undef MyLaw

TEST_CASE("east of a line to the north the course points back, at the carrot") {
  Bench<GuideTemplate> bench;
  VehicleState state;
  state.position_m = {100, 35, -50};
  Path path;
  path.origin_m = {0, 0, -70};
  path.airspeed_mps = 17;
  bench.set(bench.in.state, state);
  bench.set(bench.in.path, path);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.command.course_rad == doctest::Approx(-std::numbers::pi / 4));  // 35 m aside, 35 m ahead
  CHECK(bench.out.command.height_m == doctest::Approx(70));
  CHECK(bench.out.command.airspeed_mps == doctest::Approx(17));
  CHECK(bench.out.cross_track_m.value == doctest::Approx(35));
}

TEST_CASE("on a right orbit, north of its centre, the course is east and the bank that of the turn") {
  Bench<GuideTemplate> bench;
  VehicleState state;
  state.position_m.north = 60;
  state.ground_speed_mps = 20;
  Path path;
  path.kind = PathKind::orbit;
  path.radius_m = 60;
  bench.set(bench.in.state, state);
  bench.set(bench.in.path, path);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.command.course_rad == doctest::Approx(std::numbers::pi / 2));
  CHECK(std::tan(bench.out.command.roll_feedforward_rad) == doctest::Approx(20.0 * 20.0 / (60 * 9.80665)));
}
