// SPDX-License-Identifier: BSD-3-Clause
// The energy laws against numbers worked out by hand, and over random states.
#define FULMAR_COUNT_ALLOCATIONS
#include <doctest/doctest.h>

#include <fulmar/random.hpp>
#include <fulmar/testing.hpp>

#include "plugins/control_tecs/outer.hpp"

namespace tecs_test {

using namespace fulmar;
using Outer = tecs::Outer;

namespace {
constexpr double
    cruise = 15,
    g = 9.80665;  // default airframe: trim throttle 0.5, climb 4, sink 3 m/s, pitch +-0.35 rad, 10 to 25 m/s

VehicleState flying() {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = cruise;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -g};
  return s;
}
GuidanceCommand level() {
  return {.course_rad = 0,
          .height_m = 70,
          .climb_rate_mps = 0,
          .airspeed_mps = cruise,
          .roll_feedforward_rad = 0};
}

void configure(Bench<Outer>& bench) {
  bench.params.common.airframe.value.mass_kg = 4.5;
  bench.params.airspeed_kff.value = 0;
}
const AttitudeCommand& settle(Bench<Outer>& bench, const VehicleState& state, const GuidanceCommand& command,
                              double seconds = 3) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  for (int i = 0; i < static_cast<int>(seconds * 100 + 0.5); ++i) bench.step(0.01);
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

}  // namespace

TEST_CASE("throttle is the total energy rate wanted over the power of the engine") {
  Bench<Outer> bench;
  configure(bench);
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  VehicleState s = flying();
  s.airspeed_mps = 14.5;
  // V_dot = 1.2 * 0.5 = 0.6; E_c = 14.5 * 0.6 = 8.7; 4.5 / (14.5 * 50) per unit of rate; damping 0.5 on the
  // same error
  CHECK(settle(bench, s, level()).throttle_frac == doctest::Approx(0.5 + 8.7 * 4.5 / (14.5 * 50) * 1.5));
  CHECK(bench.out.acceleration_demand_mps2.value == doctest::Approx(0.6));
  s.specific_force_mps2.x = 0.6;  // the demanded acceleration is reached: feed-forward alone
  CHECK(settle(bench, s, level()).throttle_frac == doctest::Approx(0.5 + 8.7 * 4.5 / (14.5 * 50)));
}

TEST_CASE("pitch shares energy between height and speed by the weight") {
  Bench<Outer> bench;
  configure(bench);
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  VehicleState s = flying();
  s.height_m = 69;
  // hdot_c = 1.2: B_c = g 1.2, error the same: (1 + 0.6) 1.2 / 15
  CHECK(settle(bench, s, level()).pitch_rad == doctest::Approx(1.6 * 1.2 / 15));
  s.climb_rate_mps = 1.2;
  CHECK(settle(bench, s, level()).pitch_rad == doctest::Approx(1.2 / 15));
  s = flying();
  s.airspeed_mps = 14.5;
  // B_c = -0.4 * 8.7: nose down to gain speed
  CHECK(settle(bench, s, level(), 8).pitch_rad == doctest::Approx(-1.6 * 0.4 * 8.7 / (g * 14.5)));
  bench.params.speed_weight.value = 0;
  bench.retune();
  CHECK(settle(bench, s, level()).pitch_rad == doctest::Approx(0));
}

TEST_CASE(
    "airspeed without gusts: what the body does has no lag, what the air does goes through a first order") {
  constexpr double dt = 0.01, tau = 0.5;
  SteadyAirspeed own, gust;
  own.step(15, 0, tau, dt);
  gust.step(15, 0, tau, dt);
  for (int k = 1; k <= 300; ++k) {
    CHECK(own.step(15 + 0.7 * k * dt, 0.7, tau, dt) == doctest::Approx(15 + 0.7 * k * dt));
    CHECK(gust.step(17, 0, tau, dt) - 15 == doctest::Approx(2 * (1 - std::exp(-k * dt / tau))));
  }
}

TEST_CASE(
    "a gust of airspeed moves the throttle at once and the pitch by degrees; a new hand begins with none") {
  Bench<Outer> bench;
  configure(bench);
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  bench.params.common.pitch_rate_limit.value = bench.params.common.throttle_rate_limit.value = 6;
  const double trim = settle(bench, flying(), level()).pitch_rad;
  VehicleState s = flying();
  s.airspeed_mps = 14;
  const double all = 1.6 * 0.4 * 1.2 / g;  // nose down for 1 m/s too slow, with airspeed_gain 1.2
  const auto share = [&] { return (trim - bench.out.attitude.pitch_rad) / all; };
  settle(bench, s, level(), 0.1);
  CHECK(share() == doctest::Approx(1 - std::exp(-0.1 / 0.5)).epsilon(0.05));
  CHECK(bench.out.attitude.throttle_frac > 0.6);
  settle(bench, s, level(), 0.9);
  CHECK(share() == doctest::Approx(1 - std::exp(-1 / 0.5)).epsilon(0.05));
  settle(bench, flying(), level(), 5);
  bench.activate();
  settle(bench, s, level(), 0.01);
  bench.activate();  // continues from the present airspeed, not from a former one
  settle(bench, s, level(), 0.5);
  CHECK(share() > 0.8);
}

TEST_CASE("the acceleration along the air velocity is that of the body, gravity included") {
  VehicleState s = flying();
  CHECK(airspeed_rate(s) == doctest::Approx(0));
  s.pitch_rad = 0.1;
  s.alpha_rad = 0.02;
  s.specific_force_mps2 = {0.3, 0, -9.5};
  // Climbing at gamma = theta - alpha: V_dot = f . v_hat - g sin(gamma)
  CHECK(airspeed_rate(s) ==
        doctest::Approx(0.3 * std::cos(0.02) - 9.5 * std::sin(0.02) - g * std::sin(0.08)));
  // Banked, with sideslip: gravity in body axes from B&M (4.2).
  s.roll_rad = 0.5;
  s.beta_rad = 0.1;
  const double along = std::cos(0.02) * std::cos(0.1), side = std::sin(0.1),
               down = std::sin(0.02) * std::cos(0.1);
  const double ax = 0.3 - g * std::sin(0.1), ay = g * std::cos(0.1) * std::sin(0.5),
               az = -9.5 + g * std::cos(0.1) * std::cos(0.5);
  CHECK(airspeed_rate(s) == doctest::Approx(ax * along + ay * side + az * down));
}

TEST_CASE("below the minimum airspeed speed has priority and the engine gives all") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  s.height_m = 20;
  s.airspeed_mps = 8.5;  // 15 % below the minimum of 10
  const AttitudeCommand& a = settle(bench, s, level());
  CHECK(bench.out.underspeed_ratio.value == doctest::Approx(1));
  CHECK(a.throttle_frac == doctest::Approx(1));
  CHECK(a.pitch_rad < 0);
  s.airspeed_mps = 9.25;
  settle(bench, s, level());
  CHECK(bench.out.underspeed_ratio.value == doctest::Approx(0.5));
  s.airspeed_mps = 10;
  CHECK(settle(bench, s, level(), 6).pitch_rad > 0);
  CHECK(bench.out.underspeed_ratio.value == 0);
}

TEST_CASE(
    "throttle stays in 0 to 1, trim included, pitch within the pitch limits, for any state, command and "
    "law") {
  Random random(17);
  double least = 1, most = 0;
  for (OuterLaw law : {OuterLaw::hold, OuterLaw::takeoff}) {
    Bench<Outer> bench;
    bench.params.common.law.value = law;
    bench.params.common.airframe.value.limits.throttle_cruise_frac = 0.9;
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
      s.specific_force_mps2 = {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-40, 20)};
      const GuidanceCommand c{random.uniform(-10, 10), random.uniform(-100, 1000), random.uniform(-10, 10),
                              random.uniform(-5, 60), random.uniform(-2, 2)};
      bench.set(bench.in.state, s);
      bench.set(bench.in.command, c);
      REQUIRE(bench.step(random.uniform(0, 0.5)) != Status::failed);
      const AttitudeCommand& a = bench.out.attitude;
      REQUIRE((a.throttle_frac >= 0 && a.throttle_frac <= 1));
      REQUIRE(std::abs(a.pitch_rad) <= 0.35);
      REQUIRE(std::abs(a.roll_rad) <= 0.785);
      least = std::min(least, a.throttle_frac);
      most = std::max(most, a.throttle_frac);
    }
  }
  CHECK(least == 0);  // below trim as well as above it
  CHECK(most == 1);
}

TEST_CASE("pitch is bounded by the pitch limit, however large the roll limit") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  s.airspeed_mps = 24;
  GuidanceCommand c = level();
  c.airspeed_mps = 10;
  bench.params.speed_weight.value = 2;
  CHECK(settle(bench, s, c, 30).pitch_rad == doctest::Approx(0.35));
}

TEST_CASE("integrators that were saturated for a minute unwind at once") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  s.airspeed_mps = 10;
  settle(bench, s, level(), 60);
  CHECK(bench.out.attitude.throttle_frac == doctest::Approx(1).epsilon(0.001));
  const double integral = bench.out.throttle_integral_frac.value;
  CHECK(integral < 0.5);
  s.airspeed_mps = 16;
  settle(bench, s, level(), 0.5);
  CHECK(bench.out.throttle_integral_frac.value < integral);
  CHECK(bench.out.attitude.throttle_frac < 0.7);
}

TEST_CASE("taking over is bumpless, and in trim keeps what the last controller had learnt") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Bench<Outer> bench;
    VehicleState s = flying();
    s.height_m = random.uniform(40, 100);
    s.airspeed_mps = random.uniform(11, 20);
    s.course_rad = random.uniform(-3, 3);
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, level());
    Outer::Outputs last;
    last.attitude = {random.uniform(-0.7, 0.7), random.uniform(-0.3, 0.3), random.uniform(0, 1)};
    bench.activate(last);
    bench.step(0.01);
    CHECK(std::abs(bench.out.attitude.roll_rad - last.attitude.roll_rad) <= 0.0101);
    CHECK(std::abs(bench.out.attitude.pitch_rad - last.attitude.pitch_rad) <= 0.0081);
    CHECK(std::abs(bench.out.attitude.throttle_frac - last.attitude.throttle_frac) <= 0.0201);
  }
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

TEST_CASE("standing it learns nothing; without airspeed it flies on trim and says degraded") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  s.height_m = 0;
  s.airspeed_mps = s.ground_speed_mps = 0.2;
  CHECK(settle(bench, s, level(), 60).throttle_frac == 0);
  CHECK(bench.out.pitch_integral_rad.value == 0);
  CHECK(bench.out.throttle_integral_frac.value == 0);
  s = flying();
  s.airspeed_valid = false;
  s.airspeed_mps = 0;
  CHECK(settle(bench, s, level(), 10).throttle_frac == doctest::Approx(0.5));
  CHECK(bench.step(0.01) == Status::degraded);
}

TEST_CASE("a command without airspeed does no harm") {
  Bench<Outer> bench;
  configure(bench);
  GuidanceCommand c = level();
  c.airspeed_mps = 0;
  const AttitudeCommand& a = settle(bench, flying(), c, 20);
  CHECK((std::isfinite(a.throttle_frac) && std::isfinite(a.pitch_rad)));
  CHECK(a.throttle_frac < 0.5);
}

TEST_CASE(
    "when a pilot hands back the throttle begins at trim, roll and pitch at the attitude that he leaves, and "
    "nothing is learnt from him") {
  for (const double airspeed : {14.5, cruise, 15.5}) {
    Bench<Outer> bench;
    configure(bench);
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
    configure(bench);
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
    // The integrals take over the difference between the glide and the command of the law. Throttle: within
    // its bounds. Pitch: 0 = k (B_c - B) / (g V) + I with B_c = 0, since no climb is demanded in the tick of
    // the hand-over, and B = 0.4 V g sin(0.1). Without a law before they stay 0.
    const double B = 0.4 * cruise * g * std::sin(0.1);
    const double integral = 0.6 * B / (g * cruise);
    CHECK(std::abs(bench.out.throttle_integral_frac.value - (with_last ? -0.2 : 0)) < 0.004);
    CHECK(std::abs(bench.out.pitch_integral_rad.value - (with_last ? integral : 0)) < 3e-4);
    CHECK(integral > 0.015);
  }
}

TEST_CASE("a step allocates nothing") {
  Bench<Outer> bench;
  settle(bench, flying(), level());
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

TEST_CASE(
    "without attitude or height it asks for level wings and the trim of cruise; known again, it goes on from "
    "the attitude there is") {
  for (const bool attitude : {true, false}) {
    Bench<Outer> bench;
    configure(bench);
    VehicleState s = flying();
    GuidanceCommand c = level();
    c.course_rad = 1;
    c.height_m = 90;
    CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0.785));
    s.roll_rad = 0.6;
    s.airspeed_mps = 5;
    s.airspeed_valid = false;  // invalid values that must have no effect
    (attitude ? s.height_valid : s.attitude_valid) = false;
    CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0).epsilon(1e-6));
    CHECK(bench.out.attitude.pitch_rad ==
          doctest::Approx(0));  // the default airframe has no derivatives for a trim
    CHECK(bench.out.attitude.throttle_frac == doctest::Approx(0.5));
    CHECK(bench.step(0.01) == Status::degraded);
    s = flying();
    s.roll_rad = -0.4;
    s.pitch_rad = 0.12;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, level());
    CHECK(bench.step(0.01) == Status::ok);
    CHECK(std::abs(bench.out.attitude.roll_rad + 0.4) <= 0.0401);
    CHECK(std::abs(bench.out.attitude.pitch_rad - 0.12) <= 0.0081);
    CHECK(std::abs(bench.out.attitude.throttle_frac - 0.5) <= 0.0201);
  }
}

TEST_CASE("without a velocity there is no course to hold: wings level") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  s.velocity_valid = false;
  GuidanceCommand c = level();
  c.course_rad = 1;
  c.roll_feedforward_rad = 0.3;
  CHECK(settle(bench, s, c).roll_rad == doctest::Approx(0));
  CHECK(bench.step(0.01) == Status::degraded);
}

TEST_CASE("speed may take half of what the engine gives and half of what the drag takes, no more") {
  for (const double off : {-9.0, 9.0}) {
    Bench<Outer> bench;
    configure(bench);
    VehicleState s = flying();
    s.airspeed_mps = 15 - off;  // too fast, too slow
    GuidanceCommand c = level();
    c.airspeed_mps = 15;
    settle(bench, s, c);
    const FlightLimits& limits = bench.params.common.airframe.value.limits;
    const double power = g * (off < 0 ? -limits.sink_rate_max_mps : limits.climb_rate_max_mps);
    CHECK(bench.out.acceleration_demand_mps2.value / (0.5 * power / s.airspeed_mps) == doctest::Approx(1));
  }
}

TEST_CASE("that the throttle is at its limit is told, and that it is not") {
  Bench<Outer> bench;
  configure(bench);
  VehicleState s = flying();
  settle(bench, s, level());
  CHECK_FALSE(bench.out.internals.throttle_saturated);
  s.airspeed_mps = 11;
  settle(bench, s, level());
  CHECK(bench.out.internals.throttle_saturated);
}

TEST_CASE("too slow by the whole band the nose goes down for speed, however much climb is wanted") {
  Bench<Outer> bench;
  configure(bench);
  bench.params.pitch_damping.value = bench.params.pitch_integral.value = 0;
  bench.params.throttle_damping.value = 0;  // the engine follows: no shortfall
  VehicleState s = flying();
  s.airspeed_mps = 8.5;
  s.height_m = 20;
  const double V_dot = 0.5 * g * 4 / 8.5;  // half of the engine's limit
  CHECK(settle(bench, s, level()).pitch_rad / (-V_dot / g) == doctest::Approx(1));
}

TEST_CASE("far from its height it climbs as fast as half the limit of acceleration can stop in time") {
  Bench<Outer> bench;
  configure(bench);
  for (const double off : {3.0, -3.0}) {
    VehicleState s = flying();
    s.height_m = 70 - off;
    settle(bench, s, level());
    // 2 m/s2 and gain 1.2: linear within 2 / 1.2^2 m, then v^2 / (2 a) with half of that taken off
    const double rate = std::sqrt(2 * 2 * (3 - 0.5 * 2 / (1.2 * 1.2)));
    CHECK(bench.out.climb_rate_demand_mps.value / std::copysign(std::min(rate, off > 0 ? 4.0 : 3.0), off) ==
          doctest::Approx(1));
  }
}

}  // namespace tecs_test
