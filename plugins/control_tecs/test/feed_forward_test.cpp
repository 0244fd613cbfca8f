// SPDX-License-Identifier: BSD-3-Clause
// Feed-forward of the energy laws in a turn, and no integration below the minimum airspeed.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>

#include "plugins/control_tecs/outer.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace feed_forward_test {

using namespace fulmar;
using doctest::Approx;

namespace {
VehicleState flying(double airspeed) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  s.specific_force_mps2 = {0, 0, -isa::g0};
  return s;
}
void fly(Bench<tecs::Outer>& bench, double wanted_mps, double roll, double airspeed) {
  bench.set(bench.in.state, flying(airspeed));
  bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                              .height_m = 70,
                                              .climb_rate_mps = 0,
                                              .airspeed_mps = wanted_mps,
                                              .roll_feedforward_rad = roll});
  for (int i = 0; i < 500; ++i) bench.step(0.01);
}
double throttle_at(double roll, const Airframe& a) {
  Bench<tecs::Outer> bench;
  bench.params.common.airframe.value = a;
  bench.params.common.airframe.is_given = true;
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  fly(bench, 17, roll, 17);
  return bench.out.attitude.throttle_frac;
}
}  // namespace

TEST_CASE("the engine is asked for the drag that a turn adds") {
  const Airframe a = test::anaconda();
  const double rho = standard_air(70).density_kgm3, thrust = tecs::Outer::Params{}.thrust;
  const double drag = turn_trim(a, 0.7, 17, rho).drag_newton - turn_trim(a, 0, 17, rho).drag_newton;
  CHECK((throttle_at(0.7, a) - throttle_at(0, a)) / (drag / thrust) == Approx(1).epsilon(1e-3));
}

TEST_CASE("the throttle learns nothing while the airspeed is below the minimum") {
  Bench<tecs::Outer> bench;
  fly(bench, 15, 0, 8.5);  // the minimum is 10 m/s, the band below it 1.5 m/s
  CHECK(std::abs(bench.out.throttle_integral_frac.value) < 1e-9);
}

TEST_CASE("pitch that holds the airspeed alone does not ask for the climb that the engine cannot give") {
  Bench<tecs::Outer> bench;
  bench.params.speed_weight.value = 2;
  bench.set(bench.in.state, flying(15));
  bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                              .height_m = 170,
                                              .climb_rate_mps = 0,
                                              .airspeed_mps = 15,
                                              .roll_feedforward_rad = 0});
  for (int i = 0; i < 200; ++i) bench.step(0.01);
  CHECK(bench.out.attitude.pitch_rad > 0.2);        // 4 m/s of climb at 15 m/s
  for (int i = 0; i < 3000; ++i) bench.step(0.01);  // full throttle, and it does not climb
  REQUIRE(bench.out.attitude.throttle_frac > 0.99);
  CHECK(std::abs(bench.out.attitude.pitch_rad) < 1e-6);
}

TEST_CASE("the climb asked for has no step where the linear range of the height error ends") {
  const auto climb = [](double above_m) {
    Bench<tecs::Outer> bench;
    bench.set(bench.in.state, flying(15));
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                                .height_m = 70 + above_m,
                                                .climb_rate_mps = 0,
                                                .airspeed_mps = 15,
                                                .roll_feedforward_rad = 0});
    for (int i = 0; i < 300; ++i) bench.step(0.01);
    return bench.out.climb_rate_demand_mps.value;
  };
  const tecs::Outer::Params p;
  const double edge = 0.5 * p.climb_acceleration_limit / (p.altitude_gain * p.altitude_gain);
  CHECK(climb(0.999 * edge) == doctest::Approx(0.999 * edge * p.altitude_gain).epsilon(1e-6));
  CHECK(climb(1.001 * edge) / climb(0.999 * edge) == doctest::Approx(1).epsilon(0.005));
  CHECK(climb(-1.001 * edge) / climb(1.001 * edge) == doctest::Approx(-1));
}

TEST_CASE(
    "the climb asked for begins at the present one: when it is activated, and when the attitude is back") {
  const GuidanceCommand level{
      .course_rad = 0, .height_m = 70, .climb_rate_mps = 0, .airspeed_mps = 15, .roll_feedforward_rad = 0};
  for (const bool blind : {false, true}) {
    CAPTURE(blind);
    Bench<tecs::Outer> bench;
    VehicleState s = flying(15);
    s.attitude_valid = !blind;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, level);
    for (int i = 0; i < 100; ++i) bench.step(0.01);
    s.climb_rate_mps = 3;
    s.attitude_valid = true;
    bench.set(bench.in.state, s);
    if (!blind) REQUIRE(bench.activate() == Status::ok);
    bench.step(0.01);
    CHECK(bench.out.climb_rate_demand_mps.value == Approx(3 - 4 * 0.01));  // 4 m/s2 from there
  }
}

TEST_CASE("climb and acceleration together are asked for within what the engine can give") {
  Bench<tecs::Outer> bench;
  auto& p = bench.params;
  p.throttle_integral.value = p.pitch_integral.value = p.throttle_damping.value = p.airspeed_kff.value = 0;
  p.common.airframe.value.mass_kg = 4.5;
  bench.set(bench.in.state, flying(15));
  bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                              .height_m = 170,
                                              .climb_rate_mps = 0,
                                              .airspeed_mps = 25,
                                              .roll_feedforward_rad = 0});
  for (int i = 0; i < 500; ++i) bench.step(0.01);
  CHECK(bench.out.attitude.throttle_frac ==
        Approx(0.5 + 4.5 * isa::g0 * 4 / (15 * 50)));  // of 4 m/s of climb
}

TEST_CASE("half way into underspeed half of the throttle is full") {
  Bench<tecs::Outer> bench;
  bench.params.throttle_integral.value = bench.params.pitch_integral.value = 0;
  const auto throttle = [&](double airspeed) {
    bench.set(bench.in.state, flying(airspeed));
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                                .height_m = -930,
                                                .climb_rate_mps = 0,
                                                .airspeed_mps = 10,
                                                .roll_feedforward_rad = 0});
    for (int i = 0; i < 300; ++i) bench.step(0.01);
    return bench.out.attitude.throttle_frac;
  };
  CHECK(throttle(10) < 0.4);  // sinks as fast as it may: little throttle
  CHECK(throttle(9.25) > 0.5);
  CHECK(bench.out.underspeed_ratio.value == Approx(0.5));
}

TEST_CASE("without airspeed pitch holds the height, whatever the weight of the speed") {
  const auto pitch = [](bool airspeed_valid, double weight) {
    Bench<tecs::Outer> bench;
    bench.params.speed_weight.value = weight;
    bench.params.pitch_integral.value = 0;
    VehicleState s = flying(15);
    s.airspeed_valid = airspeed_valid;
    bench.set(bench.in.state, s);
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 0,
                                                .height_m = 71,
                                                .climb_rate_mps = 0,
                                                .airspeed_mps = 15,
                                                .roll_feedforward_rad = 0});
    for (int i = 0; i < 300; ++i) bench.step(0.01);
    return bench.out.attitude.pitch_rad;
  };
  CHECK(pitch(true, 0) > 0.1);
  CHECK(pitch(false, 2) / pitch(true, 0) == Approx(1));
}

TEST_CASE(
    "a lateral acceleration is flown as the bank that has it, to both sides, whatever course and speed") {
  for (const double airspeed : {11.0, 22.0}) {  // cruise is 15 m/s
    for (const double a : {3.0, -5.0}) {
      Bench<tecs::Outer> bench;
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
