// SPDX-License-Identifier: BSD-3-Clause
// Shape of the sticks, time-out, and the blend between sources, against closed forms.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/control_manual/pilot.hpp"

#include <fulmar/testing.hpp>

#include "kit.hpp"

namespace pilot_test {

using namespace fulmar;
using manual::Blend;
using manual::Pilot;

TEST_CASE("a stick within the dead zone is in the middle, and its end is the end") {
  for (double x : {0.0, 0.03, -0.03, 0.05, -0.05}) CHECK(shaped(x, 0.05, 0.3) == 0);
  for (double expo : {0.0, 0.3, 1.0}) {
    CHECK(shaped(1, 0.05, expo) == doctest::Approx(1));
    CHECK(shaped(-1, 0.05, expo) == doctest::Approx(-1));
  }
}

TEST_CASE("expo is a share of the cube of what is left of the dead zone, and odd") {
  // (0.62 - 0.05) / 0.95 = 0.6; 0.7 * 0.6 + 0.3 * 0.216 = 0.4848
  CHECK(shaped(0.62, 0.05, 0.3) == doctest::Approx(0.4848).epsilon(1e-12));
  CHECK(shaped(-0.62, 0.05, 0.3) == doctest::Approx(-0.4848).epsilon(1e-12));
  CHECK(shaped(0.5, 0, 1) == doctest::Approx(0.125));
}

TEST_CASE(
    "a blend begins with what was applied, forgets it by its time constant, and begins anew with a source") {
  Blend blend;
  blend.begin(1);
  CHECK(blend.step(0.2, 0, std::exp(-0.02)) == doctest::Approx(1));
  double y = 0;
  for (int i = 0; i < 50; ++i) y = blend.step(0.2, 0, std::exp(-0.02));
  CHECK(y ==
        doctest::Approx(0.2 + 0.8 * (1 + 1) * std::exp(-1.0)));  // critically damped, a time constant later
  CHECK(blend.step(-3, 1, std::exp(-0.02)) == doctest::Approx(y));
  blend.kept(0.5);  // a limit has left no more of it
  CHECK(blend.step(-3, 2, std::exp(-0.02)) == doctest::Approx(0.5));
  Blend fresh;
  CHECK(fresh.step(0.7, 0, std::exp(-0.02)) == 0.7);
}

TEST_CASE("the pilot is there as long as frames come, with their link, and mean something") {
  Bench<Pilot> bench;
  bench.step(0.01);
  CHECK(bench.out.there_ratio.value == 0);  // no frame yet: not a stick at its end
  CHECK_FALSE(bench.out.rc.link);
  bench.set(bench.in.rc, kit::stick());
  bench.step(0.4);
  CHECK(bench.out.there_ratio.value == 1);
  CHECK(bench.out.stick_age_s.value == doctest::Approx(0.4));
  CHECK(bench.out.rc.throttle_frac == 0.57);
  bench.step(0.2);
  CHECK(bench.out.there_ratio.value == 0);
  Rc rc = kit::stick();
  rc.link = false;
  bench.set(bench.in.rc, rc);
  bench.step(0.01);
  CHECK(bench.out.there_ratio.value == 0);
  rc = kit::stick(std::nan(""));
  bench.set(bench.in.rc, rc);
  bench.step(0.01);
  CHECK(bench.out.there_ratio.value == 0);
  CHECK(bench.out.stick_age_s.value == 1e9);
  bench.set(bench.in.rc, kit::stick());
  bench.step(0.01);
  CHECK(bench.out.there_ratio.value == 1);
}

TEST_CASE("sticks beyond their ends count as their ends, and without a pilot as the middle") {
  Bench<Pilot> bench;
  manual::StickParams p;
  p.dead_zone.value = p.expo.value = 0;
  bench.set(bench.in.rc, kit::stick(1.7, -2, 1.4));
  manual::Sticks s = manual::sticks(bench.in.rc, bench.tick, p);
  CHECK(s.there);
  CHECK(s.roll == 1);
  CHECK(s.pitch == -1);
  CHECK(s.throttle == 1);
  bench.step(1);
  s = manual::sticks(bench.in.rc, bench.tick, p);
  CHECK_FALSE(s.there);
  CHECK(s.roll == 0);
  CHECK(s.pitch == 0);
}

}  // namespace pilot_test
