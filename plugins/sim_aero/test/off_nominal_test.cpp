// SPDX-License-Identifier: BSD-3-Clause
// A plant in a second run, with an empty battery, and the damping of its gear: closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "fly.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

TEST_CASE("the propeller turns by the voltage that is left") {
  Airframe a = anaconda();
  const double full = a.propulsion.battery_volt;
  a.propulsion.pack.resistance_ohm = 0;
  a.propulsion.pack.capacity_ah = 0.05;
  a.propulsion.pack.empty_volt = 0.6 * full;
  Plant plant(a, {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, 17));
  const RigidBody held = plant.state();
  double first = 0;
  for (const double used : {0.2, 0.5, 0.9}) {
    CAPTURE(used);
    while (plant.battery_used_ah() < used * 0.05) {
      plant.advance({0.9, 0, 0, 0}, 1, 0.0025);
      plant.set_state(held);
    }
    Propulsion left = a.propulsion;
    left.pack = {};
    left.battery_volt = full - used * 0.4 * full;
    const double wanted = Propeller(left).steady_speed(0.9, 17, plant.air().density_kgm3);
    CHECK(plant.propeller_radps() / wanted == Approx(1).epsilon(0.01));
    if (first == 0) first = plant.propeller_radps();
  }
  CHECK(plant.propeller_radps() < 0.85 * first);
}

TEST_CASE("what has left the model in the air flies again when it is put back, and can leave it again") {
  Plant plant(anaconda(), {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, 17));
  const RigidBody before = plant.state();
  for (int i = 0; i < 2; ++i) {
    RigidBody torn = before;
    torn.omega_b = {1e4, 0, 0};
    plant.set_state(torn);
    plant.advance({}, 1, 0.0025);
    CHECK(plant.departure() != Departure::none);
    CHECK_FALSE(plant.crashed());
    plant.set_state(before);
    CHECK(plant.departure() == Departure::none);
    plant.advance({}, 1, 0.0025);
    CHECK(plant.departure() == Departure::none);
  }
}

TEST_CASE("a bounce on the gear decays as a mass on springs that sag by 1 cm, damped by 0.7 of critical") {
  Plant plant(anaconda(), {}, 1387, 1);
  for (int i = 0; i < 2000; ++i) plant.advance({}, 1, 0.001);
  RigidBody x = plant.state();
  const double rest = x.p_n.z(), omega = std::sqrt(9.80665 / 0.01), zeta = 0.7;
  x.p_n.z() -= 0.004;  // up, and its wheels still touch
  plant.set_state(x);
  const double omega_d = omega * std::sqrt(1 - zeta * zeta);
  for (int i = 1; i <= 150; ++i) {
    plant.advance({}, 1, 0.001);
    const double t = 0.001 * i;
    const double part = std::exp(-zeta * omega * t) *
                        (std::cos(omega_d * t) + zeta * omega / omega_d * std::sin(omega_d * t));
    CAPTURE(t);
    CHECK(std::abs((rest - plant.state().p_n.z()) / 0.004 - part) < 0.02);
  }
}

}  // namespace off_nominal_test
