// SPDX-License-Identifier: BSD-3-Clause
// The contract of the role, for any law. Add cases for your own law.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>
#include <numbers>

#include "my_law.hpp"

namespace {

/// Level flight north over (north, east), at 17 m/s.
VehicleState flying(double north_m, double east_m) {
  VehicleState state;
  state.position_m = {north_m, east_m, -70};
  state.height_m = 70;
  state.airspeed_mps = state.ground_speed_mps = 17;
  state.velocity_mps = {17, 0, 0};
  state.attitude_valid = state.velocity_valid = state.position_valid = state.height_valid = true;
  state.airspeed_valid = state.origin_valid = state.wind_valid = true;
  return state;
}
Path line() {
  Path path;
  path.origin_m = {0, 0, -70};
  path.airspeed_mps = 17;
  return path;
}
Path orbit(Turn turn) {
  Path path = line();
  path.kind = PathKind::orbit;
  path.turn = turn;
  path.radius_m = 60;
  return path;
}

/// Commanded turn to the right, rad: course change plus bank.
double turn(const VehicleState& state, const Path& path) {
  Bench<MyLaw> bench;
  for (int i = 0; i < 50; ++i) {
    bench.set(bench.in.state, state);
    bench.set(bench.in.path, path);
    REQUIRE(bench.step(0.01) == Status::ok);
  }
  return std::remainder(bench.out.command.course_rad - state.course_rad, 2 * std::numbers::pi) +
         bench.out.command.roll_feedforward_rad;
}

}  // namespace

TEST_CASE("what it says is finite and in range, wherever it is, and takes no memory") {
  Bench<MyLaw> bench;
  for (int i = 0; i < 1000; ++i) {
    bench.set(bench.in.state, flying(500 * std::sin(0.03 * i), 500 * std::sin(0.05 * i)));
    bench.set(bench.in.path, i / 100 % 2 == 0 ? line() : orbit(i / 200 % 2 == 0 ? Turn::right : Turn::left));
    REQUIRE(allocations([&] { REQUIRE(bench.step(0.01) == Status::ok); }) == 0);
    REQUIRE(bench.validation_error() == "");
    REQUIRE(std::abs(bench.out.command.height_m - 70) < 1);
    REQUIRE(std::abs(bench.out.command.airspeed_mps - 17) < 5);
  }
}

TEST_CASE("right of a line it turns left, left of it right") {
  CHECK(turn(flying(0, 35), line()) < -0.05);
  CHECK(turn(flying(0, -35), line()) > 0.05);
}

TEST_CASE("on an orbit it goes round the way that is asked for") {
  CHECK(turn(flying(0, -60), orbit(Turn::right)) > 0.05);  // tangent already: the bank of the turn alone
  CHECK(turn(flying(0, 60), orbit(Turn::left)) < -0.05);
}

TEST_CASE("it takes over without a bump from one that flew the same") {
  Bench<MyLaw> before, next;
  for (int i = 0; i < 201; ++i)
    for (auto* bench : {&before, &next}) {
      bench->set(bench->in.state, flying(0, 3));
      bench->set(bench->in.path, line());
      if (bench == &next && i < 200) continue;
      if constexpr (detail::TakesApplied<MyLaw> || detail::TakesOutputs<MyLaw>)
        if (bench == &next) REQUIRE(next.activate(before.out) == Status::ok);
      REQUIRE(bench->step(0.01) == Status::ok);
    }
  const GuidanceCommand &last = before.out.command, &first = next.out.command;
  CHECK(std::abs(std::remainder(first.course_rad - last.course_rad, 2 * std::numbers::pi)) < 0.05);
  CHECK(std::abs(first.height_m - last.height_m) < 0.5);
  CHECK(std::abs(first.roll_feedforward_rad - last.roll_feedforward_rad) < 0.05);
}
