// SPDX-License-Identifier: BSD-3-Clause
// The X8 flies hands-off, and a model is changed in flight.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fly.hpp"
#include "fulmar/flight/math/attitude.hpp"

namespace x8_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

constexpr double origin_m = 1387;

std::unique_ptr<Bench<Aircraft>> airborne(const Airframe& a, double height) {
  auto b = std::make_unique<Bench<Aircraft>>(1);
  b->params.airframe.value = a;
  b->params.start.start_height.value = height;
  b->params.sensors.value = SensorSet::perfect;
  b->params.settle.value = 0;
  arm(*b);
  return b;
}

Actuators held(const Airframe& a, double height) {
  const Trim t =
      trimmed_flight(a, a.limits.airspeed_cruise_mps, standard_air(origin_m + height).density_kgm3);
  REQUIRE(t.found);
  return {t.throttle_frac, t.deflections.aileron, t.deflections.elevator, t.deflections.rudder};
}

void fly(Bench<Aircraft>& b, const Actuators& u, double seconds) {
  for (int i = 0; i < std::lround(400 * seconds); ++i) pass(b, &u);
}

}  // namespace

TEST_CASE("the X8 flies hands-off for a minute") {
  const Airframe a = test::airframe_file("x8");
  const auto b = airborne(a, 200);
  const Actuators u = held(a, 200);
  fly(*b, u, 60);
  const Plant& plant = b->component().plant();
  // The Dutch roll below has grown by exp(0.36 * 60), 3e9: the error of the trim, 1e-12, becomes visible.
  CHECK(std::abs(-plant.state().p_n.z() - 200) < 2);
  CHECK(plant.air_velocity_b().norm() == Approx(18).epsilon(0.02));
  CHECK(std::abs(euler_from(plant.state().q_nb).roll_rad) < 0.2);
  CHECK(plant.state().omega_b.norm() < 0.5);
}

TEST_CASE("the X8's Dutch roll grows as its published inertia and derivatives have it") {
  // Eigenvalues of Beard & McLain (5.43) with the published figures at 18 m/s, 1.0453 kg/m3: 0.361 +- 2.99 i;
  // its product of inertia makes it unstable: with the other sign or none it is damped.
  const Airframe a = test::airframe_file("x8");
  const auto b = airborne(a, 200);
  const Actuators u = held(a, 200);
  Actuators push = u;
  push.aileron_rad += 0.001;
  fly(*b, push, 0.2);
  const auto widest = [&](double seconds) {
    double most = 0;
    for (int i = 0; i < std::lround(400 * seconds); ++i) {
      pass(*b, &u);
      most = std::max(most, std::abs(b->component().plant().state().omega_b.z()));
    }
    return most;
  };
  const double period = 2 * std::numbers::pi / 2.99;
  fly(*b, u, 2);  // the other excited modes have decayed
  const double begin = widest(period);
  fly(*b, u, 2 * period);
  CHECK(widest(period) / begin == Approx(std::exp(0.361 * 3 * period)).epsilon(0.1));
}

TEST_CASE("the X8 lies level on its belly, and slides to a halt as friction has it") {
  const Airframe a = test::airframe_file("x8");
  Plant plant(a, Weather{}, 0, 1);
  const Actuators still{0, 0, 0, 0};
  for (int i = 0; i < 4000; ++i) plant.advance(still, 1, 0.0025);
  CHECK(-plant.state().p_n.z() == Approx(0.1).epsilon(0.05));
  CHECK(std::abs(euler_from(plant.state().q_nb).pitch_rad) < 0.01);
  CHECK(plant.state().v_n.norm() < 1e-3);
  RigidBody sliding = plant.state();
  sliding.v_n.x() = 3;
  plant.set_state(sliding);
  for (int i = 0; i < 1200; ++i) plant.advance(still, 1, 0.0025);
  CHECK_FALSE(plant.crashed());
  CHECK(plant.state().v_n.norm() < 0.05);
  // v^2 / 2 mu g
  CHECK(plant.state().p_n.x() == Approx(9 / (2 * 0.5 * 9.80665)).epsilon(0.1));
}

TEST_CASE("an elevon of the X8 stops where it does, which takes from roll and pitch") {
  const Airframe a = test::airframe_file("x8");
  Plant plant(a, Weather{}, 0, 1);
  for (int i = 0; i < 800; ++i) plant.advance({0, 0.4, 0.4, 0}, 1, 0.0025);
  // left: 0.8 rad, and its stop is at 35 deg; right: none
  const double left = 35 * std::numbers::pi / 180;
  CHECK(plant.servos().aileron == Approx(left));
  CHECK(std::abs(plant.servos().elevator) < 1e-6);
  CHECK(plant.deflections().aileron == Approx(left / 2));
  CHECK(plant.deflections().elevator == Approx(left / 2));
}

TEST_CASE("a derivative that is added in flight changes the response as the linear model says, and back") {
  const Airframe a = anaconda();
  const auto b = airborne(a, 200);
  const Actuators u = held(a, 200);
  fly(*b, u, 0.1);
  const double qS = 0.5 * standard_air(origin_m + 200).density_kgm3 * 17 * 17 * a.wing.area_m2;
  const auto pitch_rate = [&] { return b->component().plant().state().omega_b.y(); };
  CHECK(std::abs(pitch_rate()) < 1e-5);
  b->params.model.pitch.add_pitch_zero.value = 0.01;
  b->retune();
  pass(*b, &u);
  pass(*b, &u);
  // two steps are short against every mode: q = M t / Iyy
  const double expected = 0.01 * qS * a.wing.chord_m / a.inertia.yy_kgm2 * 0.0025;
  const double after = pitch_rate();
  CHECK(after > 0.9 * expected);
  CHECK(after < 2.1 * expected);
  b->params.model.pitch.add_pitch_zero.value = 0;
  b->retune();
  fly(*b, u, 0.1);
  CHECK(b->component().plant().aerodynamic().stall(0) >= 0);
  b->params.model.roll.add_roll_aileron.value =
      -2 * a.aero.roll.aileron_ratio;  // ailerons the other way round
  b->retune();
  Actuators right = u;
  right.aileron_rad += 0.1;
  fly(*b, right, 0.3);
  CHECK(b->component().plant().state().omega_b.x() < -0.1);
}

TEST_CASE("what is added from the start flies from the start, and ice comes on top of it") {
  Airframe doubled = anaconda();
  doubled.aero.parasite_drag_ratio *= 2;
  const auto by_file = airborne(doubled, 200), by_parameter = airborne(anaconda(), 200);
  by_parameter->params.model.add_parasite_drag.value = anaconda().aero.parasite_drag_ratio;
  for (const auto* b : {&by_file, &by_parameter}) (*b)->params.faults.body_that_fails.icing_rate.value = 0.2;
  const Actuators u = held(anaconda(), 200);
  // the start is trimmed for the file's drag: both begin without motor difference after a while
  fly(*by_file, u, 20);
  fly(*by_parameter, u, 20);
  CHECK(by_file->component().plant().air_velocity_b().norm() ==
        Approx(by_parameter->component().plant().air_velocity_b().norm()).epsilon(0.02));
  const auto clean = airborne(anaconda(), 200);
  fly(*clean, u, 20);
  CHECK(std::abs(clean->component().plant().state().p_n.z() -
                 by_parameter->component().plant().state().p_n.z()) > 10);
}

TEST_CASE("flaps go where they are told, stay there, and are in when nobody speaks") {
  Airframe a = anaconda();
  a.aero.lift.flap_ratio = 0.5;
  a.aero.drag.flap_ratio = 0.05;
  a.flap.limit_rad = 0.6;
  const auto b = airborne(a, 200);
  const Actuators u = held(a, 200);
  fly(*b, u, 1);
  CHECK(b->component().plant().deflections().flap == 0);
  const double before = b->component().plant().specific_force().z();
  b->set(b->in.flaps, Flaps{0.3});
  fly(*b, u, 0.1);
  CHECK(b->component().plant().deflections().flap == Approx(0.3).epsilon(0.02));
  CHECK(b->component().plant().specific_force().z() < before - 1);  // lift: up is negative
  fly(*b, u, 2);
  CHECK(b->component().plant().deflections().flap == Approx(0.3));
  b->set(b->in.flaps, Flaps{5});
  fly(*b, u, 1);
  CHECK(b->component().plant().deflections().flap == Approx(0.6));
  b->set(b->in.flaps, Flaps{std::numeric_limits<double>::quiet_NaN()});
  fly(*b, u, 1);
  CHECK(std::abs(b->component().plant().deflections().flap) < 1e-6);
}

TEST_CASE("tables that cannot be read are refused by their place") {
  Airframe a = anaconda();
  CoefficientTable t;
  t.at_ratio.push_back(0);
  a.aero.tables.push_back(t);
  const auto b = airborne(a, 200);
  CHECK_THROWS_WITH(pass(*b),
                    doctest::Contains("airframe.aero.tables[0].values: flight.table_values_of_one_point(0)"));
}

}  // namespace x8_test
