// SPDX-License-Identifier: BSD-3-Clause
// Circles to both sides, at the present place and round a point, and a change of height at a given rate.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>

#include "plugins/path/loiter.hpp"

namespace waiting_test {

using namespace fulmar;
using path::Loiter;

namespace {

/// An aircraft that follows course and climb at once, at 20 m/s.
struct Point {
  Bench<Loiter> bench;
  VehicleState s;
  explicit Point(Turn turn = Turn::left) {
    bench.params.airframe.value.limits.airspeed_cruise_mps = 17;
    bench.params.turn.value = turn;
    bench.params.radius.value = 80;
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
    s.ground_speed_mps = s.airspeed_mps = 20;
    s.position_m = {100, 50, -60};
    s.height_m = 60;
    s.course_rad = s.yaw_rad = 1;
  }
  const GuidanceCommand& step() {
    bench.set(bench.in.state, s);
    bench.step(0.01);
    return bench.out.command;
  }
  void fly(double seconds) {
    for (double t = 0; t < seconds - 1e-9; t += 0.01) {
      const GuidanceCommand& c = step();
      s.course_rad = s.yaw_rad = c.course_rad;
      s.position_m.north += 0.2 * std::cos(s.course_rad);
      s.position_m.east += 0.2 * std::sin(s.course_rad);
      s.height_m += 0.01 * c.climb_rate_mps;
    }
  }
};

}  // namespace

TEST_CASE("it begins on a circle beside it, along its course, with the bank of the circle, to either side") {
  for (const Turn turn : {Turn::left, Turn::right}) {
    const double side = turn == Turn::right ? 1 : -1;
    Point p(turn);
    p.bench.set(p.bench.in.state, p.s);
    p.bench.activate();
    const GuidanceCommand& c = p.step();
    CHECK(c.course_rad == doctest::Approx(1));
    CHECK(c.roll_feedforward_rad == doctest::Approx(side * std::atan(20 * 20 / (9.80665 * 80))));
    CHECK(c.height_m == 60);
    CHECK(c.climb_rate_mps == 0);
    CHECK(c.airspeed_mps == 17);
    CHECK(p.bench.out.progress.there);
    // One lap, 80 m about the point to its side, takes 2 pi 80 / 20 s.
    p.fly(2 * 3.14159265 * 80 / 20);
    CHECK(p.bench.out.progress.laps_ratio == doctest::Approx(1).epsilon(0.01));
    CHECK(std::hypot(p.s.position_m.north - (100 - side * 80 * std::sin(1)),
                     p.s.position_m.east - (50 + side * 80 * std::cos(1))) ==
          doctest::Approx(80).epsilon(0.02));
  }
}

TEST_CASE("it finds the circle round a point from far away, and counts laps from there on") {
  Point p(Turn::right);
  p.bench.params.at.value = path::LoiterAt::point;
  p.bench.params.north.value = -400;
  p.bench.params.east.value = 300;
  p.fly(5);
  CHECK_FALSE(p.bench.out.progress.there);
  CHECK(p.bench.out.progress.laps_ratio == 0);
  p.fly(60);
  CHECK(std::hypot(p.s.position_m.north + 400, p.s.position_m.east - 300) ==
        doctest::Approx(80).epsilon(0.02));
  CHECK(p.bench.out.progress.there);
  CHECK(p.bench.out.progress.laps_ratio > 0.5);
  CHECK(std::abs(p.bench.out.progress.cross_m) < 2);
}

TEST_CASE("up and down the height that is asked for goes by its rate, and says when it is there") {
  for (const double height : {90.0, 30.0}) {
    CAPTURE(height);
    Point p;
    p.bench.set(p.bench.in.state, p.s);
    p.bench.activate();
    p.bench.params.height.value = height;
    p.bench.params.rate.value = 3;
    p.bench.params.airspeed.value = 15;
    p.bench.retune();
    p.fly(5);
    CHECK(p.bench.out.command.height_m == doctest::Approx(60 + (height > 60 ? 15 : -15)));
    CHECK(p.bench.out.command.climb_rate_mps == (height > 60 ? 3 : -3));
    CHECK(p.bench.out.command.airspeed_mps == 15);
    CHECK_FALSE(p.bench.out.progress.there);
    p.fly(6);
    CHECK(p.bench.out.command.height_m == doctest::Approx(height));
    CHECK(p.bench.out.command.climb_rate_mps == 0);
    CHECK(p.bench.out.progress.there);
    // A second activation begins with the present height.
    p.bench.params.height.value = -1;
    p.bench.retune();
    p.s.height_m = 44;
    p.bench.set(p.bench.in.state, p.s);
    p.bench.activate();
    CHECK(p.step().height_m == 44);
    CHECK(p.bench.out.progress.laps_ratio < 0.01);
  }
}

TEST_CASE("without a position it circles through the air, and straight on without an attitude") {
  Point p(Turn::right);
  p.step();
  p.s.position_valid = false;
  p.bench.set(p.bench.in.state, p.s);
  CHECK(p.bench.step(0.01) == Status::degraded);
  CHECK(p.bench.out.command.course_rad == 1);
  CHECK(p.bench.out.command.roll_feedforward_rad == doctest::Approx(std::atan(20 * 20 / (9.80665 * 80))));
  CHECK_FALSE(p.bench.out.progress.there);
  p.s.attitude_valid = false;
  CHECK(p.step().roll_feedforward_rad == 0);
}

}  // namespace waiting_test
