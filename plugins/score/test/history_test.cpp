// SPDX-License-Identifier: BSD-3-Clause
// The recent truth at any time: each of its 13 numbers has a slope of its own, samples come unevenly.
#include <doctest/doctest.h>

#include <cmath>

#include "plugins/score/truth_history.hpp"

namespace history_test {

using namespace fulmar;
using namespace fulmar::score;

namespace {

/// Linear in time; angles go round through south.
Compared at(double t) {
  return {1 + 3 * t,
          -2 + 5 * t,
          70 - 1.5 * t,
          17 + 0.1 * t,
          0.2 - 0.03 * t,
          1 - 0.07 * t,
          15 + 0.2 * t,
          4 - 0.11 * t,
          -3 + 0.13 * t,
          wrap_pi(3 + 0.5 * t),
          wrap_pi(-3 - 0.2 * t),
          wrap_pi(2 + 0.9 * t),
          wrap_pi(-2 - 1.1 * t)};
}
void check_same(const Compared& is, const Compared& wanted) {
  using C = Compared;
  for (const double C::*field : {&C::north, &C::east, &C::height, &C::vel_x, &C::vel_y, &C::vel_z,
                                 &C::airspeed, &C::wind_n, &C::wind_e})
    CHECK(is.*field == doctest::Approx(wanted.*field));
  for (const double C::*angle : {&C::roll, &C::pitch, &C::heading, &C::course})
    CHECK(std::abs(wrap_pi(is.*angle - wanted.*angle)) < 1e-9);
}
std::int64_t time_of(int i) { return 20'000'000LL * i + 3'000'000LL * (i % 3); }

}  // namespace

TEST_CASE("the truth between two samples is on the line between them, for the last 63 gaps and no further") {
  TruthHistory history;
  Compared found;
  CHECK(history.at(0, found) == TruthHistory::Found::not_yet);
  for (int i = 0; i < 200; ++i) {
    history.add(time_of(i), at(1e-9 * static_cast<double>(time_of(i))));
    const int oldest = std::max(0, i - 63);
    for (int k = oldest; k <= i; k += 7)
      for (const std::int64_t before : {0LL, 4'000'000LL, 15'000'000LL}) {
        const std::int64_t t = time_of(k) - before;
        if (t < time_of(oldest)) continue;
        REQUIRE(history.at(t, found) == TruthHistory::Found::yes);
        check_same(found, at(1e-9 * static_cast<double>(t)));
      }
    CHECK(history.at(time_of(oldest) - 1, found) == TruthHistory::Found::too_old);
    CHECK(history.at(time_of(i) + 1, found) == TruthHistory::Found::not_yet);
  }
}

TEST_CASE("a sample that is no newer than the last one is left out") {
  TruthHistory history;
  Compared found;
  history.add(10, at(1));
  history.add(20, at(2));
  history.add(20, at(5));
  history.add(15, at(7));
  REQUIRE(history.at(20, found) == TruthHistory::Found::yes);
  check_same(found, at(2));
  REQUIRE(history.at(15, found) == TruthHistory::Found::yes);
  check_same(found, at(1.5));
}

TEST_CASE("what is compared of a state is each number from its own place, velocity in body axes") {
  VehicleState s;
  s.position_m = {1, 2, -3};
  s.height_m = 4;
  s.airspeed_mps = 5;
  s.wind_mps = {6, 7, 8};
  s.roll_rad = 0.1;
  s.pitch_rad = 0.2;
  s.yaw_rad = 0.3;
  s.course_rad = 0.4;
  s.velocity_mps = {10, 11, 12};
  s.attitude = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // nose to the east: body x is east, y is south
  check_same(compared(s), {1, 2, 4, 11, -10, 12, 5, 6, 7, 0.1, 0.2, 0.3, 0.4});
}

}  // namespace history_test
