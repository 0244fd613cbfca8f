// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/sim/plant.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "sdk/test/flight/airframe_file.hpp"

namespace plant_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025;

const Airframe& anaconda() {
  static const Airframe airframe = test::airframe_file("anaconda");
  return airframe;
}

Plant plant(const Weather& weather = {}, const Airframe& airframe = anaconda()) {
  return Plant(airframe, weather, 1387, 1);
}

void run(Plant& p, double seconds, const Actuators& a = {}) {
  for (int i = 0; i < std::lround(seconds / dt); ++i) p.advance(a, true, dt);
}

}  // namespace

TEST_CASE("an aircraft that stands on the ground stands still") {
  Plant p = plant();
  run(p, 2);
  const Vector3d there = p.state().p_n;
  double fastest = 0;
  for (int i = 0; i < 20; ++i) {
    run(p, 1);
    fastest = std::max(fastest, p.state().v_n.norm());
  }
  CHECK(fastest < 1e-3);
  CHECK((p.state().p_n - there).norm() < 1e-4);
  CHECK(p.on_ground());
  CHECK_FALSE(p.crashed());
  CHECK(-p.state().p_n.z() == Approx(anaconda().gear.height_m).epsilon(0.01).scale(0));
  CHECK((p.specific_force() - Vector3d(0, 0, -9.80665)).norm() < 0.01);
  CHECK(p.state().q_nb.angularDistance(Eigen::Quaterniond::Identity()) < 1e-3);
}

TEST_CASE("wind does not make a standing aircraft creep") {
  Plant p = plant({{-4, 2, 0}, Turbulence::none});
  p.stand(0, 0, 0);
  run(p, 3);
  const Vector3d there = p.state().p_n;
  run(p, 60);
  CHECK((p.state().p_n - there).norm() < 1e-3);
  CHECK(p.state().v_n.norm() < 1e-3);
}

TEST_CASE("a gusty wind from behind neither turns nor tips a standing aircraft") {
  Plant p = plant({{3.5355, -3.5355, 0}, Turbulence::light});
  run(p, 20);
  CHECK(p.state().p_n.head<2>().norm() < 0.05);
  CHECK(p.state().q_nb.angularDistance(Eigen::Quaterniond::Identity()) < 0.05);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("full throttle accelerates by thrust less rolling friction") {
  Plant p = plant();
  run(p, 1);
  run(p, 0.6, {1, 0, 0, 0});  // spins up
  const double v0 = p.state().v_n.x(), rho = p.air().density_kgm3;
  run(p, 0.1, {1, 0, 0, 0});
  const double v1 = p.state().v_n.x(), Va = 0.5 * (v0 + v1);
  const Propeller propeller(anaconda().propulsion);
  const double thrust = propeller.thrust(propeller.steady_speed(1, Va, rho), Va, rho),
               q = 0.5 * rho * Va * Va * 0.52;
  const double drag = q * (0.043 + 0.506 * 0.506 / (std::numbers::pi * 0.9 * 2.08 * 2.08 / 0.52)),
               lift = q * 0.506;
  CHECK((v1 - v0) / 0.1 == Approx((thrust - drag - 0.05 * (4.5 * 9.80665 - lift)) / 4.5).epsilon(0.02));
}

TEST_CASE("it rolls straight under thrust until it lifts off") {
  Plant p = plant();
  run(p, 1);
  double t = 0;
  while (p.on_ground() && t < 20) {
    run(p, 0.05, {0.8, 0, t > 1.5 ? -0.15 : 0, 0});
    t += 0.05;
  }
  CHECK(t > 1);
  CHECK(t < 6);
  CHECK_FALSE(p.crashed());
  CHECK(p.state().v_n.x() > 9);
  CHECK(std::abs(p.state().p_n.y()) < 0.2);
  CHECK(std::abs(p.state().v_n.y()) < 0.3);
}

TEST_CASE("without thrust it rolls out, slowed by friction, and then stands") {
  Plant p = plant();
  run(p, 1);
  run(p, 1, {0.4, 0, 0, 0});
  const double v0 = p.state().v_n.x();
  CHECK(v0 > 1);
  run(p, 60);
  CHECK(p.state().v_n.norm() < 1e-3);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("it slides sideways no further than friction lets it") {
  Plant p = plant();
  run(p, 1);
  RigidBody x = p.state();
  x.v_n = {0, 1, 0};
  p.set_state(x);
  run(p, 3);
  // v^2 / (2 mu g), and a small roll on the springs
  CHECK(p.state().p_n.y() == Approx(1 / (2 * 0.6 * 9.80665)).epsilon(0.2).scale(0));
  CHECK(p.state().v_n.norm() < 1e-3);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("a soft touch-down is survived, a hard one is not, and what has crashed stays") {
  for (double sink : {1.5, 5.0}) {
    Plant p = plant();
    REQUIRE(p.fly({0, 0, -1}, 0, 15));
    RigidBody x = p.state();
    x.p_n.z() = -0.25;
    x.v_n = {3, 0, sink};
    x.q_nb = Eigen::Quaterniond::Identity();
    p.set_state(x);
    run(p, 2);
    CHECK(p.crashed() == (sink > 3));
    if (p.crashed()) {
      const Vector3d there = p.state().p_n;
      run(p, 5, {1, 0.3, -0.3, 0});
      CHECK((p.state().p_n - there).norm() == 0);
      CHECK(p.propeller_radps() == 0);
      CHECK(p.specific_force().norm() == Approx(9.80665));
    }
  }
}

TEST_CASE("a wing in the ground and a landing on the back are crashes") {
  for (double roll : {0.6, 3.0}) {
    Plant p = plant();
    REQUIRE(p.fly({0, 0, -0.7}, 0, 15));
    RigidBody x = p.state();
    x.v_n = {8, 0, 1};
    x.q_nb = Eigen::AngleAxisd(roll, Vector3d::UnitX());
    p.set_state(x);
    run(p, 1);
    CHECK(p.crashed());
  }
}

TEST_CASE("a trimmed aircraft flies on level by itself") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    Plant p = plant({}, a);
    REQUIRE(p.fly({0, 0, -70}, 0.5, a.limits.airspeed_cruise_mps));
    const Actuators trim{a.limits.throttle_cruise_frac, a.aileron.trim_rad, a.elevator.trim_rad,
                         a.rudder.trim_rad};
    run(p, 10, trim);
    CHECK(-p.state().p_n.z() == Approx(70).epsilon(0.01));
    CHECK(p.air_velocity_b().norm() == Approx(a.limits.airspeed_cruise_mps).epsilon(0.005));
    CHECK(std::hypot(p.state().p_n.x(), p.state().p_n.y()) ==
          Approx(10 * a.limits.airspeed_cruise_mps).epsilon(0.01));
  }
}

TEST_CASE("steady wind carries the flight along and changes nothing else") {
  const Vector3d wind(3, -4, 0);
  Plant still = plant(), windy = plant({wind, Turbulence::none});
  REQUIRE(still.fly({0, 0, -100}, 0, 17));
  REQUIRE(windy.fly({0, 0, -100}, 0, 17));
  const Actuators a{0.7, 0.03, 0.1, -0.02};
  run(still, 5, a);
  run(windy, 5, a);
  CHECK((windy.state().p_n - still.state().p_n - 5 * wind).norm() < 1e-9);
  CHECK((windy.state().omega_b - still.state().omega_b).norm() < 1e-10);
  CHECK((windy.wind_n() - wind).norm() == 0);
}

TEST_CASE("turbulence shakes the aircraft, the same way for the same seed") {
  Plant a = plant({{0, 0, 0}, Turbulence::moderate}), b = plant({{0, 0, 0}, Turbulence::moderate});
  REQUIRE(a.fly({0, 0, -300}, 0, 17));
  REQUIRE(b.fly({0, 0, -300}, 0, 17));
  double shaken = 0;
  for (int i = 0; i < 2000; ++i) {
    a.advance({0.57, 0, 0.12, 0}, true, dt);
    b.advance({0.57, 0, 0.12, 0}, true, dt);
    shaken = std::max(shaken, std::abs(a.specific_force().z() + 9.80665));
  }
  CHECK(shaken > 1);
  CHECK(a.state().p_n == b.state().p_n);
}

TEST_CASE("the air is the standard atmosphere at the origin's altitude plus height") {
  Plant p = plant();
  REQUIRE(p.fly({0, 0, -70}, 0, 17));
  CHECK(p.air().density_kgm3 == Approx(1.0633).epsilon(1e-3));  // ISA at 1457 m
}

TEST_CASE("a servo follows as a first-order lag, within its rate and its throw") {
  Servo servo({.limit_rad = 0.6, .rate_limit_radps = 100, .time_constant_s = 0.02});
  for (int i = 0; i < 8; ++i) servo.advance(0.35, dt);
  CHECK(servo.angle() == Approx(0.35 * (1 - std::exp(-1))));
  for (int i = 0; i < 400; ++i) servo.advance(0.35, dt);
  CHECK(servo.angle() == Approx(0.35));  // 0.35 rad commanded is 0.35 rad moved
  for (int i = 0; i < 400; ++i) servo.advance(2, dt);
  CHECK(servo.angle() == Approx(0.6));

  Servo slow({.limit_rad = 1, .rate_limit_radps = 2, .time_constant_s = 0.02});
  double integrated = 0, before = 0, fastest = 0;  // the same by small Euler steps
  for (int i = 0; i < 200; ++i) {
    slow.advance(0.5, dt);
    fastest = std::max(fastest, (slow.angle() - before) / dt);
    before = slow.angle();
    for (int k = 0; k < 1000; ++k) integrated += dt / 1000 * std::clamp((0.5 - integrated) / 0.02, -2.0, 2.0);
    CHECK(slow.angle() == Approx(integrated).epsilon(1e-4));
  }
  CHECK(fastest == Approx(2));
}

TEST_CASE("an unpowered motor has no torque at any throttle") {
  Plant p = plant();
  run(p, 1, {0.5, 0, 0, 0});
  CHECK(p.propeller_radps() > 300);
  for (int i = 0; i < 2000; ++i) p.advance({1, 0, 0, 0}, false, dt);
  CHECK(p.propeller_radps() < 30);
  CHECK(p.battery_amp() == 0);
}

TEST_CASE("the ground holds at a tick of 100 Hz, too") {
  Plant p = plant();
  for (int i = 0; i < 3000; ++i) p.advance({}, true, 0.01);
  CHECK(p.state().v_n.norm() < 1e-3);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("a touch-down breaks what a wheel that is down already bears") {
  const Airframe& a = anaconda();
  RigidBody x;
  x.p_n.z() = -a.gear.height_m;
  x.v_n.z() = 3.5;
  Ground coming(a), standing(a);
  standing.stand();
  for (Ground* g : {&coming, &standing}) g->advance(x, 0.0025);
  CHECK(coming.crashed());
  CHECK_FALSE(standing.crashed());
}

TEST_CASE("a wheel that has left the ground has forgotten what pulled at it") {
  const Airframe& a = anaconda();
  Ground ground(a);
  ground.stand();
  RigidBody x;
  x.p_n.z() = -a.gear.height_m;
  x.v_n = {0, 1, 0};  // sideways
  for (int i = 0; i < 40; ++i) ground.advance(x, 0.0025);
  const auto side = [&] {
    RigidBody still = x;
    still.v_n.setZero();
    Load load;
    ground.add_load(still, load);
    return load.force_b.y();
  };
  CHECK(side() < -1);
  for (const double up : {0.05, 5.0}) {  // a hop, and out of contact
    x.p_n.z() = -a.gear.height_m - up;
    ground.advance(x, 0.0025);
    x.p_n.z() = -a.gear.height_m;
    CHECK(side() == 0);
    for (int i = 0; i < 40; ++i) ground.advance(x, 0.0025);
    CHECK(side() < -1);
  }
}

TEST_CASE("carried before arming the accelerometer feels the weight alone, in gusts, too") {
  Plant p = plant({{3, -2, 0}, Turbulence::moderate});
  REQUIRE(p.fly({0, 0, -200}, 0.7, 17));
  for (int i = 0; i < 400; ++i) {
    p.carry(dt);
    const Vector3d weight = p.state().q_nb.conjugate() * Vector3d(0, 0, -9.80665);
    REQUIRE((p.specific_force() - weight).norm() / weight.norm() < 1e-10);
  }
}

}  // namespace plant_test
