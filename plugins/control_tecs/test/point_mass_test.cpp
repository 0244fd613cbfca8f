// SPDX-License-Identifier: BSD-3-Clause
// The closed-loop cases of PX4's test of its TECS (TECSClosedLoopTest.cpp): a point mass of 16 m/s whose
// energy rate follows the throttle and whose path follows pitch; 5 m/s of climb and of sink, 50 Hz.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>

#include "plugins/control_tecs/error_law.hpp"
#include "plugins/control_tecs/outer.hpp"

namespace point_mass_test {

using namespace fulmar;

namespace {
constexpr double g = 9.80665, dt = 0.02;

/// Throttle 0, 0.5, 1: sinks at 5 m/s, level, climbs at 5 m/s, at constant speed.
template <class Law>
struct PointMassFlight : Bench<Law> {
  double V = 16, h = 100, gamma = 0, V_dot = 0, trim = 0;
  double worst_speed = 0;
  GuidanceCommand command{.course_rad = 0, .height_m = 100, .climb_rate_mps = 0, .airspeed_mps = 16};

  explicit PointMassFlight(double speed_weight) {
    auto& p = this->params;
    Airframe& a = p.common.airframe.value;
    a.mass_kg = 4.5;
    a.limits.climb_rate_max_mps = a.limits.sink_rate_max_mps = 5;
    a.limits.airspeed_cruise_mps = 16;
    a.limits.throttle_cruise_frac = 0.5;
    p.speed_weight.value = speed_weight;
    p.airspeed_kff.value = 0;                 // of this mass: no drag that grows with speed
    p.thrust.value = 4.5 * g * 5 / 16 / 0.5;  // its engine
  }
  void run(double seconds) {
    for (double t = 0; t < seconds - 0.5 * dt; t += dt) {
      VehicleState s;
      s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
      s.airspeed_mps = V;
      s.ground_speed_mps = V * std::cos(gamma);
      s.height_m = h;
      s.climb_rate_mps = V * std::sin(gamma);
      s.pitch_rad = gamma;
      s.specific_force_mps2 = {V_dot + g * std::sin(gamma), 0, -g * std::cos(gamma)};
      this->set(this->in.state, s);
      this->set(this->in.command, command);
      this->step(dt);
      gamma = this->out.attitude.pitch_rad;
      const double energy_rate = g * 10 * (this->out.attitude.throttle_frac - 0.5);  // m2/s3
      V_dot = (energy_rate - g * V * std::sin(gamma)) / V;
      h += dt * V * std::sin(gamma);
      V += dt * V_dot;
      worst_speed = std::max(worst_speed, std::abs(V - command.airspeed_mps));
    }
  }
};
}  // namespace

TEST_CASE("60 s of cruise: no drift") {
  PointMassFlight<tecs::Outer> flight(1);
  flight.run(60);
  CHECK(std::abs(flight.V - 16) < 0.01);
  CHECK(std::abs(flight.h - 100) < 0.5);
  CHECK(flight.worst_speed < 0.1);
}

TEST_CASE("steps of 50 m, up and down: the airspeed is off by less than 0.1 m/s on the way") {
  struct Case {
    double weight, acceleration;
  };
  const tecs::Outer::Params shipped;
  for (const Case& c :
       {Case{0.2, shipped.climb_acceleration_limit}, Case{1.0, shipped.climb_acceleration_limit},
        Case{1.8, shipped.climb_acceleration_limit}, Case{1.0, 0.5}})
    for (const double side : {1.0, -1.0}) {
      CAPTURE(c.weight);
      CAPTURE(c.acceleration);
      CAPTURE(side);
      PointMassFlight<tecs::Outer> flight(c.weight);
      flight.params.climb_acceleration_limit.value = c.acceleration;
      flight.run(5);
      flight.command.height_m += 50 * side;
      double overshoot = 0;
      for (int i = 0; i < 120; ++i) {
        flight.run(0.5);
        overshoot = std::max(overshoot, (flight.h - flight.command.height_m) * side);
      }
      CHECK(overshoot < 0.5);
      CHECK(flight.worst_speed < 0.1);
      CHECK(std::abs(flight.V - 16) < 0.01);
      CHECK(std::abs(flight.h - 100 - 50 * side) < 0.5);
    }
}

TEST_CASE("steps of 2 m/s, up and down") {
  for (const double side : {1.0, -1.0}) {
    PointMassFlight<tecs::Outer> flight(1);
    flight.run(5);
    flight.command.airspeed_mps += 2 * side;
    flight.run(60);
    CHECK(std::abs(flight.V - 16 - 2 * side) < 0.01);
    CHECK(std::abs(flight.h - 100) < 0.5);
  }
}

TEST_CASE("the law of energy errors ends where it should in the same cases") {
  for (const double weight : {0.2, 1.0, 1.8})
    for (const double side : {1.0, -1.0})
      for (const bool speed : {false, true}) {
        CAPTURE(weight);
        CAPTURE(side);
        CAPTURE(speed);
        PointMassFlight<tecs::ErrorLaw> flight(weight);
        flight.run(5);
        (speed ? flight.command.airspeed_mps : flight.command.height_m) += (speed ? 2 : 50) * side;
        flight.run(60);
        CHECK(std::abs(flight.V - flight.command.airspeed_mps) < 0.01);
        CHECK(std::abs(flight.h - flight.command.height_m) < 0.5);
        if (!speed) CHECK(flight.worst_speed < 1);
      }
}

}  // namespace point_mass_test
