// SPDX-License-Identifier: BSD-3-Clause
// Sticks as rates of course, height and airspeed, against their integrals.
#include "plugins/control_manual/guide.hpp"

#include "kit.hpp"

namespace guide_test {

using namespace fulmar;
using kit::deg;
using kit::level;
using kit::stick;
using manual::Guide;
using Axis = Guide::Axis;

namespace {
using Bench = kit::Hand<Guide>;

GuidanceCommand along_path() {
  return {.course_rad = 1.1,
          .height_m = 55,
          .climb_rate_mps = 0.4,
          .airspeed_mps = 15,
          .roll_feedforward_rad = 0.2};
}
void all(Bench& bench, Axis axis) {
  bench.params.course.value = bench.params.height.value = bench.params.airspeed.value = axis;
}
void fly(Bench& bench, int steps, const Rc& rc, const VehicleState& state = level()) {
  for (int i = 0; i < steps; ++i) bench.fly(rc, state);
}
}  // namespace

TEST_CASE("the command begins with what is flown, and stays with the sticks in the middle") {
  Bench bench;
  VehicleState s = level();
  s.course_rad = 2.5;
  bench.set(bench.in.state, s);
  bench.activate();
  s.course_rad = 2.4;
  s.height_m = 68;
  s.airspeed_mps = 16;
  fly(bench, 100, stick(0, 0, 0.5), s);
  CHECK(bench.out.command.course_rad == doctest::Approx(2.5));
  CHECK(bench.out.command.height_m == 70);
  CHECK(bench.out.command.airspeed_mps == 17);
  CHECK(bench.out.command.roll_feedforward_rad == 0);
}

TEST_CASE("after another guide the command goes on from that guide's") {
  Bench bench;
  bench.set(bench.in.state, level());
  Guide::Outputs last;
  last.command = along_path();
  bench.activate(last);
  bench.params.course_lead.value = 3;
  bench.fly(stick(0, 0, 0.5));
  CHECK(bench.out.command.course_rad == doctest::Approx(1.1));
  CHECK(bench.out.command.height_m == 55);
  CHECK(bench.out.command.airspeed_mps == 15);
}

TEST_CASE(
    "roll to the right turns the course right, by its rate, with the bank that it takes, through south") {
  Bench bench;
  VehicleState s = level();
  s.course_rad = 3.0;
  bench.set(bench.in.state, s);
  bench.activate();
  fly(bench, 100, stick(0.8), s);  // 0.8 * 0.5 rad/s for a second
  CHECK(bench.out.command.course_rad == doctest::Approx(3.4 - 2 * std::numbers::pi));
  CHECK(bench.out.course_lead_rad.value == doctest::Approx(0.4));
  CHECK(bench.out.command.roll_feedforward_rad == doctest::Approx(std::atan(0.4 * 17 / 9.80665)));
  fly(bench, 100, stick(-0.8), s);
  CHECK(bench.out.command.course_rad == doctest::Approx(3.0));
  CHECK(bench.out.command.roll_feedforward_rad < 0);
}

TEST_CASE("a pulled stick raises the height, at most as fast as the airframe climbs and sinks") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  fly(bench, 100, stick(0, 0.5));
  CHECK(bench.out.command.height_m == doctest::Approx(71.5));
  CHECK(bench.out.command.climb_rate_mps == 1.5);
  bench.params.climb_rate.value = 10;
  bench.retune();
  fly(bench, 100, stick(0, 1));
  CHECK(bench.out.command.height_m == doctest::Approx(75.5));  // 4 m/s
  fly(bench, 100, stick(0, -1));
  CHECK(bench.out.command.height_m == doctest::Approx(72.5));  // 3 m/s
}

TEST_CASE(
    "the throttle stick moves the airspeed once it has been in the middle, between the airframe's limits") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  fly(bench, 300, stick(0, 0, 0.9));
  CHECK(bench.out.command.airspeed_mps == 17);
  bench.fly(stick(0, 0, 0.55));  // within the dead zone of 0.15
  // 2 * 0.9 - 1 = 0.8; (0.8 - 0.15) / 0.85 = 0.7647 of 1 m/s2
  fly(bench, 100, stick(0, 0, 0.9));
  CHECK(bench.out.command.airspeed_mps == doctest::Approx(17 + 0.65 / 0.85));
  fly(bench, 2000, stick(0, 0, 1));
  CHECK(bench.out.command.airspeed_mps == 25);
  fly(bench, 3000, stick(0, 0, 0));
  CHECK(bench.out.command.airspeed_mps == 12);
}

TEST_CASE("a stick that is held for a minute leads what is flown by no more than it may") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  fly(bench, 6000, stick(1, 1));
  CHECK(bench.out.command.course_rad == doctest::Approx(0.8));
  CHECK(bench.out.command.height_m == doctest::Approx(85));
  CHECK(bench.out.command.climb_rate_mps == 0);
  fly(bench, 6000, stick(-1, -1));
  CHECK(bench.out.command.course_rad == doctest::Approx(-0.8));
  CHECK(bench.out.command.height_m == doctest::Approx(55));
}

TEST_CASE("floor and ceiling hold; from outside of them the way leads back alone") {
  Bench bench;
  VehicleState s = level();
  s.height_m = 115;
  bench.set(bench.in.state, s);
  bench.activate();
  fly(bench, 1000, stick(0, 1), s);
  CHECK(bench.out.command.height_m == 120);
  s.height_m = 10;
  bench.set(bench.in.state, s);
  bench.activate();
  fly(bench, 100, stick(0, -1), s);
  CHECK(bench.out.command.height_m == 10);
  fly(bench, 100, stick(0, 1), s);
  CHECK(bench.out.command.height_m == doctest::Approx(13));
}

TEST_CASE("an axis from the path is the other guide's to the last field, beside one from the sticks") {
  Bench bench;
  all(bench, Axis::automatic);
  bench.params.height.value = Axis::sticks;
  bench.set(bench.in.state, level());
  bench.activate();
  GuidanceCommand path = along_path();
  path.lateral = LateralMode::acceleration;
  path.lateral_acceleration_mps2 = 2;
  bench.set(bench.in.automatic, path);
  for (int i = 0; i < 100; ++i) {
    bench.set(bench.in.automatic, path);
    CHECK(bench.fly(stick(1, 0.5, 1)) == Status::ok);
  }
  CHECK(bench.out.command.course_rad == 1.1);
  CHECK(bench.out.command.roll_feedforward_rad == 0.2);
  CHECK(bench.out.command.lateral == LateralMode::acceleration);
  CHECK(bench.out.command.lateral_acceleration_mps2 == 2);
  CHECK(bench.out.command.airspeed_mps == 15);
  CHECK(bench.out.command.height_m == doctest::Approx(71.5));
  bench.params.course.value = Axis::hold;
  bench.retune();
  bench.fly(stick(1));
  CHECK(bench.out.command.course_rad == 1.1);  // held, for any stick
  CHECK(bench.out.command.lateral == LateralMode::course);
}

TEST_CASE("an axis from a path that nobody follows is held, degraded") {
  Bench bench;
  all(bench, Axis::automatic);
  bench.set(bench.in.state, level());
  bench.activate();
  CHECK(bench.fly(stick(1, 1, 1)) == Status::degraded);
  CHECK(bench.out.command.height_m == 70);
  CHECK(bench.out.command.course_rad == 0);
}

TEST_CASE("what is flown is commanded while the pilot is there, and held without him") {
  Bench bench;
  all(bench, Axis::flown);
  bench.set(bench.in.state, level());
  bench.activate();
  VehicleState s = level(20);
  s.course_rad = -0.7;
  s.height_m = 44;
  CHECK(bench.fly(stick(), s) == Status::ok);
  CHECK(bench.out.command.course_rad == -0.7);
  CHECK(bench.out.command.height_m == 44);
  CHECK(bench.out.command.airspeed_mps == 20);
  Rc rc = stick();
  rc.link = false;
  CHECK(bench.fly(rc) == Status::degraded);
  CHECK(bench.out.command.course_rad == -0.7);
  CHECK(bench.out.command.height_m == 44);
}

TEST_CASE("sticks that fall silent stop moving the command after the time-out, and the first frame goes on") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  CHECK(bench.fly(stick(0, 1)) == Status::ok);
  int moving = 0;
  for (int i = 0; i < 200; ++i) {
    bench.set(bench.in.state, level());
    moving += bench.step(0.01) == Status::ok;
  }
  CHECK(moving == 49);  // the step of the frame was 10 ms old: 0.5 s in all
  CHECK(bench.out.command.height_m == doctest::Approx(70 + 3 * 0.5));
  CHECK(bench.out.command.climb_rate_mps == 0);
  CHECK(bench.fly(stick(0, 1)) == Status::ok);
  CHECK(bench.out.command.height_m == doctest::Approx(70 + 3 * 0.51));
}

TEST_CASE("before the first frame nothing moves: a stick that was never heard of is not at its end") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  for (int i = 0; i < 100; ++i) {
    bench.set(bench.in.state, level());
    CHECK(bench.step(0.01) == Status::degraded);
  }
  CHECK(bench.out.command.course_rad == 0);
  CHECK(bench.out.command.height_m == 70);
}

TEST_CASE("the first step moves the command by its own time, however long the flight has lasted") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.tick.now_ns = 3'600'000'000'000;
  bench.activate();
  bench.fly(stick(0, 1));
  CHECK(bench.out.command.height_m == doctest::Approx(70.03));
  bench.fly(stick(0, 1), level(), 0.4);  // a gap counts as a tenth of a second
  CHECK(bench.out.command.height_m == doctest::Approx(70.33));
}

TEST_CASE("without velocity or height the stick does not move what it cannot see") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.activate();
  VehicleState s = level();
  s.velocity_valid = s.height_valid = false;
  s.height_m = 0;
  s.course_rad = 3;
  CHECK(bench.fly(stick(1, 1), s) == Status::degraded);
  CHECK(bench.out.command.course_rad == 0);
  CHECK(bench.out.command.height_m == 70);
}

TEST_CASE("a floor above the ceiling is refused in one sentence") {
  Bench bench;
  bench.params.height_min.value = 130;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error().find("height_min: 130") != std::string::npos);
}

TEST_CASE("a step of the guide allocates nothing") {
  Bench bench;
  bench.set(bench.in.state, level());
  bench.set(bench.in.automatic, along_path());
  bench.fly(stick(1, 1));
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

}  // namespace guide_test
