// SPDX-License-Identifier: BSD-3-Clause
// Angles and throttle from the sticks, and the envelope, against closed forms.
#include "plugins/control_manual/outer.hpp"

#include "kit.hpp"

namespace outer_test {

using namespace fulmar;
using kit::deg;
using kit::level;
using kit::stick;
using manual::Envelope;
using manual::Outer;

namespace {
struct Bench : kit::Hand<Outer> {
  Bench() { params.blend.value = 0.01; }  // a second of steps is many time constants
  AttitudeCommand settle(const Rc& rc, const VehicleState& state = level()) {
    for (int i = 0; i < 100; ++i) fly(rc, state);
    return out.attitude;
  }
};

// Pitch of level flight at 17 m/s, 1457 m: CL = 2 m g / (rho V^2 S), trimmed by the elevator, by hand.
double level_pitch() {
  const double T = 288.15 - 0.0065 * 1457, rho = 1.225 * std::pow(T / 288.15, 4.25588);
  const double CL = 2 * 4.5 * 9.80665 / (rho * 17 * 17 * 0.52);
  // CL = 0.506 + 5.61 a + 0.13 e, 0 = 0.135 - 2.74 a - 0.99 e
  return (CL - 0.506 - 0.13 * 0.135 / 0.99) / (5.61 - 0.13 * 2.74 / 0.99);
}

const FlightLimits limits = test::anaconda().limits;
Envelope at(double airspeed, const manual::EnvelopeParams& p = {}) {
  return manual::envelope(level(airspeed), limits, p);
}
}  // namespace

TEST_CASE(
    "sticks are angles by their range: right is right, pulled is up from level flight; throttle is "
    "throttle") {
  Bench bench;
  AttitudeCommand a = bench.settle(stick(0.6, 0, 0.57));
  CHECK(a.roll_rad == doctest::Approx(0.3));
  CHECK(a.pitch_rad == doctest::Approx(level_pitch()).epsilon(1e-4));
  CHECK(a.throttle_frac == doctest::Approx(0.57));
  a = bench.settle(stick(-0.6, 0.4, 0.3));
  CHECK(a.roll_rad == doctest::Approx(-0.3));
  CHECK(a.pitch_rad == doctest::Approx(level_pitch() + 0.2).epsilon(1e-4));
  CHECK(a.throttle_frac == doctest::Approx(0.3));
  a = bench.settle(stick(0, -0.4));
  CHECK(a.pitch_rad == doctest::Approx(level_pitch() - 0.2).epsilon(1e-4));
}

TEST_CASE("the shipped sticks have a dead zone and expo") {
  Bench bench;
  bench.params.sticks = {};
  CHECK(bench.settle(stick(0.04)).roll_rad == doctest::Approx(0));
  CHECK(bench.settle(stick(0.62)).roll_rad == doctest::Approx(0.5 * 0.4848));
}

TEST_CASE("each axis may be the outer law's, whatever its stick does") {
  for (int axis = 0; axis < 3; ++axis) {
    Bench bench;
    Choice<Outer::Source>* const of[] = {&bench.params.roll, &bench.params.pitch, &bench.params.throttle};
    of[axis]->value = Outer::Source::automatic;
    AttitudeCommand a;
    for (int i = 0; i < 100; ++i) {
      bench.set(bench.in.automatic, AttitudeCommand{-0.4, 0.1, 0.8});
      CHECK(bench.fly(stick(0.6, 0.2, 0.3)) == Status::ok);
    }
    a = bench.out.attitude;
    CHECK(a.roll_rad == doctest::Approx(axis == 0 ? -0.4 : 0.3));
    CHECK(a.pitch_rad == doctest::Approx(axis == 1 ? 0.1 : level_pitch() + 0.1).epsilon(1e-4));
    CHECK(a.throttle_frac == doctest::Approx(axis == 2 ? 0.8 : 0.3));
  }
}

TEST_CASE("without the pilot the outer law flies, and without that the wings are level at cruise") {
  for (const bool lawful : {true, false}) {
    Bench bench;
    Rc lost = stick(1, 1, 0);
    lost.link = false;
    bench.settle(stick(1, 1, 0));
    for (int i = 0; i < 100; ++i) {
      if (lawful) bench.set(bench.in.automatic, AttitudeCommand{-0.4, 0.1, 0.8});
      CHECK(bench.fly(lost) == Status::degraded);
    }
    const AttitudeCommand a = bench.out.attitude;
    CHECK(a.roll_rad == doctest::Approx(lawful ? -0.4 : 0).epsilon(1e-4));
    CHECK(a.pitch_rad == doctest::Approx(lawful ? 0.1 : level_pitch()).epsilon(1e-4));
    CHECK(a.throttle_frac == doctest::Approx(lawful ? 0.8 : 0.57));
  }
}

TEST_CASE("on the ground a lost pilot is no reason to start the motor") {
  Bench bench;
  VehicleState s = level(0);
  s.height_m = 0;
  Rc lost = stick(0, 0, 0);
  lost.link = false;
  CHECK(bench.settle(lost, s).throttle_frac == 0);
}

TEST_CASE(
    "frames that fall silent count until the time-out, then level flight; the stick is back with a frame") {
  Bench bench;
  bench.settle(stick(1));
  int by_stick = 0;
  for (int i = 0; i < 100; ++i) {
    bench.set(bench.in.state, level());
    by_stick += bench.step(0.01) == Status::ok;
  }
  CHECK(by_stick == 49);
  CHECK(bench.out.attitude.roll_rad == doctest::Approx(0));
  CHECK(bench.settle(stick(1)).roll_rad == doctest::Approx(0.5));
}

TEST_CASE("an axis that is the law's goes by its stick when there is no law") {
  Bench bench;
  bench.params.roll.value = Outer::Source::automatic;
  CHECK(bench.settle(stick(0.6)).roll_rad == doctest::Approx(0.3));
  CHECK(bench.fly(stick(0.6)) == Status::degraded);
}

TEST_CASE("what is flown is commanded while the pilot flies it further in; without him the outer law holds") {
  Bench bench;
  bench.params.roll.value = bench.params.pitch.value = bench.params.throttle.value = Outer::Source::flown;
  VehicleState s = level();
  s.roll_rad = 0.5;
  s.pitch_rad = -0.2;
  AttitudeCommand a = bench.settle(stick(-1, 1, 0.3), s);
  CHECK(a.roll_rad == doctest::Approx(0.5));
  CHECK(a.pitch_rad == doctest::Approx(-0.2));
  CHECK(a.throttle_frac == doctest::Approx(0.3));
  CHECK(bench.fly(stick(), s) == Status::ok);
  Rc lost = stick();
  lost.link = false;
  a = bench.settle(lost, s);
  CHECK(a.roll_rad == doctest::Approx(0));
  CHECK(bench.fly(lost, s) == Status::degraded);
}

TEST_CASE("what flew before goes over into the sticks without a step, by the time constant") {
  kit::Hand<Outer> bench;
  bench.set(bench.in.state, level());
  Outer::Outputs last;
  last.attitude = {-0.3, 0.1, 0.9};
  bench.activate(last);
  AttitudeCommand before = last.attitude;
  double roll = 0, pitch = 0, throttle = 0;
  for (int i = 0; i < 50; ++i) {
    bench.fly(stick(0.6, 0.2, 0.5));
    const AttitudeCommand& now = bench.out.attitude;
    roll = std::max(roll, std::abs(now.roll_rad - before.roll_rad));
    pitch = std::max(pitch, std::abs(now.pitch_rad - before.pitch_rad));
    throttle = std::max(throttle, std::abs(now.throttle_frac - before.throttle_frac));
    before = now;
    if (i == 0) CHECK(now.roll_rad == doctest::Approx(-0.3));
  }
  CHECK(roll < 0.6 * 0.02);  // a fiftieth of the difference in 10 ms
  CHECK(pitch < 0.1 * 0.02);
  CHECK(throttle < 0.4 * 0.02);
  CHECK(before.roll_rad == doctest::Approx(0.3 - 0.6 * 1.98 * std::exp(-0.98)));
}

TEST_CASE("a stick that is thrown to its end moves the angles no faster than their limits") {
  Bench bench;
  bench.settle(stick(-1, -1));
  const AttitudeCommand before = bench.out.attitude;
  for (int i = 0; i < 10; ++i) bench.fly(stick(1, 1));
  CHECK(bench.out.attitude.roll_rad - before.roll_rad == doctest::Approx(0.2));
  CHECK(bench.out.attitude.pitch_rad - before.pitch_rad == doctest::Approx(0.1));
}

TEST_CASE("when nobody's command is in force the angles begin with those of the aircraft") {
  kit::Hand<Outer> bench;
  VehicleState s = level();
  s.roll_rad = 0.35;
  s.pitch_rad = -0.1;
  bench.set(bench.in.state, s);
  bench.activate();
  bench.fly(stick(), s);
  CHECK(bench.out.attitude.roll_rad == doctest::Approx(0.35));
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(-0.1));
}

TEST_CASE("the envelope at cruise is the airframe's bank and pitch, and all of the throttle") {
  const Envelope e = at(17);
  CHECK(e.roll_max == 0.785);
  CHECK(e.pitch_max == doctest::Approx(0.35));
  CHECK(e.pitch_min == -0.35);
  CHECK(e.throttle_min == 0);
  CHECK(e.throttle_max == 1);
}

TEST_CASE("towards the stall pitch falls to 10 degrees down, throttle rises to full, bank goes") {
  // stall at 12 / 1.2 = 10 m/s
  CHECK(at(10.5).pitch_max == doctest::Approx(-0.175));
  CHECK(at(13.5).pitch_max == doctest::Approx(0.35));
  CHECK(at(12).pitch_max == doctest::Approx(0.0875));
  CHECK(at(11.5).pitch_max <= 0.0001);  // no pitch up below 1.15 times the stall
  CHECK(at(12).throttle_min == doctest::Approx(0));
  CHECK(at(11.25).throttle_min == doctest::Approx(0.5));
  CHECK(at(10.5).throttle_min == 1);
  // cos(bank) = (1.1 Vs / Va)^2
  CHECK(at(12).roll_max == doctest::Approx(std::acos(121.0 / 144)));
  CHECK(at(10.5).roll_max == doctest::Approx(0.175));
}

TEST_CASE("towards the largest airspeed the nose rises and the motor goes") {
  CHECK(at(23.7).pitch_min == doctest::Approx(-0.35));
  CHECK(at(27.5).pitch_min == doctest::Approx(0.175));
  CHECK(at(25).throttle_max == doctest::Approx(0.5));
  CHECK(at(27).throttle_max == 0);
}

TEST_CASE(
    "the stall may be stated; without airspeed and on the ground speed limits nothing; off, nothing does") {
  manual::EnvelopeParams p;
  p.stall_airspeed.value = 14;
  CHECK(at(14.7, p).pitch_max == doctest::Approx(-0.175));
  VehicleState s = level(11);
  s.airspeed_valid = false;
  CHECK(manual::envelope(s, limits, {}).pitch_max == 0.35);
  CHECK(at(5).pitch_max == 0.35);
  CHECK(at(5).throttle_min == 0);
  p.protection.value = false;
  CHECK(at(10.5, p).roll_max == doctest::Approx(std::numbers::pi));
  CHECK(at(10.5, p).pitch_max == doctest::Approx(std::numbers::pi / 2));
  CHECK(at(10.5, p).throttle_min == 0);
}

TEST_CASE("what is asked for ends at the envelope, and is told; with the protection off it does not") {
  Bench bench;
  bench.params.roll_range.value = 1.2;
  AttitudeCommand a = bench.settle(stick(1, 1, 0), level(12));
  CHECK(a.roll_rad == doctest::Approx(std::acos(121.0 / 144)));
  CHECK(a.pitch_rad == doctest::Approx(0.0875));
  CHECK(bench.out.protecting_ratio.value == 1);
  bench.params.envelope.protection.value = false;
  bench.retune();
  a = bench.settle(stick(1, 1, 0), level(12));
  CHECK(a.roll_rad == doctest::Approx(1.2));
  CHECK(a.pitch_rad == doctest::Approx(level_pitch() + 0.5).epsilon(1e-4));
  CHECK(bench.out.protecting_ratio.value == 0);
}

TEST_CASE("a step of the outer law allocates nothing") {
  Bench bench;
  bench.set(bench.in.automatic, AttitudeCommand{});
  bench.fly(stick(1, 1));
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

}  // namespace outer_test
