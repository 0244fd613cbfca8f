// SPDX-License-Identifier: BSD-3-Clause
// Steps of one tick, and activations away from trim: exact numbers.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>

#include "plugins/control_slc/airspeed.hpp"
#include "plugins/control_slc/outer.hpp"

namespace off_nominal_test {

using namespace fulmar;
using doctest::Approx;

namespace {

VehicleState flying(double airspeed_mps) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed_mps;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -isa::g0};
  return s;
}

/// The throttle alone, without gains, of an airframe of 12 to 30 m/s whose forces are known.
struct Throttle : Bench<slc::Airspeed> {
  Throttle() {
    Airframe& a = params.airframe.value;
    a.mass_kg = 4;
    a.wing.area_m2 = 0.5;
    a.wing.span_m = 2;
    a.wing.chord_m = 0.25;
    a.wing.oswald_ratio = 0.9;
    a.aero = {};
    a.aero.lift.alpha_ratio = 5;
    a.aero.pitch.elevator_ratio = -1;
    a.aero.parasite_drag_ratio = 0.03;
    a.limits.airspeed_min_mps = 12;
    a.limits.airspeed_cruise_mps = 18;
    a.limits.airspeed_max_mps = 30;
    a.limits.throttle_cruise_frac = 0.4;
    params.thrust.value = 40;
    params.speed_kp.value = params.speed_ki.value = 0;
    params.throttle_rate_limit.value = 100;
  }
  double begin(double airspeed_mps, double command_mps) {
    GuidanceCommand command;
    command.airspeed_mps = command_mps;
    set(in.state, flying(airspeed_mps));
    set(in.wanted, AttitudeCommand{});
    set(in.command, command);
    retune();
    activate();
    return again();
  }
  double again() {
    step(0.01);
    return out.attitude.throttle_frac;
  }
};

}  // namespace

TEST_CASE("taken over while the airspeed asked for is beyond the limits: the throttle is that of the limit") {
  for (const auto& [beyond, limit] : {std::pair{60.0, 30.0}, {31.0, 30.0}, {11.0, 12.0}, {2.0, 12.0}}) {
    CAPTURE(beyond);
    Throttle out, in;
    CHECK(out.begin(20, beyond) == in.begin(20, limit));
    for (int i = 0; i < 50; ++i) REQUIRE(out.again() == in.again());
  }
}

TEST_CASE("taken over the throttle is that of the speed asked for, whatever the present one") {
  for (const double command : {14.0, 18.0, 26.0}) {
    Throttle at;
    const double first = at.begin(command, command);
    for (const double airspeed : {13.0, 19.0, 28.0}) {
      Throttle other;
      CHECK(other.begin(airspeed, command) == Approx(first));
      CHECK(other.again() == Approx(first));  // no acceleration is fed forward: the command is unchanged
    }
  }
}

TEST_CASE("a gust of one tick does not move the climb that a height error asks for; a lasting one does") {
  Bench<slc::Outer> bench;
  bench.params.altitude_ki.value = 0;
  GuidanceCommand command{.course_rad = 0, .height_m = 71.5, .airspeed_mps = 17};
  const auto climb = [&](double airspeed_mps, double seconds) {
    bench.set(bench.in.state, flying(airspeed_mps));
    bench.set(bench.in.command, command);
    for (double t = 0; t < seconds - 0.005; t += 0.01) bench.step(0.01);
    return bench.out.climb_rate_demand_mps.value;
  };
  const double before = climb(17, 20), kp = bench.params.altitude_kp;
  CHECK(before == Approx(kp * 17 * 1.5).epsilon(0.001));
  CHECK(climb(19, 0.01) / before == Approx(1).epsilon(0.01));
  CHECK(climb(19, 20) == Approx(kp * 19 * 1.5).epsilon(0.001));
  command.height_m = 68.5;  // and downwards
  CHECK(climb(19, 0.01) == Approx(-kp * 19 * 1.5).epsilon(0.001));
  CHECK(climb(17, 0.01) == Approx(-kp * 19 * 1.5).epsilon(0.01));
}

TEST_CASE("the take-off law keeps the course of its own runway: the second one, too, and any direction") {
  Bench<slc::Outer> bench;
  bench.params.common.law.value = OuterLaw::takeoff;
  bench.params.common.takeoff_kp.value = 1;
  const auto look = [&](double airspeed_mps, double course_rad, int steps = 1) {
    VehicleState s = flying(airspeed_mps);
    s.yaw_rad = s.course_rad = course_rad;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 0, .height_m = 100, .airspeed_mps = 17});
    for (int i = 0; i < steps; ++i) bench.step(0.01);
    return bench.out.attitude.roll_rad;
  };
  for (const double runway : {1.5, -2.6, 0.4}) {
    CAPTURE(runway);
    VehicleState s = flying(0);
    s.yaw_rad = s.course_rad = runway;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 0, .height_m = 100, .airspeed_mps = 17});
    REQUIRE(bench.retune() == Status::ok);
    REQUIRE(bench.activate() == Status::ok);
    CHECK(look(0, runway, 10) == 0);
    CHECK(std::abs(look(15, runway, 100)) < 1e-9);
    CHECK(look(15, runway + 0.1, 300) == Approx(-0.1));
    CHECK(look(15, runway - 0.1, 300) == Approx(0.1));
  }
}

}  // namespace off_nominal_test
