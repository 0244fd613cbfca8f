// SPDX-License-Identifier: BSD-3-Clause
// The outer loops against numbers worked out by hand: a default airframe has no aerodynamics, so
// feed-forwards of turns are zero.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/control_slc/outer.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/random.hpp>
#include <fulmar/testing.hpp>

namespace outer_test {

using namespace fulmar;
using Outer = slc::Outer;

namespace {
constexpr double cruise =
    15;  // of the default airframe; trim throttle 0.5, climb 4, sink 3 m/s, pitch +-0.35 rad

VehicleState flying() {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = cruise;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -isa::g0};
  return s;
}
GuidanceCommand level() {
  return {.course_rad = 0,
          .height_m = 70,
          .climb_rate_mps = 0,
          .airspeed_mps = cruise,
          .roll_feedforward_rad = 0};
}

const AttitudeCommand& settle(Bench<Outer>& bench, const VehicleState& state, const GuidanceCommand& command,
                              double seconds = 3) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  for (int i = 0; i < static_cast<int>(seconds * 100); ++i) bench.step(0.01);
  return bench.out.attitude;
}
/// While a pilot flies, the host activates a law before each of its steps, without a law to continue from.
/// The last activation is the first with an effect.
void pilot_flies(Bench<Outer>& bench, const VehicleState& state, const GuidanceCommand& command) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  for (int i = 0; i < 100; ++i) {
    bench.activate();
    bench.step(0.01);
  }
}
void no_integrals(Bench<Outer>& bench) {
  bench.params.altitude_ki.value = bench.params.airspeed_ki.value = 0;
}
}  // namespace

TEST_CASE("roll is the course gain times the error plus the feed-forward, and grows with ground speed") {
  Bench<Outer> bench;
  VehicleState s = flying();
  GuidanceCommand c = level();
  c.course_rad = 0.1;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.2));
  c.roll_feedforward_rad = 0.25;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.45));
  s.ground_speed_mps = 1.5 * cruise;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.55));
  c.course_rad = 3;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.785));
  CHECK(bench.out.internals.roll_saturated);
}

TEST_CASE("a reset of the state that is told is answered as by a law that has never seen another state") {
  const auto prepare = [](Bench<Outer>& bench) {
    no_integrals(bench);
    bench.params.common.pitch_rate_limit.value = 5;
    bench.params.common.throttle_rate_limit.value = 20;
  };
  VehicleState after = flying();
  after.height_m += 10;
  after.position_m.down -= 10;
  after.velocity_mps.north += 3;
  after.airspeed_mps += 3;
  after.ground_speed_mps += 3;
  after.reset_count = 1;
  after.reset_position_m.down = -10;
  after.reset_velocity_mps.north = 3;
  Bench<Outer> fresh;
  prepare(fresh);
  const AttitudeCommand wanted = settle(fresh, after, level());
  for (const bool given : {true, false}) {
    Bench<Outer> bench;
    prepare(bench);
    settle(bench, flying(), level());
    if (!given) after.reset_count = 0;
    bench.set(bench.in.state, after);
    for (int i = 0; i < 20; ++i) {
      bench.step(0.01);
      if (i < 10) continue;  // the limit of the pitch rate
      CHECK((std::abs(bench.out.attitude.pitch_rad - wanted.pitch_rad) < 1e-9) == given);
    }
    if (given) CHECK(bench.out.attitude.throttle_frac == doctest::Approx(wanted.throttle_frac).epsilon(1e-9));
  }
}

TEST_CASE("the runway does not turn when the yaw is reset; a course that was measured stays") {
  const TakeoffTuning tuning;
  const FlightLimits limits;
  for (const double ground_speed : {0.0, 5.0}) {
    VehicleState s = flying();
    s.yaw_rad = 0.1;
    s.course_rad = 0.1;
    s.ground_speed_mps = ground_speed;
    TakeoffRun run;
    run.begin(s);
    s.yaw_rad = 0.5;
    s.reset_count = 1;
    s.reset_yaw_rad = 0.4;
    (void)run.step(s, tuning, limits);
    (void)run.step(s, tuning, limits);
    CHECK(run.course_rad() == doctest::Approx(ground_speed > 3 ? 0.1 : 0.5));
  }
}

TEST_CASE("course error wraps through north") {
  Bench<Outer> bench;
  VehicleState s = flying();
  GuidanceCommand c = level();
  s.course_rad = 3.1;
  c.course_rad = -3.1;
  settle(bench, s, c);
  CHECK(bench.out.internals.course_error_rad == doctest::Approx(2 * 3.14159265358979 - 6.2));
  CHECK(bench.out.attitude.roll_rad > 0);
  s.course_rad = -0.05;
  c.course_rad = 6.2;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(2 * (6.2 - 2 * 3.14159265358979 + 0.05)));
}

TEST_CASE("the roll command moves no faster than its limit") {
  Bench<Outer> bench;
  GuidanceCommand c = level();
  settle(bench, flying(), c);
  c.roll_feedforward_rad = 0.7;
  bench.set(bench.in.command, c);
  double last = bench.out.attitude.roll_rad, fastest = 0;
  for (int i = 0; i < 300; ++i) {
    bench.step(0.01);
    fastest = std::max(fastest, std::abs(bench.out.attitude.roll_rad - last));
    last = bench.out.attitude.roll_rad;
  }
  CHECK(fastest == doctest::Approx(0.01));  // 1 rad/s
  CHECK(last == doctest::Approx(0.7));
}

TEST_CASE("pitch follows the height law") {
  Bench<Outer> bench;
  no_integrals(bench);
  VehicleState s = flying();
  s.height_m = 69;
  // climb rate 0.09 * 15 * 1 = 1.35; pitch 1.35 / 15 + 0.03 * 1.35
  CHECK(settle(bench, s, level()).pitch_rad == doctest::Approx(0.1305));
  CHECK(bench.out.climb_rate_demand_mps.value == doctest::Approx(1.35));
  s.climb_rate_mps = 1.35;
  CHECK(settle(bench, s, level()).pitch_rad == doctest::Approx(0.09));
  GuidanceCommand c = level();
  c.height_m = 69;
  c.climb_rate_mps = 1.5;
  s.climb_rate_mps = 1.5;
  CHECK(settle(bench, s, c).pitch_rad == doctest::Approx(0.1));
}

TEST_CASE("far from the height wanted the climb and sink limits govern and nothing is integrated") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.height_m = 20;
  s.climb_rate_mps = 4;
  CHECK(settle(bench, s, level(), 60).pitch_rad == doctest::Approx(4 / cruise));
  s.height_m = 200;
  s.climb_rate_mps = -3;
  CHECK(settle(bench, s, level(), 60).pitch_rad == doctest::Approx(-3 / cruise));
  CHECK(bench.out.pitch_integral_rad.value == 0);
}

TEST_CASE("throttle is trim, feed-forward, proportion and integral") {
  Bench<Outer> bench;
  VehicleState s = flying();
  no_integrals(bench);
  s.airspeed_mps = 14;
  CHECK(settle(bench, s, level()).throttle_frac == doctest::Approx(0.5 + 0.15));
  GuidanceCommand c = level();
  s.airspeed_mps = 17;
  c.airspeed_mps = 17;
  CHECK(settle(bench, s, c).throttle_frac == doctest::Approx(0.5 + 2 * 0.03));
  c.climb_rate_mps = 2;
  CHECK(settle(bench, s, c).throttle_frac == doctest::Approx(0.5 + 2 * 0.03 + 2 * 0.04));
  Bench<Outer> integral;
  s = flying();
  s.airspeed_mps = 14.5;
  settle(integral, s, level(), 2);
  const double first = integral.out.attitude.throttle_frac;
  settle(integral, s, level(), 3);
  CHECK(integral.out.attitude.throttle_frac - first == doctest::Approx(0.06 * 0.5 * 3));
}

TEST_CASE("a throttle that was saturated for a minute comes back as soon as the airspeed does") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.airspeed_mps = 10;
  CHECK(settle(bench, s, level(), 60).throttle_frac == 1);
  CHECK(bench.out.internals.throttle_saturated);
  const double integral = bench.out.throttle_integral_frac.value;
  CHECK(integral < 0.5);
  s.airspeed_mps = 15.5;
  settle(bench, s, level(), 1);
  CHECK(bench.out.throttle_integral_frac.value < integral);
  CHECK(bench.out.attitude.throttle_frac < 1);
}

TEST_CASE("throttle stays in 0 to 1, pitch and roll in their limits, for any state, command and law") {
  Random random(11);
  for (OuterLaw law : {OuterLaw::hold, OuterLaw::takeoff}) {
    Bench<Outer> bench;
    bench.params.common.law.value = law;
    for (int i = 0; i < 20000; ++i) {
      VehicleState s = flying();
      s.height_m = random.uniform(-50, 500);
      s.climb_rate_mps = random.uniform(-15, 15);
      s.airspeed_mps = random.uniform(0, 60);
      s.ground_speed_mps = random.uniform(0, 60);
      s.course_rad = random.uniform(-3.14, 3.14);
      s.roll_rad = random.uniform(-3.14, 3.14);
      s.pitch_rad = random.uniform(-1.5, 1.5);
      s.airspeed_valid = random.uniform() < 0.8;
      const GuidanceCommand c{random.uniform(-10, 10), random.uniform(-100, 1000), random.uniform(-10, 10),
                              random.uniform(-5, 60), random.uniform(-2, 2)};
      bench.set(bench.in.state, s);
      bench.set(bench.in.command, c);
      REQUIRE(bench.step(random.uniform(0, 0.5)) != Status::failed);
      const AttitudeCommand& a = bench.out.attitude;
      REQUIRE((a.throttle_frac >= 0 && a.throttle_frac <= 1));
      REQUIRE(std::abs(a.pitch_rad) <= 0.35);
      REQUIRE(std::abs(a.roll_rad) <= 0.785);
    }
  }
}

TEST_CASE("near the stall the nose may not rise") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.height_m = 20;
  s.airspeed_mps = 8;  // 0.8 of the minimum
  CHECK(settle(bench, s, level()).pitch_rad <= 0);
  s.airspeed_mps = 10;
  CHECK(settle(bench, s, level()).pitch_rad > 0.3);
}

TEST_CASE("taking over is bumpless from any last command") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Bench<Outer> bench;
    VehicleState s = flying();
    s.height_m = random.uniform(40, 100);
    s.airspeed_mps = random.uniform(11, 20);
    s.course_rad = random.uniform(-3, 3);
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, level());
    bench.params.common.law.value = i % 2 ? OuterLaw::takeoff : OuterLaw::hold;
    Outer::Outputs last;
    last.attitude = {random.uniform(-0.7, 0.7), random.uniform(-0.3, 0.3), random.uniform(0, 1)};
    bench.activate(last);
    bench.step(0.01);
    // The law before has stepped in this tick: a second step would double the rate.
    CHECK(bench.out.attitude.roll_rad == last.attitude.roll_rad);
    CHECK(bench.out.attitude.pitch_rad == last.attitude.pitch_rad);
    CHECK(bench.out.attitude.throttle_frac == last.attitude.throttle_frac);
    bench.step(0.01);
    CHECK(std::abs(bench.out.attitude.roll_rad - last.attitude.roll_rad) <= 0.0101);
    CHECK(std::abs(bench.out.attitude.pitch_rad - last.attitude.pitch_rad) <= 0.0081);
    CHECK(std::abs(bench.out.attitude.throttle_frac - last.attitude.throttle_frac) <= 0.0201);
  }
}

TEST_CASE("taking over in trim keeps what the last controller had learnt") {
  Bench<Outer> bench;
  bench.set(bench.in.state, flying());
  bench.set(bench.in.command, level());
  Outer::Outputs last;
  last.attitude = {0, 0.04, 0.62};
  bench.activate(last);
  for (int i = 0; i < 500; ++i) bench.step(0.01);
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.04));
  CHECK(bench.out.attitude.throttle_frac == doctest::Approx(0.62));
}

TEST_CASE("a live change of the law is bumpless as well") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.height_m = 30;
  bench.params.common.law.value = OuterLaw::takeoff;
  settle(bench, s, level());
  CHECK(bench.out.attitude.throttle_frac == 1);
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.21));
  bench.params.common.law.value = OuterLaw::hold;
  bench.retune();
  bench.step(0.01);
  CHECK(bench.out.internals.law == OuterLaw::hold);
  CHECK(bench.out.attitude.throttle_frac == doctest::Approx(1).epsilon(0.03));
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.21).epsilon(0.05).scale(0));
}

TEST_CASE("the take-off law keeps the runway's course, waits with the rotation, and ignores guidance") {
  Bench<Outer> bench;
  bench.params.common.law.value = OuterLaw::takeoff;
  VehicleState s = flying();
  s.height_m = 0.3;
  s.airspeed_mps = s.ground_speed_mps = 0;
  s.yaw_rad = s.course_rad = 1.0;
  GuidanceCommand c = level();
  c.course_rad = -2;
  const AttitudeCommand& a = settle(bench, s, c);
  CHECK(a.throttle_frac == 1);
  CHECK(a.pitch_rad == 0);
  CHECK(a.roll_rad == 0);
  s.airspeed_mps = s.ground_speed_mps = 12.9;
  s.course_rad = 1.05;
  settle(bench, s, c);
  CHECK(bench.out.attitude.pitch_rad == 0);
  CHECK(bench.out.attitude.roll_rad == 0);
  s.airspeed_mps = s.ground_speed_mps = 13.1;
  settle(bench, s, c);
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.21));
  CHECK(bench.out.attitude.roll_rad == doctest::Approx(-0.05));
  s.airspeed_mps = 12.5;  // rotated stays rotated
  settle(bench, s, c);
  CHECK(bench.out.attitude.pitch_rad == doctest::Approx(0.21));
  s.course_rad = -1;
  settle(bench, s, c);
  CHECK(bench.out.attitude.roll_rad == doctest::Approx(0.15));
}

TEST_CASE("an aircraft that stands has its engine off and learns nothing") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.height_m = 0;
  s.airspeed_mps = s.ground_speed_mps = 0.3;
  for (bool valid : {true, false}) {
    s.airspeed_valid = valid;
    settle(bench, s, level(), 60);
    CHECK(bench.out.attitude.throttle_frac == 0);
    CHECK(bench.out.attitude.pitch_rad == 0);
    CHECK(bench.out.pitch_integral_rad.value == 0);
    CHECK(bench.out.throttle_integral_frac.value == 0);
  }
}

TEST_CASE("without airspeed the throttle is trim and climb feed-forward, and the step says degraded") {
  Bench<Outer> bench;
  VehicleState s = flying();
  s.airspeed_valid = false;
  s.airspeed_mps = 0;
  GuidanceCommand c = level();
  c.climb_rate_mps = 2;
  s.climb_rate_mps = 2;
  bench.set(bench.in.state, s);
  bench.set(bench.in.command, c);
  for (int i = 0; i < 6000; ++i) CHECK_EQ(bench.step(0.01), Status::degraded);
  CHECK(bench.out.attitude.throttle_frac == doctest::Approx(0.5 + 2 * 0.04));
  s.ground_speed_mps = 0.5;  // a strong head wind is not the ground
  settle(bench, s, c);
  CHECK(bench.out.attitude.throttle_frac == doctest::Approx(0.5 + 2 * 0.04));
}

TEST_CASE(
    "when a pilot hands back the throttle begins at trim, roll and pitch at the attitude that he leaves, and "
    "nothing is learnt from him") {
  for (const double airspeed : {14.5, cruise, 15.5}) {
    Bench<Outer> bench;
    VehicleState s = flying();
    settle(bench, s, level());
    s.airspeed_mps = airspeed;
    s.roll_rad = 0.5;
    s.pitch_rad = -0.1;
    pilot_flies(bench, s, level());
    CHECK(std::abs(bench.out.attitude.throttle_frac - 0.5) <= 0.0201);  // 2 per second
    CHECK(std::abs(bench.out.attitude.roll_rad - 0.5) <= 0.0101);
    CHECK(std::abs(bench.out.attitude.pitch_rad + 0.1) <= 0.0081);
    CHECK(std::abs(bench.out.throttle_integral_frac.value) < 0.001);
    CHECK(std::abs(bench.out.pitch_integral_rad.value) < 0.001);
    double least = 1;
    for (int i = 0; i < 50; ++i) {
      bench.step(0.01);
      least = std::min(least, bench.out.attitude.throttle_frac);
    }
    CHECK(least > 0.3);  // half a metre per second too fast asks for that
  }
}

TEST_CASE("a glide, all zeros, is somebody's command; after nobody a law begins at attitude and cruise") {
  for (const bool with_last : {true, false}) {
    Bench<Outer> bench;
    VehicleState s = flying();
    s.roll_rad = 0.3;
    s.pitch_rad = 0.1;
    s.height_m = 60;  // too low: the law asks for more than trim
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, level());
    REQUIRE((with_last ? bench.activate(Outer::Outputs{}) : bench.activate()) == Status::ok);
    REQUIRE(bench.step(0.01) == Status::ok);
    const AttitudeCommand& a = bench.out.attitude;
    const double throttle = with_last ? 0 : 0.5, pitch = with_last ? 0 : 0.1, roll = with_last ? 0 : 0.3;
    CHECK(std::abs(a.throttle_frac - throttle) <= 0.0201);  // 2 per second
    CHECK(std::abs(a.pitch_rad - pitch) <= 0.0081);         // 0.8 rad/s
    CHECK(std::abs(a.roll_rad - roll) <= 0.0401);           // smoothed towards 0 with 0.1 s
    // The integral takes over the difference between the glide and the command of the law, within its bounds;
    // without a law before it stays 0.
    CHECK(std::abs(bench.out.throttle_integral_frac.value - (with_last ? -0.2 : 0)) < 0.004);
    CHECK(std::abs(bench.out.pitch_integral_rad.value - (with_last ? -0.1 : 0)) < 0.001);
  }
}

TEST_CASE("a step allocates nothing") {
  Bench<Outer> bench;
  settle(bench, flying(), level());
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

TEST_CASE(
    "without attitude or height it asks for level wings and the trim of cruise, as fast as a command may "
    "move, and says so") {
  for (const bool attitude : {true, false}) {
    Bench<Outer> bench;
    VehicleState s = flying();
    GuidanceCommand c = level();
    c.course_rad = 1;
    c.height_m = 90;
    CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.785));
    s.roll_rad = 0.6;
    s.airspeed_mps = 5;
    s.airspeed_valid = false;  // invalid values that must have no effect
    (attitude ? s.height_valid : s.attitude_valid) = false;
    CHECK(settle(bench, s, c, 0.3).roll_rad > 0.785 - 0.3 - 1e-9);
    CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0).epsilon(1e-6));
    CHECK(bench.out.attitude.pitch_rad ==
          doctest::Approx(0));  // the default airframe has no derivatives for a trim
    CHECK(bench.out.attitude.throttle_frac == doctest::Approx(0.5));
    CHECK(bench.step(0.01) == Status::degraded);
  }
}

TEST_CASE("when attitude is known again the command goes on from it") {
  Bench<Outer> bench;
  VehicleState s = flying();
  settle(bench, s, level());
  s.attitude_valid = s.velocity_valid = s.height_valid = s.airspeed_valid = false;
  settle(bench, s, level());
  s = flying();
  s.roll_rad = -0.4;
  s.pitch_rad = 0.12;
  bench.set(bench.in.state, s);
  CHECK(bench.step(0.01) == Status::ok);
  CHECK(std::abs(bench.out.attitude.roll_rad + 0.4) <= 0.0401);  // smoothed towards 0 with 0.1 s
  CHECK(std::abs(bench.out.attitude.pitch_rad - 0.12) <= 0.0081);
  CHECK(std::abs(bench.out.attitude.throttle_frac - 0.5) <= 0.0201);
  CHECK(settle(bench, s, level()).roll_rad == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("without a velocity there is no course to hold: wings level, height goes on") {
  Bench<Outer> bench;
  no_integrals(bench);
  VehicleState s = flying();
  s.velocity_valid = false;
  GuidanceCommand c = level();
  c.course_rad = 1;
  c.roll_feedforward_rad = 0.3;
  c.height_m = 72;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0));
  CHECK(bench.out.attitude.pitch_rad > 0.1);
  CHECK(bench.step(0.01) == Status::degraded);
}

TEST_CASE(
    "without airspeed a throttle that was asked for beyond full comes back from full, not from beyond") {
  Bench<Outer> bench;
  bench.params.climb_kff.value = 0.5;
  VehicleState s = flying();
  s.airspeed_valid = false;
  s.height_m = 20;
  CHECK(settle(bench, s, level()).throttle_frac == 1);  // of 0.5 + 0.5 * 4 m/s
  s.height_m = 70;
  CHECK(settle(bench, s, level(), 0.25).throttle_frac == doctest::Approx(0.5));  // at 2 per second
}

}  // namespace outer_test
