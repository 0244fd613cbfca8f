// SPDX-License-Identifier: BSD-3-Clause
// The contract of a vehicle, for any vehicle. Add cases for your own one.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "my_law.hpp"

TEST_CASE("time goes forward in each tick, what it says is finite and in range, and a tick takes no memory") {
  Bench<MyLaw> bench;
  bench.configure();
  for (int i = 0; i < 4000; ++i) {
    const std::int64_t before = bench.tick.now_ns;
    REQUIRE(allocations([&] { REQUIRE(bench.read() == Status::ok); }) == 0);
    if (i > 0) REQUIRE(bench.tick.now_ns > before);
    REQUIRE(bench.validation_error() == "");
    bench.set(bench.in.actuators, Actuators{0.5, 0.3 * std::sin(0.01 * i), 0.1, -0.1});
    REQUIRE(allocations([&] { REQUIRE(bench.write() == Status::ok); }) == 0);
  }
}

TEST_CASE("each request to arm is answered, and it does not need a command to go on") {
  Bench<MyLaw> bench;
  for (const bool armed : {true, false}) {
    REQUIRE(bench.read() == Status::ok);
    bench.push(bench.in.arm, {armed});
    REQUIRE(bench.write() == Status::ok);
    CHECK(bench.answer(bench.in.arm) != "unanswered");
  }
}
