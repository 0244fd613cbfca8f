// SPDX-License-Identifier: BSD-3-Clause
// The plant on every heading, its time constants and couplings, and independent errors of sensors.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "fly.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/math/attitude.hpp"

namespace symmetry_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {
constexpr double dt = 0.0025;

struct Rolled {
  double yaw_rad = 0;  ///< from the heading at the beginning
  Vector3d moved;      ///< forward, right, down of it
};

/// It rolls along the runway and is turned.
Rolled roll_along(double heading) {
  Plant plant(anaconda(), {}, 1387, 1);
  plant.stand(0, 0, heading);
  for (int i = 0; i < 400; ++i) plant.advance({}, true, dt);
  RigidBody x = plant.state();
  const Vector3d from = x.p_n;
  x.v_n += x.q_nb * Vector3d(4, 0, 0);
  x.omega_b = {0, 0, 0.8};
  plant.set_state(x);
  for (int i = 0; i < 400; ++i) plant.advance({}, true, dt);
  return {wrap_pi(euler_from(plant.state().q_nb).yaw_rad - heading),
          Eigen::AngleAxisd(-heading, Vector3d::UnitZ()) * (plant.state().p_n - from)};
}
}  // namespace

TEST_CASE("the motor reaches 63 % of its speed after its time constant") {
  const Airframe& a = anaconda();
  Plant plant(a, {}, 1387, 1);
  for (int i = 0; i < 100; ++i) plant.advance({1, 0, 0, 0}, true, a.propulsion.time_constant_s / 100);
  const double steady =
      Propeller(a.propulsion).steady_speed(1, plant.air_velocity_b().norm(), plant.air().density_kgm3);
  CHECK(plant.propeller_radps() / steady == Approx(1 - std::exp(-1)).epsilon(0.03));
}

TEST_CASE("a roll that the servos make does not depend on the step: each stage sees them at its time") {
  const auto roll_rate = [](double step_s) {
    Plant plant(anaconda(), {}, 1387, 1);
    REQUIRE(plant.fly({0, 0, -300}, 0, 17));
    Actuators sweep{0.5, 0.3, plant.deflections().elevator, plant.deflections().rudder};
    for (int i = 0; i < std::lround(0.2 / step_s); ++i) {
      if (i == std::lround(0.1 / step_s)) sweep.aileron_rad = -0.3;
      plant.advance(sweep, true, step_s);
    }
    return plant.state().omega_b.x();
  };
  CHECK(roll_rate(0.01) / roll_rate(0.0005) == Approx(1).epsilon(1e-3));
}

TEST_CASE("a roll pitches the nose by the product of inertia") {
  Airframe a = anaconda();
  a.aero = {};
  Plant plant(a, {}, 1387, 1);
  RigidBody x;
  x.p_n = {0, 0, -500};
  x.omega_b = {2, 0, 0};
  plant.set_state(x);
  plant.advance({}, false, dt);
  const double expected = -2 * 2 * a.inertia.xz_kgm2 / a.inertia.yy_kgm2 * dt;  // Jy q' = -Jxz p p
  CHECK(plant.state().omega_b.y() / expected == Approx(1).epsilon(0.02));
}

TEST_CASE("the barometer and the pitot tube have errors of their own") {
  Plant plant(anaconda(), {}, 1387, 1);
  double baro_2 = 0, pitot_2 = 0, both = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Sensors s(sensor_spec(SensorSet::rosflight), 400, LocalFrame(40, -111, 1387), Vector3d(2e-5, 0, 4e-5),
              seed);
    double baro = 0, pitot = 0;
    for (int i = 0; i < 20; ++i) {
      baro += s.baro(plant).pressure_pa - plant.air().pressure_pa;
      pitot += s.pitot(plant).pressure_pa;
    }
    baro_2 += baro * baro;
    pitot_2 += pitot * pitot;
    both += baro * pitot;
  }
  CHECK(std::abs(both / std::sqrt(baro_2 * pitot_2)) < 0.25);
}

TEST_CASE("the pilot's rudder to the right turns the nose right") {
  auto bench = std::make_unique<Bench<Aircraft>>(1);
  bench->params.airframe.value = anaconda();
  arm(*bench);
  const Actuators idle{0.5, 0, 0, 0};
  while (bench->tick.now_ns < 100000000) pass(*bench, &idle);
  bench->params.sticks.pilot_flies.value = true;
  bench->params.sticks.stick_yaw.value = 0.5;
  bench->retune();
  for (int i = 0; i < 160; ++i) pass(*bench, &idle);
  const double full = anaconda().rudder.limit_rad;  // positive rudder is nose left
  CHECK(bench->component().plant().deflections().rudder / (-0.5 * full) == Approx(1).epsilon(1e-3));
}

TEST_CASE("the ground acts alike on every heading") {
  const Rolled north = roll_along(0);
  for (const double heading : {0.5, 1.0, -0.5}) {
    const Rolled other = roll_along(heading * std::numbers::pi);
    CHECK(other.yaw_rad == Approx(north.yaw_rad).epsilon(1e-3));
    CHECK((other.moved - north.moved).norm() < 1e-3);
  }
}

TEST_CASE("a pilot who flies needs no commands: that they stop is no failsafe") {
  auto bench = std::make_unique<Bench<Aircraft>>(1);
  bench->params.airframe.value = anaconda();
  arm(*bench);
  const Actuators idle{0.2, 0, 0, 0};
  while (bench->tick.now_ns < 100000000) pass(*bench, &idle);
  bench->params.sticks.pilot_flies.value = true;
  bench->retune();
  for (int i = 0; i < 200; ++i) {
    pass(*bench);
    if (bench->out.status.written) CHECK_FALSE(bench->out.status.value.failsafe);
  }
}

TEST_CASE("the course of an aircraft that stands is where its nose points") {
  auto bench = std::make_unique<Bench<Aircraft>>(1);
  bench->params.airframe.value = anaconda();
  bench->params.start.start_heading.value = 1.2;
  int reported = 0;
  for (int i = 0; i < 100; ++i) {
    pass(*bench);
    if (!bench->out.truth.written) continue;
    CHECK(bench->out.truth.value.course_rad == Approx(1.2).epsilon(0.01));
    ++reported;
  }
  CHECK(reported > 5);
}

TEST_CASE("the battery gives the motor's current in the share of the time that the throttle is on") {
  const Airframe& a = anaconda();
  Plant plant(a, {}, 1387, 1);
  for (int i = 0; i < 200; ++i) plant.advance({0.6, 0, 0, 0}, true, dt);
  const double current =
      (0.6 * a.propulsion.battery_volt - a.propulsion.torque_constant_ratio * plant.propeller_radps()) /
      a.propulsion.resistance_ohm;
  REQUIRE(current > 1);
  CHECK(plant.battery_amp() / (0.6 * current) == Approx(1));
}

}  // namespace symmetry_test
