// SPDX-License-Identifier: BSD-3-Clause
// A battery under load: the balance of motor, propeller and battery by their own equations, and the charge.
#include "fulmar/sim/battery.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "fulmar/sim/plant.hpp"
#include "sdk/test/sim/anaconda.hpp"

namespace battery_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

constexpr double dt = 0.0025, Va = 17;

Airframe with(double resistance_ohm, double capacity_ah = 0, double empty_volt = 0) {
  Airframe a = anaconda();
  a.propulsion.pack.resistance_ohm = resistance_ohm;
  a.propulsion.pack.capacity_ah = capacity_ah;
  a.propulsion.pack.empty_volt = empty_volt;
  return a;
}

/// Steps the plant in its flight for this time.
void blow(Plant& plant, double throttle, double seconds, double rudder = 0) {
  const RigidBody held = plant.state();
  for (int i = 0; i < std::lround(seconds / dt); ++i) {
    plant.advance({throttle, 0, 0, rudder}, 1, dt);
    plant.set_state(held);
  }
}

Plant flying(const Airframe& a) {
  Plant plant(a, {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, Va));
  return plant;
}

}  // namespace

TEST_CASE("under load motor, propeller and battery are in balance: Ohm's law in each, and the torques") {
  for (const int motors : {1, 2})
    for (const double throttle : {0.5, 0.8, 1.0}) {
      CAPTURE(motors);
      CAPTURE(throttle);
      Airframe a = with(0.08);
      for (int i = 0; i < motors; ++i) {
        PropellerPlace p;
        p.at_m.y = motors == 1 ? 0 : i - 0.5;
        a.propulsion.propellers.push_back(p);
      }
      const Propulsion& p = a.propulsion;
      Plant plant = flying(a);
      blow(plant, throttle, 2);
      const double amp = plant.battery_amp(), volt = plant.battery_volt(), Omega = plant.propeller_radps();
      REQUIRE(amp > 0.5);
      CHECK((p.battery_volt - volt) / (0.08 * amp) == Approx(1).epsilon(1e-9));
      const double i = amp / (motors * throttle);  // in one motor: the controller splits the voltage
      CHECK(throttle * volt / (i * p.resistance_ohm + p.torque_constant_ratio * Omega) ==
            Approx(1).epsilon(1e-6));
      const double torque = Propeller(p).torque(Omega, Va, plant.air().density_kgm3);
      CHECK(p.torque_constant_ratio * (i - p.no_load_amp) / torque == Approx(1).epsilon(1e-5));
      Plant stiff = flying(anaconda());
      blow(stiff, throttle, 2);
      CHECK(Omega < stiff.propeller_radps());
    }
}

TEST_CASE(
    "the throttle that holds a speed gives that speed, sagging or not; beyond the battery there is none") {
  for (const double ohm : {0.0, 0.02, 0.1}) {
    const Propeller p(with(ohm).propulsion);
    for (const double Omega : {200.0, 400.0, 600.0}) {
      const double throttle = p.throttle_for(Omega, Va, 1.1);
      CHECK(p.steady_speed(throttle, Va, 1.1) / Omega == Approx(1).epsilon(1e-9));
    }
  }
  CHECK(Propeller(with(2).propulsion).throttle_for(900, Va, 1.1) > 1);
}

TEST_CASE("a trim counts the sag: more throttle, the same speed of the propeller, and level flight with it") {
  const double rho = standard_air(1687).density_kgm3;
  const Trim stiff = trimmed_flight(anaconda(), Va, rho), soft = trimmed_flight(with(0.1), Va, rho);
  REQUIRE(soft.found);
  CHECK(soft.propeller_radps / stiff.propeller_radps == Approx(1).epsilon(1e-9));
  CHECK(soft.throttle_frac > 1.01 * stiff.throttle_frac);
  Plant plant = flying(with(0.1));
  for (int i = 0; i < 2000; ++i)
    plant.advance(
        {soft.throttle_frac, soft.deflections.aileron, soft.deflections.elevator, soft.deflections.rudder}, 1,
        dt);
  CHECK(-plant.state().p_n.z() == Approx(300).epsilon(0.002));
}

TEST_CASE("the charge used is the integral of the current, and the voltage falls with it by a line") {
  const double full = anaconda().propulsion.battery_volt, empty = 0.8 * full;
  Plant plant = flying(with(0.02, 0.2, empty));
  const RigidBody held = plant.state();
  double charge_as = 0;
  for (int i = 0; i < 4000; ++i) {
    plant.advance({i < 2000 ? 0.9 : 0.5, 0, 0, 0}, 1, dt);
    charge_as += dt * plant.battery_amp();
    plant.set_state(held);
  }
  CHECK(plant.battery_used_ah() / (charge_as / 3600) == Approx(1).epsilon(0.002));
  const double part = plant.battery_used_ah() / 0.2;
  CHECK(part > 0.1);
  CHECK(part < 0.9);
  const double open = plant.battery_volt() + 0.02 * plant.battery_amp();
  CHECK((full - open) / (part * (full - empty)) == Approx(1).epsilon(1e-6));
}

TEST_CASE("an empty battery stops the motor for good; one without capacity never ends") {
  Plant small = flying(with(0, 0.01)), endless = flying(with(0));
  blow(small, 0.8, 1);
  CHECK(small.battery_amp() > 1);
  CHECK(small.battery_volt() == anaconda().propulsion.battery_volt);  // no voltage of the empty battery given
  blow(small, 0.8, 10);
  CHECK(small.battery_amp() == 0);
  CHECK(small.propeller_radps() < 60);
  CHECK(small.battery_used_ah() / 0.01 == Approx(1).epsilon(0.02));
  blow(small, 1, 2);
  CHECK(small.battery_amp() == 0);
  blow(endless, 0.8, 11);
  CHECK(endless.battery_amp() > 1);
  CHECK(endless.battery_used_ah() == 0);
}

TEST_CASE("a curve is followed between its points and held beyond them") {
  Propulsion p = with(0, 2).propulsion;
  for (const auto& [used, volt] : {std::pair(0.0, 12.0), {0.1, 11.5}, {0.8, 11.0}, {0.95, 9.0}}) {
    p.pack.curve.used_frac.push_back(used);
    p.pack.curve.open_volt.push_back(volt);
  }
  BatteryState b(p);
  const auto after = [&](double part) {  // used part of the capacity, 2 Ah
    b.drain(3600 * (2 * part - b.used_ah()), 1);
    return b.open_volt();
  };
  CHECK(b.open_volt() == 12);
  CHECK(after(0.05) == Approx(11.75));
  CHECK(after(0.1) == Approx(11.5));
  CHECK(after(0.45) == Approx(11.25));
  CHECK(after(0.875) == Approx(10));
  CHECK(after(0.97) == 9);
  CHECK_FALSE(b.empty());
  after(1.001);
  CHECK(b.empty());
}

TEST_CASE("differential thrust draws from both sides, and an unpowered motor from none") {
  Airframe a = with(0.02, 5);
  for (const double y : {-0.5, 0.5}) {
    PropellerPlace p;
    p.at_m.y = y;
    p.differential_frac = 0.3;
    a.propulsion.propellers.push_back(p);
  }
  Plant plant = flying(a);
  blow(plant, 0.8, 2, 0.5 * a.rudder.limit_rad);
  const Propeller one(a.propulsion);
  const double left = 0.8 - 0.15, right = 0.8 + 0.15;
  CHECK(plant.propeller_radps(1) > plant.propeller_radps(0));
  CHECK(plant.battery_amp() / (left * one.current(left, plant.propeller_radps(0)) +
                               right * one.current(right, plant.propeller_radps(1))) ==
        Approx(1).epsilon(1e-9));
  CHECK(plant.battery_used_ah() > 0);
}

}  // namespace battery_test
