// SPDX-License-Identifier: BSD-3-Clause
// The examples of sdk/README.md, compiled as printed.
#include <doctest/doctest.h>

#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/testing.hpp"

namespace readme_test {

using namespace fulmar;

#include "readme_examples.hpp"

TEST_CASE("the example of a queue: samples come oldest first, with their time of validity") {
  Bench<GroundHeight> bench;
  VehicleState state;
  state.climb_rate_mps = 2;
  bench.set(bench.in.state, state);
  bench.tick.now_ns = 1'000'000'000;
  bench.push(bench.in.distance, {38, true}, 0.10);
  bench.push(bench.in.distance, {40, true}, 0.05);
  bench.push(bench.in.distance, {0, false}, 0.01);
  REQUIRE(bench.step(0.05) == Status::ok);
  CHECK(bench.out.late_s.value == doctest::Approx(0.1));  // 0.05 s old on arrival, 0.05 s later
  CHECK(bench.out.height_m.value == doctest::Approx(40.2));
  REQUIRE(bench.step(0.05) == Status::ok);
  CHECK_FALSE(bench.out.height_m.written);  // each is published once
}

TEST_CASE("the example of a matrix") {
  Bench<StateFeedback> bench;
  VehicleState state;
  state.roll_rad = 0.5;
  state.rate_radps.x = -1;
  bench.params.K.value[0][1] = 0.2;
  bench.set(bench.in.state, state);
  REQUIRE(bench.step(0.01) == Status::ok);
  CHECK(bench.out.aileron_rad.value == doctest::Approx(-0.8 * 0.5 + 0.2));
}

TEST_CASE("an input has its time of validity in seconds") {
  Bench<GroundHeight> bench;
  bench.tick.now_ns = 2'500'000'000;
  bench.set(bench.in.state, VehicleState{}, 0.5);
  CHECK(bench.in.state.valid_at_s() == doctest::Approx(2.0));
}

}  // namespace readme_test
