// SPDX-License-Identifier: BSD-3-Clause
// Feed-forward, with the integrals off or before they act: away from cruise speed and from sea level, with an
// airframe that has aerodynamics. Also the state that a law clears when it is activated or at rest.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>

#include "plugins/control_slc/inner.hpp"
#include "plugins/control_slc/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace feed_forward_test {

using namespace fulmar;
using doctest::Approx;

namespace {
VehicleState flying(double airspeed = 15) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -isa::g0};
  return s;
}
GuidanceCommand level(double airspeed, double roll = 0, double course = 0) {
  return {.course_rad = course,
          .height_m = 70,
          .climb_rate_mps = 0,
          .airspeed_mps = airspeed,
          .roll_feedforward_rad = roll};
}
template <class Law>
void fly(Bench<Law>& bench, const GuidanceCommand& command, const VehicleState& state, int steps) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.command, command);
  for (int i = 0; i < steps; ++i) bench.step(0.01);
}
}  // namespace

TEST_CASE("an inner loop that is activated again takes the yaw rate of then as steady") {
  Bench<slc::Inner> bench;
  bench.set(bench.in.state, flying());
  bench.set(bench.in.attitude, AttitudeCommand{});
  for (int i = 0; i < 300; ++i) bench.step(0.01);
  VehicleState turning = flying();
  turning.rate_radps.z = 0.5;
  bench.set(bench.in.state, turning);
  slc::Inner::Outputs last;
  last.actuators = {0.5, 0.01, 0.01, 0};
  bench.activate(last);
  bench.step(0.01);
  CHECK(std::abs(bench.out.actuators.rudder_rad) < 0.01);
}

TEST_CASE("the aileron fed forward for a roll rate grows as the speed falls, not as its square") {
  Bench<slc::Inner> bench;
  auto& p = bench.params;
  p.roll_ki.value = p.pitch_ki.value = p.roll_kp.value = p.roll_kd.value = 0;
  bench.set(bench.in.state, flying(10));  // two thirds of the cruise speed
  for (int i = 0; i <= 60; ++i) {
    bench.set(bench.in.attitude, AttitudeCommand{0.008 * i, 0, 0});
    bench.step(0.01);
  }
  CHECK(bench.out.actuators.aileron_rad / (0.15 * 1.5 * 0.8) == Approx(1).epsilon(1e-3));
}

TEST_CASE("the elevator of a turn is that of the air at the field's altitude") {
  Bench<slc::Inner> bench;
  const Airframe a = test::anaconda();
  bench.params.airframe.value = a;
  bench.params.airframe.is_given = true;
  bench.params.roll_ki.value = bench.params.pitch_ki.value = 0;
  VehicleState s = flying(17);
  s.origin_altitude_m = 2000;
  s.roll_rad = 0.7;
  const TurnRates turn = turn_rates(0.7, 0, 17);
  s.rate_radps = {turn.p_radps, turn.q_radps, turn.r_radps};
  bench.set(bench.in.state, s);
  bench.set(bench.in.attitude, AttitudeCommand{0.7, 0, 0.5});
  bench.step(0.01);
  const double rho = standard_air(2070).density_kgm3;
  const double want = a.elevator.trim_rad + turn_trim(a, 0.7, 17, rho).elevator_rad -
                      turn_trim(a, 0, a.limits.airspeed_cruise_mps, rho).elevator_rad;
  CHECK(bench.out.actuators.elevator_rad / want == Approx(1).epsilon(1e-3));
}

TEST_CASE("the pitch of a level turn is the angle of attack times the cosine of the bank") {
  Bench<slc::Outer> bench;
  const Airframe a = test::anaconda();
  bench.params.common.airframe.value = a;
  bench.params.common.airframe.is_given = true;
  bench.params.altitude_ki.value = bench.params.airspeed_ki.value = 0;
  fly(bench, level(17, 0.7), flying(17), 500);
  const double want = turn_trim(a, 0.7, 17, standard_air(70).density_kgm3).alpha_rad * std::cos(0.7);
  CHECK(bench.out.attitude.pitch_rad / want == Approx(1).epsilon(1e-3));
}

TEST_CASE("the airframe's own roll limit holds where it is below the parameter's") {
  for (const double course : {2.0, -2.0}) {
    Bench<slc::Outer> bench;
    bench.params.common.airframe.value.limits.roll_max_rad = 0.3;
    fly(bench, level(15, 0, course), flying(), 500);
    CHECK(bench.out.attitude.roll_rad / std::copysign(0.3, course) == Approx(1));
  }
}

TEST_CASE("a take-off run forgets what the throttle has learnt") {
  Bench<slc::Outer> bench;
  fly(bench, level(16), flying(), 300);
  CHECK(bench.out.throttle_integral_frac.value > 0.1);
  bench.params.common.law.value = OuterLaw::takeoff;
  bench.retune();
  bench.step(0.01);
  CHECK(bench.out.throttle_integral_frac.value == 0);
}

TEST_CASE(
    "what the surfaces have learnt is forgotten on the ground, and when nobody's commands are taken up") {
  for (const bool lands : {true, false}) {
    CAPTURE(lands);
    Bench<slc::Inner> bench;
    bench.set(bench.in.state, flying());
    bench.set(bench.in.attitude, AttitudeCommand{0.05, 0.03, 0.5});
    for (int i = 0; i < 300; ++i) bench.step(0.01);
    if (!lands) REQUIRE(bench.activate() == Status::ok);
    bench.set(bench.in.attitude, AttitudeCommand{});
    VehicleState s = flying();
    if (lands) s.airspeed_mps = s.ground_speed_mps = s.height_m = 0;
    bench.set(bench.in.state, s);
    for (int i = 0; i < 100; ++i) bench.step(0.01);  // the command's rate fades
    CHECK(std::abs(bench.out.actuators.aileron_rad) < 1e-9);
    CHECK(std::abs(bench.out.actuators.elevator_rad) < 1e-9);
  }
}

TEST_CASE("the yaw damper's gain grows as the dynamic pressure falls") {
  const auto rudder = [](double airspeed) {
    Bench<slc::Inner> bench;
    VehicleState s = flying(airspeed);
    bench.set(bench.in.state, s);
    bench.set(bench.in.attitude, AttitudeCommand{});
    bench.step(0.01);
    s.rate_radps.z = 0.2;
    bench.set(bench.in.state, s);
    bench.step(0.01);
    return bench.out.actuators.rudder_rad;
  };
  CHECK(rudder(15) > 0.05);
  CHECK(rudder(10) / rudder(15) == Approx(1.5 * 1.5));
  CHECK(rudder(20) / rudder(15) == Approx(0.75 * 0.75));
}

TEST_CASE("an attitude that is lost in a steady turn moves no rudder") {
  Bench<slc::Inner> bench;
  VehicleState s = flying();
  s.roll_rad = 0.6;
  const TurnRates turn = turn_rates(0.6, 0, 15);
  s.rate_radps = {turn.p_radps, turn.q_radps, turn.r_radps};
  bench.set(bench.in.state, s);
  bench.set(bench.in.attitude, AttitudeCommand{0.6, 0, 0.5});
  for (int i = 0; i < 300; ++i) bench.step(0.01);
  s.attitude_valid = false;
  bench.set(bench.in.state, s);
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK(std::abs(bench.out.actuators.rudder_rad) < 1e-3);
}

TEST_CASE("below the minimum airspeed the elevator's trim is that of the minimum") {
  Bench<slc::Inner> bench;
  const Airframe a = test::anaconda();
  bench.params.airframe.value = a;
  bench.params.airframe.is_given = true;
  bench.params.pitch_ki.value = 0;
  bench.set(bench.in.state, flying(0.75 * a.limits.airspeed_min_mps));
  bench.set(bench.in.attitude, AttitudeCommand{});
  bench.step(0.01);
  const double rho = standard_air(70).density_kgm3;
  const double want = a.elevator.trim_rad + turn_trim(a, 0, a.limits.airspeed_min_mps, rho).elevator_rad -
                      turn_trim(a, 0, a.limits.airspeed_cruise_mps, rho).elevator_rad;
  CHECK(bench.out.actuators.elevator_rad / want == Approx(1).epsilon(1e-3));
}

TEST_CASE("the pitch fed forward for a climb is that of the present speed") {
  Bench<slc::Outer> bench;
  bench.params.altitude_ki.value = bench.params.altitude_kd.value = 0;
  GuidanceCommand climb = level(17);
  climb.climb_rate_mps = 2;
  fly(bench, climb, flying(17), 300);
  CHECK(bench.out.attitude.pitch_rad / (2.0 / 17) == Approx(1));
}

TEST_CASE("an airspeed is asked for within the airframe's limits") {
  const auto throttle = [](double wanted, double airspeed) {
    Bench<slc::Outer> bench;
    bench.params.airspeed_ki.value = 0;
    fly(bench, level(wanted), flying(airspeed), 300);
    return bench.out.attitude.throttle_frac;
  };
  CHECK(throttle(40, 24) == Approx(0.5 + 0.03 * (25 - 15) + 0.15 * (25 - 24)));  // 10 to 25 m/s, cruise 15
  CHECK(throttle(5, 11) == Approx(0.5 + 0.03 * (10 - 15) + 0.15 * (10 - 11)));
}

TEST_CASE("the throttle fed forward for a turn is its drag over the thrust") {
  const Airframe a = test::anaconda();
  const auto throttle = [&](double roll) {
    Bench<slc::Outer> bench;
    bench.params.common.airframe.value = a;
    bench.params.common.airframe.is_given = true;
    bench.params.altitude_ki.value = bench.params.airspeed_ki.value = 0;
    fly(bench, level(17, roll), flying(17), 500);
    return bench.out.attitude.throttle_frac;
  };
  const double rho = standard_air(70).density_kgm3, thrust = slc::Outer::Params{}.thrust;
  const double drag = turn_trim(a, 0.7, 17, rho).drag_newton - turn_trim(a, 0, 17, rho).drag_newton;
  CHECK((throttle(0.7) - throttle(0)) / (drag / thrust) == Approx(1).epsilon(1e-3));
}

TEST_CASE("a climb that is limited is told as saturated though the pitch is not at its limit") {
  Bench<slc::Outer> bench;
  bench.params.altitude_kd.value = 0;
  GuidanceCommand above = level(15);
  above.height_m = 170;
  fly(bench, above, flying(), 300);
  CHECK(bench.out.attitude.pitch_rad < 0.34);
  CHECK(bench.out.internals.pitch_saturated);
  above.height_m = 71;
  fly(bench, above, flying(), 1);
  CHECK_FALSE(bench.out.internals.pitch_saturated);
}

namespace {
/// A descent or climb at the limit of 0.6 m/s, after two minutes. The aircraft follows its pitch at once. The
/// pitch of level flight changes: it is `before` while the law integrates, and `after` from the begin of the
/// descent on.
struct Limited {
  double climb_rate_mps, integral_rad;
};
Limited limited(double height_step_m, double before_rad, double after_rad) {
  Bench<slc::Outer> bench;
  Airframe a;
  a.limits.climb_rate_max_mps = a.limits.sink_rate_max_mps = 0.6;
  bench.params.common.airframe.value = a;
  bench.params.common.airframe.is_given = true;
  bench.params.altitude_kd.value = 0;
  VehicleState s = flying();
  GuidanceCommand c = level(15);
  for (int i = 0; i < 36000; ++i) {
    if (i == 24000) c.height_m = s.height_m + height_step_m;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, c);
    bench.step(0.01);
    const double level_pitch = i < 24000 ? before_rad * std::min(1.0, i / 18000.0) : after_rad;
    s.climb_rate_mps = 15 * (bench.out.attitude.pitch_rad - level_pitch);
    s.height_m += 0.01 * s.climb_rate_mps;
  }
  return {s.climb_rate_mps, bench.out.pitch_integral_rad.value};
}
}  // namespace

TEST_CASE("what the height loop has learnt does not hold off a limited climb or descent for ever") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    const double far = sign * 200;
    // 0.08 rad of bias are 1.2 m/s in the other direction; half of the demand is guaranteed
    CHECK(sign * limited(far, -sign * 0.08, 0).climb_rate_mps > 0.29);
    // a correct integral stays, and the climb rate is the demanded one
    CHECK(sign * limited(far, -sign * 0.08, -sign * 0.08).climb_rate_mps == Approx(0.6).epsilon(0.02));
    CHECK(sign * limited(far, sign * 0.08, sign * 0.08).climb_rate_mps == Approx(0.6).epsilon(0.02));
    // an integral that helps stays
    CHECK(sign * limited(far, 0, -sign * 0.01).climb_rate_mps == Approx(0.75).epsilon(0.02));
  }
  // without the climb of the engine nothing is integrated; a descent without sink is corrected in the end
  CHECK(limited(200, 0, 0.1).integral_rad == 0);
  CHECK(limited(-200, 0, -0.08).climb_rate_mps < -0.29);
  CHECK(limited(-200, 0, -0.5).integral_rad == Approx(-0.1).epsilon(0.02));  // rising air
}

TEST_CASE(
    "a lateral acceleration is flown as the bank that has it, to both sides, whatever course and speed") {
  for (const double airspeed : {11.0, 22.0}) {  // cruise is 15 m/s
    for (const double a : {3.0, -5.0}) {
      Bench<slc::Outer> bench;
      bench.params.common.course_ki.value = 0;
      GuidanceCommand command{.course_rad = 2, .height_m = 70, .airspeed_mps = airspeed};
      command.roll_feedforward_rad = -0.3;
      command.lateral = LateralMode::acceleration;
      command.lateral_acceleration_mps2 = a;
      bench.set(bench.in.state, flying(airspeed));
      bench.set(bench.in.command, command);
      for (int i = 0; i < 300; ++i) bench.step(0.01);
      CHECK(9.80665 * std::tan(bench.out.attitude.roll_rad) / a == Approx(1));
      CHECK(bench.out.internals.course_error_rad == 0);
      CHECK_FALSE(bench.out.internals.roll_saturated);
      command.lateral_acceleration_mps2 = 5 * a;
      bench.set(bench.in.command, command);
      for (int i = 0; i < 300; ++i) bench.step(0.01);
      CHECK(bench.out.attitude.roll_rad == Approx(std::copysign(0.785, a)));
      CHECK(bench.out.internals.roll_saturated);
    }
  }
}

}  // namespace feed_forward_test
