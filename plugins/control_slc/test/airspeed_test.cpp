// SPDX-License-Identifier: BSD-3-Clause
// Throttle for a commanded attitude, against the energy balance worked out by hand.
#include "plugins/control_slc/airspeed.hpp"

#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

namespace airspeed_test {

using namespace fulmar;
using doctest::Approx;
using Airspeed = slc::Airspeed;

namespace {
constexpr double g = 9.80665, mass = 4, cruise = 18, trim = 0.4, thrust = 20, rho = 1.225, area = 0.5;

/// Lift by angle of attack alone, an elevator without lift, drag of a parabolic polar; at sea level.
Airframe simple() {
  Airframe a;
  a.mass_kg = mass;
  a.wing.area_m2 = area;
  a.wing.span_m = 2;
  a.wing.chord_m = 0.25;
  a.wing.oswald_ratio = 0.9;
  a.aero = {};
  a.aero.lift.alpha_ratio = 5;
  a.aero.pitch.elevator_ratio = -1;
  a.aero.parasite_drag_ratio = 0.03;
  a.limits.airspeed_min_mps = 12;
  a.limits.airspeed_cruise_mps = cruise;
  a.limits.airspeed_max_mps = 30;
  a.limits.throttle_cruise_frac = trim;
  return a;
}
/// Level flight at bank 0, N.
double drag(double Va) {
  const double qS = 0.5 * rho * Va * Va * area, CL = mass * g / qS;
  return qS * (0.03 + CL * CL / (3.14159265358979 * 0.9 * 8));
}
double alpha(double Va) { return mass * g / (0.5 * rho * Va * Va * area) / 5; }

struct Loop : Bench<Airspeed> {
  VehicleState state;
  AttitudeCommand wanted;
  GuidanceCommand command;
  Loop() {
    params.airframe.value = simple();
    params.thrust.value = thrust;
    params.speed_ki.value = 0;
    params.throttle_rate_limit.value = 100;
    state.ground_speed_mps = state.airspeed_mps = command.airspeed_mps = cruise;
    state.airspeed_valid = state.attitude_valid = true;
    wanted.pitch_rad = alpha(cruise);
  }
  void give() {
    set(in.state, state);
    set(in.wanted, wanted);
    set(in.command, command);
  }
  double throttle(int steps = 1) {
    give();
    retune();
    for (int i = 0; i < steps; ++i) step(0.01);
    return out.attitude.throttle_frac;
  }
};
}  // namespace

TEST_CASE("level flight at cruise speed is trim; roll and pitch pass as they are") {
  Loop loop;
  loop.wanted.roll_rad = -0.3;
  loop.params.energy_kff.value = 0;
  CHECK(loop.throttle() == Approx(trim));
  CHECK(loop.out.attitude.roll_rad == -0.3);
  CHECK(loop.out.attitude.pitch_rad == loop.wanted.pitch_rad);
  Loop level;
  CHECK(level.throttle() == Approx(trim));
}

TEST_CASE("a climb and a descent are fed forward by gravity, at another speed by drag as well") {
  for (const double Va : {15.0, 18.0, 24.0})
    for (const double gamma : {-0.06, 0.08}) {
      CAPTURE(Va);
      CAPTURE(gamma);
      Loop loop;
      loop.state.airspeed_mps = loop.command.airspeed_mps = Va;
      loop.wanted.pitch_rad = alpha(Va) + gamma;
      const double newton = mass * g * std::sin(gamma) + drag(Va) - drag(cruise);
      CHECK(loop.throttle() - trim == Approx(newton / thrust));
      loop.params.energy_kff.value = 0.5;
      CHECK(loop.throttle() - trim == Approx(0.5 * newton / thrust));
    }
}

TEST_CASE("a moving airspeed command is fed forward by its acceleration, both ways") {
  for (const double rate : {-1.5, 1.5}) {
    Loop loop;
    loop.params.speed_kp.value = 0;
    loop.state.airspeed_mps = loop.command.airspeed_mps = cruise - rate;
    loop.give();
    loop.activate();
    for (int i = 0; i < 100; ++i) {
      loop.command.airspeed_mps += 0.01 * rate;
      loop.throttle();
    }
    // remainder of the filter after 1 s with its 0.2 s: exp(-5)
    CHECK(loop.out.attitude.throttle_frac - trim ==
          Approx(mass * rate * (1 - std::exp(-5)) / thrust).epsilon(0.01));
  }
}

TEST_CASE("an airspeed error acts by its gain, filtered; within the limits of the airframe") {
  for (const double error : {-2.0, 2.0}) {
    Loop loop;
    loop.params.energy_kff.value = 0;
    loop.give();
    loop.activate();
    loop.state.airspeed_mps = cruise - error;
    const double full = mass * 0.6 * error / thrust;
    CHECK((loop.throttle(30) - trim) / full == Approx(1 - std::exp(-1)));  // 0.3 s, the time constant
    CHECK((loop.throttle(500) - trim) / full == Approx(1));
  }
  Loop fast;
  fast.params.energy_kff.value = 0;
  fast.params.speed_kp.value = 0.1;
  fast.command.airspeed_mps = 100;
  CHECK(fast.throttle() - trim == Approx(mass * 0.1 * (30 - cruise) / thrust));
  CHECK(fast.out.airspeed_error_mps.value == Approx(30 - cruise));
}

TEST_CASE("the integral grows with what is left, and not into the stop of the throttle") {
  Loop loop;
  loop.params.energy_kff.value = loop.params.speed_kp.value = 0;
  loop.params.speed_ki.value = 0.2;
  loop.state.airspeed_mps = cruise - 1;
  CHECK(loop.throttle(100) - trim == Approx(mass * 0.2 / thrust));
  loop.throttle(100000);
  CHECK(loop.out.attitude.throttle_frac <= 1);
  loop.state.airspeed_mps = cruise + 1;
  CHECK(loop.throttle(300) < 1);  // 0.04 each second, less the filter
}

TEST_CASE("the throttle moves no faster than it may, and goes on from what was applied last") {
  Loop loop;
  loop.params.throttle_rate_limit.value = 1;
  loop.give();
  Airspeed::Outputs last;
  last.attitude = loop.wanted;
  last.attitude.throttle_frac = 0.55;
  loop.activate(last);
  CHECK(loop.throttle() == Approx(0.55));  // the integral takes the value over: no step
  CHECK(loop.throttle(50) == Approx(0.55));
  last.attitude.throttle_frac = 1;  // more than the integral takes up, 0.2
  loop.activate(last);
  CHECK(loop.throttle() == Approx(0.99));
  CHECK(loop.throttle(100) == Approx(0.6));
  loop.activate();  // no law before: trim, an empty integral
  CHECK(loop.throttle() == Approx(trim));
}

TEST_CASE(
    "roll and pitch go on from what was flown before, and to what is wanted at their rate, either way "
    "round") {
  for (const double side : {1.0, -1.0}) {
    Loop loop;
    loop.params.take_over_rate.value = 0.4;
    loop.wanted.roll_rad = 3.0 * side;
    loop.give();
    Airspeed::Outputs last;
    last.attitude = {-3.0 * side, loop.wanted.pitch_rad + 0.1 * side, 0.5};  // 0.283 rad over the back
    loop.activate(last);
    loop.throttle();
    CHECK(loop.out.attitude.roll_rad == Approx(-3.0 * side - 0.004 * side));
    CHECK(loop.out.attitude.pitch_rad == Approx(loop.wanted.pitch_rad + 0.096 * side));
    loop.throttle(50);  // 0.204 rad in all: the pitch is there, the roll has gone over the back
    CHECK(loop.out.attitude.roll_rad == Approx((2 * 3.14159265358979 - 3.0 - 0.204) * side));
    CHECK(loop.out.attitude.pitch_rad == loop.wanted.pitch_rad);
    loop.activate();  // no law before
    loop.throttle();
    CHECK(loop.out.attitude.roll_rad == loop.wanted.roll_rad);
  }
}

TEST_CASE("pitch is given up for airspeed where the throttle is at its stop, and only there") {
  const auto pitch_off = [](double error_mps, double kp, double trade_rad) {
    Loop loop;
    loop.params.energy_kff.value = 0;
    loop.params.speed_kp.value = kp;
    loop.params.pitch_trade.value = trade_rad;
    loop.give();
    loop.activate();
    loop.state.airspeed_mps = cruise - error_mps;
    loop.throttle(500);
    return loop.out.attitude.pitch_rad - loop.wanted.pitch_rad;
  };
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    CHECK(pitch_off(4 * side, 10, 0) == 0);       // saturated, but pitch may not be reduced
    CHECK(pitch_off(4 * side, 0.01, 0.07) == 0);  // far off, and thrust has more to give
    CHECK(pitch_off(0.4 * side, 10, 0.07) == 0);
    CHECK(pitch_off(4 * side, 10, 0.07) == Approx(-0.07 * side));
    const double some = pitch_off(1.5 * side, 10, 0.07);
    CHECK(some * side < -0.02);
    CHECK(some * side > -0.07);
  }
  // A take-over and a stop on the ground begin without it.
  Loop loop;
  loop.params.speed_kp.value = 10;
  loop.params.pitch_trade.value = 0.07;
  loop.state.airspeed_mps = cruise - 4;
  loop.throttle(500);
  REQUIRE(loop.out.attitude.pitch_rad < loop.wanted.pitch_rad);
  loop.state.airspeed_mps = cruise;
  loop.give();
  loop.activate();
  loop.throttle();
  CHECK(loop.out.attitude.pitch_rad == loop.wanted.pitch_rad);
}

TEST_CASE("activation forgets the airspeed of before") {
  Loop loop;
  loop.params.energy_kff.value = 0;
  loop.params.speed_kp.value = 2;
  loop.params.speed_ki.value = 1;
  loop.state.airspeed_mps = 12;
  loop.throttle(300);
  CHECK(loop.out.attitude.throttle_frac == 1);
  loop.state.airspeed_mps = cruise;
  loop.give();
  loop.activate();
  CHECK(loop.throttle() == Approx(trim));
  CHECK(loop.out.airspeed_error_mps.value == Approx(0));
}

TEST_CASE("without an airspeed: trim and feed-forward, degraded; standing: engine off") {
  Loop loop;
  loop.state.airspeed_valid = false;
  loop.state.airspeed_mps = 3;
  loop.params.speed_ki.value = 1;
  loop.wanted.pitch_rad = alpha(cruise) + 0.05;
  CHECK(loop.throttle(200) - trim == Approx(mass * g * std::sin(0.05) / thrust));
  CHECK(loop.step(0.01) == Status::degraded);
  loop.state = {};
  loop.state.airspeed_valid = true;
  CHECK(loop.throttle(100) == 0);
  CHECK(loop.step(0.01) == Status::ok);
}

TEST_CASE("an airspeed step allocates nothing") {
  Loop loop;
  loop.throttle();
  CHECK(allocations([&] { loop.step(0.01); }) == 0);
}

}  // namespace airspeed_test
