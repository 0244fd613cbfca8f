// SPDX-License-Identifier: BSD-3-Clause
// The contract of the role, for any law. Add cases for your own law.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

namespace {

/// Level flight north at 17 m/s, as commanded.
VehicleState flying(double course_rad = 0, double height_m = 100) {
  VehicleState state;
  state.height_m = height_m;
  state.position_m.down = -height_m;
  state.airspeed_mps = state.ground_speed_mps = 17;
  state.course_rad = state.yaw_rad = course_rad;
  state.velocity_mps = {17 * std::cos(course_rad), 17 * std::sin(course_rad), 0};
  state.attitude_valid = state.velocity_valid = state.position_valid = state.height_valid = true;
  state.airspeed_valid = state.origin_valid = state.wind_valid = true;
  return state;
}
GuidanceCommand commanded(double course_rad = 0, double height_m = 100) {
  GuidanceCommand command;
  command.course_rad = course_rad;
  command.height_m = height_m;
  command.airspeed_mps = 17;
  return command;
}

/// Attitude command after `seconds` of this input.
AttitudeCommand after(double seconds, Bench<MyLaw>& bench, const VehicleState& state,
                      const GuidanceCommand& command) {
  for (int i = 0; i < seconds * 100; ++i) {
    bench.set(bench.in.state, state);
    bench.set(bench.in.command, command);
    REQUIRE(bench.step(0.01) == Status::ok);
  }
  return bench.out.attitude;
}
AttitudeCommand after(double seconds, const VehicleState& state, const GuidanceCommand& command) {
  Bench<MyLaw> bench;
  return after(seconds, bench, state, command);
}

}  // namespace

TEST_CASE("what it says is finite and in range, also far from what is commanded, and takes no memory") {
  Bench<MyLaw> bench;
  for (int i = 0; i < 1000; ++i) {
    VehicleState state = flying(std::remainder(0.05 * i, 6.28), 100 + 90 * std::sin(0.02 * i));
    state.roll_rad = 0.8 * std::sin(0.03 * i);
    state.airspeed_mps = 15 + 10 * std::sin(0.01 * i);
    bench.set(bench.in.state, state);
    bench.set(bench.in.command, commanded(std::remainder(-0.07 * i, 6.28), 100 - 50 * std::sin(0.05 * i)));
    REQUIRE(allocations([&] { REQUIRE(bench.step(0.01) == Status::ok); }) == 0);
    REQUIRE(bench.validation_error() == "");
  }
}

TEST_CASE("it turns towards the commanded course, through north and south as well") {
  const double straight = after(0.5, flying(), commanded()).roll_rad;
  CHECK(after(0.5, flying(), commanded(0.5)).roll_rad > straight + 0.01);
  CHECK(after(0.5, flying(), commanded(-0.5)).roll_rad < straight - 0.01);
  CHECK(after(0.5, flying(3.1), commanded(-3.1)).roll_rad > straight + 0.01);  // 0.083 rad to the right
}

TEST_CASE("below the commanded height there is more pitch or more power than above it") {
  const AttitudeCommand low = after(1, flying(0, 80), commanded()),
                        high = after(1, flying(0, 120), commanded());
  CHECK((low.pitch_rad > high.pitch_rad + 0.01 || low.throttle_frac > high.throttle_frac + 0.01));
}

TEST_CASE("it takes over without a bump from one that flew the same") {
  Bench<MyLaw> before, next;
  const AttitudeCommand last = after(2, before, flying(), commanded(0.02, 100.5));
  next.set(next.in.state, flying());
  next.set(next.in.command, commanded(0.02, 100.5));
  if constexpr (detail::TakesApplied<MyLaw> || detail::TakesOutputs<MyLaw>)
    REQUIRE(next.activate(before.out) == Status::ok);
  const AttitudeCommand first = after(0.01, next, flying(), commanded(0.02, 100.5));
  CHECK(std::abs(first.roll_rad - last.roll_rad) < 0.02);
  CHECK(std::abs(first.pitch_rad - last.pitch_rad) < 0.02);
  CHECK(std::abs(first.throttle_frac - last.throttle_frac) < 0.02);
}
