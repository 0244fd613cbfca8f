// SPDX-License-Identifier: BSD-3-Clause
// The contract, for any planner. Add cases for your own one.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

TEST_CASE(
    "in a flight along a plan it says what is finite and in range, never more than it has room for, and "
    "takes no memory") {
  Bench<MyLaw> bench;
  Progress progress;
  VehicleState state;
  progress.items = 4;
  for (std::uint32_t i = 0; i < 400; ++i) {
    progress.reached = i / 20;
    progress.item = progress.reached % 4;
    progress.circuits = progress.reached / 4;
    state.position_m = {10.0 * i, 0, -70};
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, state);
    REQUIRE(allocations([&] { REQUIRE(bench.step(0.1) == Status::ok); }) == 0);
    REQUIRE(bench.validation_error() == "");
    REQUIRE(bench.out.edits.lost == 0);
  }
}
