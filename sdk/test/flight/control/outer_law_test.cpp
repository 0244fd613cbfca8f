// SPDX-License-Identifier: BSD-3-Clause
// Common part of the outer laws: parameters, sequence of a step, and the demands of a turn.
#include <doctest/doctest.h>

#include <fulmar/flight/control/outer_law.hpp>
#include <string>

#include "sdk/test/flight/flight_model.hpp"

namespace outer_law_test {

using namespace fulmar;

namespace {

struct Outputs {
  AttitudeCommand attitude;
  ControllerInternals internals;
};

VehicleState flying() {
  VehicleState s;
  s.height_m = 70;
  s.origin_altitude_m = 1387;
  s.airspeed_mps = s.ground_speed_mps = 17;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  return s;
}

/// A law that counts its calls.
struct Counting {
  OuterLoop loop;
  OuterParams params;
  Outputs out;
  PitchThrottle answer{0.1, 0.6};
  LevelTurn turn{};
  double dt_s = 0;
  int rests = 0, holds = 0;

  Status step(const VehicleState& state, const GuidanceCommand& command, double after_s = 0.01) {
    Tick tick;
    tick.dt_ns = static_cast<std::int64_t>(1e9 * after_s);
    const auto rest = [&] { ++rests; };
    const auto hold = [&](const LevelTurn& wanted, double dt) {
      ++holds;
      turn = wanted;
      dt_s = dt;
      return answer;
    };
    return loop.step(tick, state, command, params, out, rest, hold);
  }
};

}  // namespace

TEST_CASE("every shared parameter comes to its place, and of two roll limits the smaller one holds") {
  OuterParams p;
  p.course_kp.value = 1.5;
  p.course_ki.value = 0.25;
  p.roll_limit.value = 0.6;
  p.roll_rate_limit.value = 0.75;
  p.roll_smoothing.value = 0.125;
  p.pitch_rate_limit.value = 0.3;
  p.throttle_rate_limit.value = 3;
  p.takeoff_throttle.value = 0.9;
  p.takeoff_pitch.value = 0.2;
  p.takeoff_airspeed.value = 12;
  p.takeoff_kp.value = 0.7;
  p.takeoff_roll_limit.value = 0.1;
  FlightLimits& limits = p.airframe.value.limits;
  limits.airspeed_cruise_mps = 18;
  limits.roll_max_rad = 0.8;
  const OuterTuning t = tuning(p);
  CHECK(t.course.kp == 1.5);
  CHECK(t.course.ki == 0.25);
  CHECK(t.course.cruise_mps == 18);
  CHECK(t.course.roll_max_rad == 0.6);
  CHECK(t.course.roll_rate_max_radps == 0.75);
  CHECK(t.course.smoothing_s == 0.125);
  CHECK(t.pitch_rate_max_radps == 0.3);
  CHECK(t.throttle_rate_max_hz == 3);
  CHECK(t.takeoff.throttle_frac == 0.9);
  CHECK(t.takeoff.pitch_rad == 0.2);
  CHECK(t.takeoff.rotate_mps == 12);
  CHECK(t.takeoff.course_kp == 0.7);
  CHECK(t.takeoff.roll_max_rad == 0.1);
  limits.roll_max_rad = 0.3;
  CHECK(tuning(p).course.roll_max_rad == 0.3);
}

TEST_CASE(
    "a level turn needs the pitch that keeps height and more drag than level flight, by the share fed "
    "forward") {
  OuterParams p;
  p.airframe.value = test::anaconda();
  const VehicleState s = flying();
  const double rho = standard_air(1387 + 70).density_kgm3, phi = 0.7;
  const TurnTrim level = turn_trim(*p.airframe, 0, 17, rho), turn = turn_trim(*p.airframe, phi, 17, rho);
  REQUIRE(turn.alpha_rad * std::cos(phi) - level.alpha_rad > 0.01);
  REQUIRE(turn.drag_newton - level.drag_newton > 0.5);
  CHECK(level_turn(0, 17, air_density(s), p).pitch_rad == doctest::Approx(level.alpha_rad).epsilon(1e-6));
  CHECK(level_turn(0, 17, air_density(s), p).drag_newton == 0);
  for (const double share : {0.0, 0.5, 1.0}) {
    p.turn_kff.value = share;
    const LevelTurn needs = level_turn(phi, 17, air_density(s), p);
    CHECK(needs.Va_mps == 17);
    // Only the vertical part of the additional angle of attack in a turn is pitch.
    const double pitch = level.alpha_rad + share * (turn.alpha_rad * std::cos(phi) - level.alpha_rad);
    CHECK(std::abs(needs.pitch_rad - pitch) < 1e-12);
    CHECK(std::abs(needs.drag_newton - share * (turn.drag_newton - level.drag_newton)) < 1e-12);
  }
}

TEST_CASE("near the stall the bank is what the wing carries, to both sides; at cruise it is the limit's") {
  // Slowest level flight 10 m/s: a tenth above it is 11 m/s, and lift grows with the square of the speed.
  CHECK(bank_carried(22, 10) == doctest::Approx(std::acos(0.25)));
  CHECK(bank_carried(12, 10) == doctest::Approx(std::acos(121.0 / 144)));
  for (const double slow : {11.0, 8.0, 0.0, -3.0}) CHECK(bank_carried(slow, 10) == 0.26);
  // The stall speed of the law is that of the limits, 12 / 1.2 m/s: 10 % above it is more than 5 % above that
  // of the model. Model: 4.5 kg on 0.52 m2 with a CL of 1.515 in the density there.
  const double stall_squared = 2 * 4.5 * 9.80665 / (standard_air(1387 + 70).density_kgm3 * 0.52 * 1.515);
  REQUIRE(1.05 * 1.05 * stall_squared < 121);
  const double bank_12 = std::acos(121.0 / 144);
  struct Case {
    double airspeed_mps;
    bool valid;
    double roll_rad;
  };
  for (const Case& c : {Case{12, true, bank_12}, {17, true, 0.7}, {7, true, 0.26}, {7, false, 0.7}})
    for (const double side : {1.0, -1.0}) {
      CAPTURE(c.airspeed_mps);
      CAPTURE(side);
      Counting law;
      law.params.airframe.value = test::anaconda();
      law.params.airframe.value.limits.airspeed_min_mps = 12;
      law.params.airframe.value.limits.roll_max_rad = 1;
      law.params.roll_limit.value = 0.7;
      VehicleState s = flying();
      s.airspeed_mps = c.airspeed_mps;
      s.airspeed_valid = c.valid;
      GuidanceCommand command;
      command.course_rad = side * 1.5;
      for (int i = 0; i < 400; ++i) law.step(s, command);
      CHECK(law.out.attitude.roll_rad == doctest::Approx(side * c.roll_rad).epsilon(3e-3));
      CHECK(law.out.internals.roll_saturated);
      CHECK(law.out.internals.bank_limited == (c.roll_rad < 0.7));
      s.airspeed_mps = 20;
      s.airspeed_valid = true;  // fast again
      for (int i = 0; i < 400; ++i) law.step(s, command);
      CHECK(law.out.attitude.roll_rad == doctest::Approx(side * 0.7).epsilon(1e-3));
    }
}

TEST_CASE("only when height and speed are held is the law asked; else it rests") {
  Counting law;
  law.params.airframe.value = test::anaconda();
  VehicleState ground;
  ground.airspeed_valid = ground.attitude_valid = ground.height_valid = ground.velocity_valid = true;
  CHECK(law.step(ground, {}) == Status::ok);
  CHECK(law.rests == 1);
  CHECK(law.out.attitude.throttle_frac == 0);

  law.params.law.value = OuterLaw::takeoff;
  CHECK(law.step(flying(), {}) == Status::ok);
  CHECK(law.rests == 2);
  CHECK(law.out.internals.law == OuterLaw::takeoff);
  CHECK(law.holds == 0);

  law.params.law.value = OuterLaw::hold;
  GuidanceCommand command;
  command.course_rad = 0.1;
  for (int i = 0; i < 300; ++i) CHECK_EQ(law.step(flying(), command), Status::ok);
  CHECK(law.rests == 2);
  CHECK(law.holds == 300);
  CHECK(law.dt_s == doctest::Approx(0.01));
  const double phi =
      2.0 * 17 / law.params.airframe->limits.airspeed_cruise_mps * 0.1;  // kp Vg / Vg_ref times error
  CHECK(law.out.attitude.roll_rad == doctest::Approx(phi).epsilon(1e-6));
  CHECK(law.turn.drag_newton ==
        doctest::Approx(level_turn(phi, 17, air_density(flying()), law.params).drag_newton).epsilon(1e-6));
  CHECK(law.turn.drag_newton > 0);
  CHECK(law.out.attitude.pitch_rad == 0.1);
  CHECK(law.out.attitude.throttle_frac == 0.6);
  CHECK(law.out.internals.roll_rad == law.out.attitude.roll_rad);
  CHECK(law.out.internals.pitch_rad == 0.1);
  CHECK(law.out.internals.course_error_rad == doctest::Approx(0.1));
  CHECK(law.out.internals.law == OuterLaw::hold);

  law.step(flying(), command, 5);
  CHECK(law.dt_s == 0.1);  // a gap moves the integrators only a little
  VehicleState lost = flying();
  lost.height_valid = false;
  for (int i = 0; i < 300; ++i) CHECK_EQ(law.step(lost, command), Status::degraded);
  CHECK(law.rests == 302);
  const FlightLimits& limits = law.params.airframe->limits;
  CHECK(law.out.attitude.throttle_frac == limits.throttle_cruise_frac);
  const double rho = standard_air(1387 + 70).density_kgm3;
  const double alpha = turn_trim(*law.params.airframe, 0, limits.airspeed_cruise_mps, rho).alpha_rad;
  CHECK(law.out.attitude.pitch_rad == doctest::Approx(alpha).epsilon(1e-9));
  CHECK(std::abs(law.out.attitude.roll_rad) < 1e-6);

  VehicleState slow_air = flying();
  slow_air.airspeed_valid = false;
  CHECK(law.step(slow_air, command) == Status::degraded);  // controlled, but below the demand
  CHECK(law.holds == 302);
}

TEST_CASE("trims follow the airspeed with its time constant, from where it was at the activation") {
  Counting law;
  law.params.airframe.value = test::anaconda();
  law.params.airspeed_smoothing.value = 0.5;
  Outputs applied;
  VehicleState s = flying();
  s.airspeed_mps = 14;
  law.loop.activate(s, law.params, Applied<Outputs>::all(applied));
  law.step(s, {});
  CHECK(law.turn.Va_mps == doctest::Approx(14).epsilon(1e-9));
  s.airspeed_mps = 18;
  for (int i = 0; i < 50; ++i) law.step(s, {});
  CHECK(law.turn.Va_mps == doctest::Approx(18 - 4 * std::exp(-1)).epsilon(1e-6));  // after one time constant
  CHECK(law.turn.pitch_rad ==
        doctest::Approx(level_turn(0, law.turn.Va_mps, air_density(s), law.params).pitch_rad));
  law.params.airspeed_smoothing.value = 0;
  law.step(s, {});
  CHECK(law.turn.Va_mps == 18);
  s.airspeed_mps = 15;
  law.params.airspeed_smoothing.value = 0.5;
  law.loop.activate(s, law.params, Applied<Outputs>::all(applied));
  law.step(s, {});
  CHECK(law.turn.Va_mps == doctest::Approx(15).epsilon(1e-9));  // and not 18 from before
  law.params.law.value = OuterLaw::takeoff;
  s.airspeed_mps = 13;
  law.step(s, {});
  law.params.law.value = OuterLaw::hold;
  law.step(s, {});
  CHECK(law.turn.Va_mps == doctest::Approx(13).epsilon(1e-9));  // a take-off run is no gust
}

TEST_CASE("a law goes on from what was applied in its role, and begins anew after nobody") {
  OuterLoop loop;
  OuterParams p;
  Outputs outputs;
  outputs.attitude = {0.2, -0.1, 0.7};
  CHECK(loop.activate(flying(), p, Applied<Outputs>::all(outputs)));
  CHECK(loop.commands.last().throttle_frac == 0.7);
  CHECK(loop.commands.taking_up());
  auto others = Applied<Outputs>::all(outputs);
  others.made_bits = 0b10;  // a component flew, but without an attitude command
  CHECK_FALSE(loop.activate(flying(), p, others));
  CHECK(loop.commands.last().throttle_frac == p.airframe->limits.throttle_cruise_frac);
  CHECK_FALSE(loop.commands.taking_up());
}

TEST_CASE("what is not known matters in flight alone: on the ground nothing is degraded by it") {
  Counting law;
  VehicleState standing = flying();
  standing.airspeed_mps = standing.ground_speed_mps = 0;
  standing.position_valid = standing.velocity_valid = false;
  CHECK(law.step(standing, {}) == Status::ok);
  VehicleState blind = flying();
  blind.velocity_valid = false;
  CHECK(law.step(blind, {}) == Status::degraded);
}

TEST_CASE("a stall takes the law out: nose down, wings level, full power, degraded; then on without a step") {
  Counting law;
  law.params.airframe.value = test::anaconda();
  GuidanceCommand command;
  command.course_rad = 1.5;
  command.height_m = 70;
  command.airspeed_mps = 12;
  VehicleState s = flying();
  s.airspeed_mps = 13;
  s.wind_valid = true;
  s.specific_force_mps2.z = -9.8;
  for (int i = 0; i < 300; ++i) law.step(s, command);
  REQUIRE(law.out.attitude.roll_rad > 0.3);
  VehicleState stalled = s;
  stalled.pitch_rad = 0.3;
  stalled.climb_rate_mps = -5;
  stalled.alpha_rad = 0.7;
  Status status = Status::ok;
  for (int i = 0; i < 150; ++i) status = law.step(stalled, command);
  CHECK(status == Status::degraded);
  CHECK(law.out.internals.stalled);
  CHECK(std::abs(law.out.attitude.roll_rad) < 0.01);
  CHECK(law.out.attitude.throttle_frac == 1);
  CHECK(law.out.attitude.pitch_rad < -0.2);
  const int held = law.holds;
  AttitudeCommand before = law.out.attitude;
  for (int i = 0; i < 60; ++i) {
    law.step(s, command);
    CHECK(std::abs(law.out.attitude.pitch_rad - before.pitch_rad) < 0.0081);
    CHECK(std::abs(law.out.attitude.roll_rad - before.roll_rad) < 0.0101);
    CHECK(std::abs(law.out.attitude.throttle_frac - before.throttle_frac) < 0.0201);
    before = law.out.attitude;
  }
  CHECK_FALSE(law.out.internals.stalled);
  CHECK(law.holds > held);
  law.loop.flares = true;
  for (int i = 0; i < 150; ++i) status = law.step(stalled, command);
  CHECK_FALSE(law.out.internals.stalled);
}

TEST_CASE("after a fall the loop climbs at full power and little bank, then the law goes on without a step") {
  Counting law;
  law.params.airframe.value = test::anaconda();
  GuidanceCommand command;
  command.course_rad = 1.5;
  command.height_m = 90;
  command.airspeed_mps = 12;
  VehicleState s = flying();
  s.wind_valid = true;
  s.specific_force_mps2.z = -9.8;
  for (int i = 0; i < 200; ++i) law.step(s, command);
  REQUIRE(law.out.attitude.roll_rad > 0.5);
  s.climb_rate_mps = -4;
  for (int i = 0; i < 40; ++i) law.step(s, command);
  CHECK_EQ(law.holds, 240);  // a sink at a switch ends without help
  for (int i = 0; i < 20; ++i) law.step(s, command);
  const int held = law.holds;
  for (int i = 0; i < 100; ++i) law.step(s, command);
  CHECK_EQ(law.holds, held);
  CHECK_FALSE(law.out.internals.stalled);
  CHECK(law.out.attitude.throttle_frac == 1);
  CHECK(law.out.attitude.roll_rad < 0.27);
  CHECK_EQ(law.out.internals.height_error_m, 20);
  s.climb_rate_mps = 1;
  s.height_m = 89;
  const double throttle = law.out.attitude.throttle_frac;
  law.step(s, command);
  CHECK_EQ(law.holds, held + 1);
  CHECK(std::abs(law.out.attitude.throttle_frac - throttle) < 0.0201);
}

TEST_CASE("a law that sinks at its pitch limit with the throttle closed is refused after seconds") {
  Counting law;
  law.params.airframe.value = test::anaconda();
  VehicleState s = flying();
  s.climb_rate_mps = -3;
  law.answer = {0.3, 0};
  const auto hold = [&] {
    Tick tick;
    tick.dt_ns = 10'000'000;
    const auto rest = [] {};
    const auto asks = [&](const LevelTurn&, double) {
      law.out.internals.height_error_m = 20;
      law.out.internals.pitch_saturated = true;
      return law.answer;
    };
    return law.loop.step(tick, s, GuidanceCommand{}, law.params, law.out, rest, asks);
  };
  for (int i = 0; i < 350; ++i) CHECK_EQ(hold(), Status::ok);
  Status status = Status::ok;
  for (int i = 0; i < 150; ++i) status = hold();
  CHECK(status == Status::failed);
  law.answer.throttle_frac = 1;
  for (int i = 0; i < 600; ++i) status = hold();
  CHECK(status == Status::degraded);
  CHECK(law.out.internals.height_uncontrolled);
}

}  // namespace outer_law_test
