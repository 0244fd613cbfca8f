// SPDX-License-Identifier: BSD-3-Clause
// The law of energy errors against numbers worked out by hand and the book's normalised form.
#include "plugins/control_tecs/error_law.hpp"

#include <doctest/doctest.h>

#include <fulmar/random.hpp>
#include <fulmar/testing.hpp>

#include "sdk/test/flight/flight_model.hpp"

namespace error_law_test {

using namespace fulmar;
using doctest::Approx;

namespace {
constexpr double g =
    9.80665;  // default airframe: trim throttle 0.5 at 15 m/s, climb 4, sink 3 m/s, 10 to 25 m/s

VehicleState flying(double airspeed, double course = 0) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.course_rad = s.yaw_rad = course;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -g};
  return s;
}
GuidanceCommand level(double airspeed, double course = 0) {
  return {.course_rad = course,
          .height_m = 70,
          .climb_rate_mps = 0,
          .airspeed_mps = airspeed,
          .roll_feedforward_rad = 0};
}

struct Flown : Bench<tecs::ErrorLaw> {
  explicit Flown(bool integrals = false) {
    params.common.airframe.value.mass_kg = 4.5;
    params.airspeed_kff.value = 0;
    if (!integrals) params.total_integral.value = params.balance_integral.value = 0;
  }
  const AttitudeCommand& settle(const VehicleState& state, const GuidanceCommand& command,
                                double seconds = 3) {
    set(in.state, state);
    set(in.command, command);
    for (int i = 0; i < static_cast<int>(seconds * 100 + 0.5); ++i) step(0.01);
    return out.attitude;
  }
};
}  // namespace

TEST_CASE("it is the book's law: normalised errors of total energy and balance, whatever speed and course") {
  for (const double V : {12.0, 15.0, 22.0})
    for (const double side : {1.0, -1.0})
      for (const double course : {0.0, 3.1}) {
        CAPTURE(V);
        Flown law;
        const double trim = law.settle(flying(V, course), level(V, course)).pitch_rad;
        GuidanceCommand command = level(V + 0.3 * side, course);
        command.height_m += 1.5 * side;
        const AttitudeCommand u = law.settle(flying(V, course), command);
        // Beard & McLain: E = (K_e + U_e)/K_d, B = (U_e - K_e)/K_d with K_d = m Va_c^2 / 2
        const double K_d = 0.5 * std::pow(V + 0.3 * side, 2);
        const double K_e = K_d - 0.5 * V * V, U_e = g * 1.5 * side;
        const double kp_E = 1.5 * 4.5 * K_d / (V * 50), kp_B = 1.2 * K_d / (g * V);
        CHECK((u.throttle_frac - 0.5) / (kp_E * (K_e + U_e) / K_d) == Approx(1).epsilon(1e-6));
        CHECK((u.pitch_rad - trim) / (kp_B * (U_e - K_e) / K_d) == Approx(1).epsilon(1e-6));
        CHECK(law.out.total_error_ratio.value == Approx(K_e + U_e));
        CHECK(law.out.balance_error_ratio.value == Approx(U_e - K_e));
      }
}

TEST_CASE("by the weight pitch answers the height alone, or the airspeed alone") {
  for (const double weight : {0.0, 0.5, 1.5, 2.0}) {
    CAPTURE(weight);
    Flown law;
    law.params.speed_weight.value = weight;
    const double trim = law.settle(flying(17), level(17)).pitch_rad;
    GuidanceCommand command = level(17);
    command.height_m -= 1;
    const double by_height = law.settle(flying(17), command).pitch_rad - trim;
    CHECK(by_height == Approx(-1.2 / 17 * std::min(2 - weight, 1.0)));
    const double by_speed = law.settle(flying(17), level(17.2)).pitch_rad - trim;
    CHECK(by_speed == Approx(-1.2 * 0.5 * (17.2 * 17.2 - 17 * 17) / (g * 17) * std::min(weight, 1.0)));
  }
}

TEST_CASE("far away the climb and sink limits govern, that of the path included, and nothing is learnt") {
  for (const double path : {0.0, 2.0, -2.0})
    for (const double side : {1.0, -1.0}) {
      Flown law(true);
      const double trim = law.settle(flying(17), level(17), 0.5).pitch_rad;
      GuidanceCommand command = level(17);
      command.height_m += 200 * side;
      command.climb_rate_mps = path;
      const double rate = side > 0 ? 4 : -3;
      VehicleState s = flying(17);
      s.climb_rate_mps = rate;  // the demand is met
      const AttitudeCommand u = law.settle(s, command, 20);
      CHECK((u.pitch_rad - trim) * 17 / rate == Approx(1).epsilon(1e-6));
      CHECK(u.throttle_frac == Approx(0.5 + 4.5 * g * rate / (17 * 50)));
      CHECK(law.out.pitch_integral_rad.value == 0);
      CHECK(law.out.throttle_integral_frac.value == 0);
      CHECK(law.out.internals.pitch_saturated);
      CHECK(law.out.internals.height_error_m == Approx(200 * side));
    }
}

TEST_CASE("the path's climb and the turn's drag are fed forward") {
  Flown law;
  const Airframe a = test::anaconda();
  law.params.common.airframe.value = a;
  law.params.common.airframe.is_given = true;
  const AttitudeCommand straight = law.settle(flying(20), level(20));
  GuidanceCommand command = level(20);
  command.climb_rate_mps = 1.5;
  const AttitudeCommand climbs = law.settle(flying(20), command);
  CHECK(climbs.pitch_rad - straight.pitch_rad == Approx(1.5 / 20));
  CHECK(climbs.throttle_frac - straight.throttle_frac == Approx(a.mass_kg * g * 1.5 / (20 * 50)));
  for (const double side : {1.0, -1.0}) {
    command = level(20);
    command.roll_feedforward_rad = 0.6 * side;
    const AttitudeCommand turns = law.settle(flying(20), command);
    const double rho = standard_air(70).density_kgm3;
    const double drag = turn_trim(a, 0.6, 20, rho).drag_newton - turn_trim(a, 0, 20, rho).drag_newton;
    CHECK((turns.throttle_frac - straight.throttle_frac) / (drag / 50) == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("integrals: rate of the command per error, and none while the throttle is at its limit") {
  Flown law(true);
  GuidanceCommand command = level(17);
  command.height_m += 0.5;
  law.settle(flying(17), command, 2);
  CHECK(law.out.pitch_integral_rad.value == Approx(0.1 * 0.5 / 17 * 2));
  CHECK(law.out.throttle_integral_frac.value == Approx(0.2 * 4.5 * g * 0.5 / (17 * 50) * 2));
  law.params.common.airframe.value.limits.throttle_cruise_frac = 1;
  law.retune();
  const double before = law.out.throttle_integral_frac.value;
  law.settle(flying(17), command, 2);
  CHECK(law.out.throttle_integral_frac.value == before);
  CHECK(law.out.internals.throttle_saturated);
}

TEST_CASE("below the minimum airspeed speed has priority and the engine gives all") {
  Flown law;
  GuidanceCommand command = level(15);
  command.height_m += 100;
  const double high = law.settle(flying(10), command).pitch_rad;
  const AttitudeCommand u = law.settle(flying(8.5), command);
  CHECK(law.out.underspeed_ratio.value == Approx(1));
  CHECK(u.throttle_frac == 1);
  CHECK(u.pitch_rad < high - 0.2);
}

TEST_CASE(
    "without airspeed pitch holds the height, the throttle is trim and the climb, and it says degraded") {
  Flown law;
  VehicleState s = flying(15);
  s.airspeed_valid = false;
  const double trim = law.settle(s, level(20)).pitch_rad;
  CHECK(law.out.attitude.throttle_frac == Approx(0.5));
  GuidanceCommand command = level(20);
  command.height_m -= 1;
  const AttitudeCommand u = law.settle(s, command);
  CHECK(law.step(0.01) == Status::degraded);
  CHECK(u.pitch_rad - trim == Approx(-1.2 / 15));
  CHECK(u.throttle_frac == Approx(0.5 - 4.5 * g * 1.2 / (15 * 50)));
}

TEST_CASE("taking over is bumpless; after nobody it begins without integrals") {
  for (const double side : {1.0, -1.0}) {
    Flown law(true);
    law.settle(flying(15), level(15));
    const double trim = law.out.attitude.pitch_rad;
    tecs::ErrorLaw::Outputs last;
    last.attitude = {0.3 * side, trim + 0.08 * side, 0.5 + 0.15 * side};
    REQUIRE(law.activate(last) == Status::ok);
    law.step(0.01);
    CHECK(law.out.attitude.pitch_rad == Approx(last.attitude.pitch_rad).epsilon(1e-3));
    CHECK(law.out.attitude.throttle_frac == Approx(last.attitude.throttle_frac).epsilon(1e-3));
    CHECK(law.out.pitch_integral_rad.value / side > 0.05);
    REQUIRE(law.activate() == Status::ok);
    law.step(0.01);
    CHECK(law.out.pitch_integral_rad.value == 0);
  }
}

TEST_CASE("whatever it is told, what it says is finite and within its limits, without memory") {
  Flown law(true);
  Random random(5);
  law.settle(flying(15), level(15), 0.1);
  for (int i = 0; i < 3000; ++i) {
    VehicleState s = flying(30 * random.uniform(), 6 * random.uniform() - 3);
    s.height_m = 1000 * random.uniform() - 500;
    s.pitch_rad = random.uniform(-0.3, 0.3);
    s.climb_rate_mps = 40 * random.uniform() - 20;
    s.airspeed_valid = i % 3 != 0;
    s.height_valid = i % 5 != 0;
    s.attitude_valid = i % 7 != 0;
    GuidanceCommand c = level(60 * random.uniform() - 10, 3);
    c.height_m = 1e4 * random.uniform();
    c.climb_rate_mps = 100 * random.uniform() - 50;
    law.set(law.in.state, s);
    law.set(law.in.command, c);
    CHECK(allocations([&] { law.step(0.01); }) == 0);
    CHECK(law.validation_error() == "");
    CHECK(std::abs(law.out.attitude.pitch_rad) <= 0.35 + 1e-9);
  }
}

TEST_CASE(
    "what it has learnt does not hold off a limited climb or descent for ever, and what is true stays") {
  // The aircraft follows its pitch at once; level flight needs another pitch while the law integrates.
  const auto climb_rate = [](double side, double before_rad, double after_rad) {
    Flown law(true);
    FlightLimits& limits = law.params.common.airframe.value.limits;
    limits.climb_rate_max_mps = limits.sink_rate_max_mps = 0.6;
    VehicleState s = flying(15);
    GuidanceCommand c = level(15);
    for (int i = 0; i < 36000; ++i) {
      if (i == 24000) c.height_m = s.height_m + side * 200;
      law.set(law.in.state, s);
      law.set(law.in.command, c);
      law.step(0.01);
      const double level_pitch = i < 24000 ? before_rad * std::min(1.0, i / 18000.0) : after_rad;
      s.climb_rate_mps = 15 * (law.out.attitude.pitch_rad - level_pitch);
      s.height_m += 0.01 * s.climb_rate_mps;
    }
    return s.climb_rate_mps;
  };
  for (const double side : {1.0, -1.0}) {
    CHECK(side * climb_rate(side, -side * 0.08, 0) > 0.29);
    CHECK(side * climb_rate(side, -side * 0.08, -side * 0.08) == Approx(0.6).epsilon(0.02));
    CHECK(side * climb_rate(side, side * 0.08, side * 0.08) == Approx(0.6).epsilon(0.02));
  }
}

TEST_CASE("a throttle that has learnt too much does not hold off a limited descent for ever") {
  // Level at constant speed; throttle beyond the trim makes the aircraft climb.
  Flown law(true);
  FlightLimits& limits = law.params.common.airframe.value.limits;
  limits.climb_rate_max_mps = limits.sink_rate_max_mps = 0.6;
  VehicleState s = flying(15);
  GuidanceCommand c = level(15);
  const auto fly = [&](double lost_frac) {
    for (int i = 0; i < 24000; ++i) {
      law.set(law.in.state, s);
      law.set(law.in.command, c);
      law.step(0.01);
      const double level = 0.5 + lost_frac * std::min(1.0, i / 18000.0);
      s.climb_rate_mps = (law.out.attitude.throttle_frac - level) * 50 / (4.5 * g) * 15;
      s.height_m += 0.01 * s.climb_rate_mps;
    }
    return law.out.throttle_integral_frac.value;
  };
  CHECK(fly(0.1) == Approx(0.1).epsilon(0.05));
  c.height_m -= 300;
  fly(0);
  CHECK(s.climb_rate_mps < -0.29);
}

}  // namespace error_law_test
