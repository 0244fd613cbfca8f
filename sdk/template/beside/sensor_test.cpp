// SPDX-License-Identifier: BSD-3-Clause
// The contract, for any sensor. Add cases for your own one.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

namespace {

VehicleState flying(int i) {
  VehicleState state;
  state.height_m = 50 + 0.1 * i;
  state.roll_rad = 0.6 * std::sin(0.1 * i);
  state.attitude_valid = state.height_valid = true;
  return state;
}

}  // namespace

TEST_CASE("it says what is finite and in range, never of a time to come, and takes no memory") {
  Bench<MyLaw> bench;
  for (int i = 0; i < 200; ++i) {
    bench.set(bench.in.state, flying(i), 0.01);
    REQUIRE(bench.step(0.05) == Status::ok);
    REQUIRE(bench.validation_error() == "");
    for (std::uint32_t k = 0; k < bench.out.range.count; ++k)
      REQUIRE(bench.out.range.stamps_ns[k] <= bench.tick.now_ns);
  }
  CHECK(allocations([&] { bench.step(0.05); }) == 0);
}

TEST_CASE("one seed gives one series of measurements") {
  Bench<MyLaw> a(1), same(1);
  for (int i = 0; i < 100; ++i) {
    for (auto* bench : {&a, &same}) {
      bench->set(bench->in.state, flying(i));
      REQUIRE(bench->step(0.05) == Status::ok);
    }
    REQUIRE(a.out.range.count == same.out.range.count);
    for (std::uint32_t k = 0; k < a.out.range.count; ++k)
      REQUIRE(a.out.range.items[k].range_m == same.out.range.items[k].range_m);
  }
}
