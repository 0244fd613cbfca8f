// SPDX-License-Identifier: BSD-3-Clause
// State of the link to another aircraft, and the conditions of each value.
#include "neighbour.hpp"

#include <doctest/doctest.h>

#include "scene.hpp"

namespace neighbour_test {

using namespace fulmar;
using namespace fulmar::formation;
using namespace fulmar::formation::testing;

TEST_CASE("the link to another aircraft: never, heard, silent, and heard again") {
  Bench<Neighbour> bench;
  bench.params.timeout.value = 0.5;
  bench.set(bench.in.state, flying({0, 0, -70}, 0));
  CHECK(bench.step(0.1) == Status::degraded);
  CHECK(bench.out.sight.hearing == Hearing::never);
  CHECK_FALSE(bench.out.other.written);
  bench.set(bench.in.heard, flying({30, 40, -70}, 0));
  CHECK(bench.step(0.1) == Status::ok);
  CHECK(bench.out.sight.hearing == Hearing::heard);
  for (int k = 0; k < 5; ++k) bench.step(0.1);
  CHECK(bench.out.sight.hearing == Hearing::silent);
  CHECK(bench.out.sight.distance_m == 1e9);
  bench.set(bench.in.heard, flying({30, 40, -70}, 0));
  CHECK(bench.step(0.1) == Status::ok);
  CHECK(bench.out.sight.hearing == Hearing::heard);
}

TEST_CASE("each received state is published once, with the time of sending") {
  Bench<Neighbour> bench;
  bench.params.latency.value = 0.03;
  bench.set(bench.in.state, flying({0, 0, -70}, 0));
  bench.step(0.1);
  bench.set(bench.in.heard, flying({30, 40, -70}, 0));  // at 0.1 s
  bench.step(0.01);
  REQUIRE(bench.out.other.written);
  CHECK(bench.out.other.value.position_m.east == 40);
  CHECK(bench.out.other.valid_at_ns == 70'000'000);
  CHECK(bench.out.sight.age_s == doctest::Approx(0.04));
  bench.step(0.01);
  CHECK_FALSE(bench.out.other.written);
}

TEST_CASE("an aircraft that does not know where it is, or counts from another point, is not passed on") {
  Bench<Neighbour> bench;
  bench.set(bench.in.state, flying({0, 0, -70}, 0));
  VehicleState lost = flying({30, 40, -70}, 0), elsewhere = lost, unknown = lost;
  lost.position_valid = false;
  elsewhere.origin_latitude_deg += 1e-4;  // 11 m
  unknown.origin_valid = false;
  for (const auto& [state, expected] :
       {std::pair{lost, Hearing::lost}, std::pair{elsewhere, Hearing::other_origin},
        std::pair{unknown, Hearing::other_origin}}) {
    bench.set(bench.in.heard, state);
    CHECK(bench.step(0.01) == Status::degraded);
    CHECK(bench.out.sight.hearing == expected);
    CHECK_FALSE(bench.out.other.written);
  }
}

TEST_CASE("the distance is that of now, and the least one counts in the air alone") {
  Bench<Neighbour> bench;
  bench.set(bench.in.state, flying({0, 0, 0}, 0));
  bench.set(bench.in.heard, flying({3, 4, 0}, 0));
  bench.step(0.1);
  CHECK(bench.out.sight.least_distance_m == 1e9);
  bench.set(bench.in.heard, flying({3, 4, -70}, 0));  // one of the two is still on the ground
  bench.step(0.1);
  CHECK(bench.out.sight.least_distance_m == 1e9);
  VehicleState here = flying({0, 0, -70}, 0);
  bench.set(bench.in.state, here);
  bench.set(bench.in.heard, flying({0, 30, -70}, 0, 20));  // northwards with 20 m/s
  bench.step(2.5);                                         // travels 50 m
  CHECK(bench.out.sight.hearing == Hearing::silent);
  bench.params.timeout.value = 5;
  bench.retune();
  bench.step(0);
  CHECK(bench.out.sight.distance_m == doctest::Approx(std::hypot(50, 30)));
  CHECK(bench.out.sight.least_distance_m == doctest::Approx(std::hypot(50, 30)));
  bench.set(bench.in.heard, flying({0, 30, -70}, 0, 20));
  bench.step(4);
  CHECK(bench.out.sight.distance_m == doctest::Approx(std::hypot(80, 30)));
  CHECK(bench.out.sight.least_distance_m == doctest::Approx(std::hypot(50, 30)));
}

TEST_CASE("a step of it allocates nothing") {
  Bench<Neighbour> bench;
  bench.set(bench.in.state, flying({0, 0, -70}, 0));
  bench.set(bench.in.heard, flying({3, 4, -70}, 0));
  bench.step(0.01);
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

}  // namespace neighbour_test
