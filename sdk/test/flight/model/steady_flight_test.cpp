// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/steady_flight.hpp"

#include <doctest/doctest.h>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/sim/plant.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace steady_flight_test {

using namespace fulmar;
using doctest::Approx;

namespace {

constexpr double dt = 0.0025, origin_m = 1387, height_m = 200;

RigidBody body_of(const SteadyFlight& f) {
  RigidBody x;
  x.p_n = {0, 0, -height_m};
  x.q_nb = quaternion_from({f.x(model::roll), f.x(model::pitch), 0});
  x.v_n = x.q_nb * Eigen::Vector3d(f.x.segment<3>(model::u));
  x.omega_b = f.x.segment<3>(model::p);
  return x;
}

Actuators command_of(const SteadyFlight& f) {
  return {f.input(model::throttle), f.input(model::aileron), f.input(model::elevator),
          f.input(model::rudder)};
}

/// A plant in that flight. The body is fixed until servos and motor reach their commands.
sim::Plant plant_in(const Airframe& a, const SteadyFlight& f) {
  sim::Plant plant(a, {}, origin_m, 1);
  REQUIRE(plant.fly({0, 0, -height_m}, 0, a.limits.airspeed_cruise_mps));
  for (int i = 0; i < 2000; ++i) {
    plant.set_state(body_of(f));
    plant.advance(command_of(f), true, dt);
  }
  plant.set_state(body_of(f));
  return plant;
}

}  // namespace

TEST_CASE("the simulated aircraft stays in a steady flight that was computed for it") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double Va = a.limits.airspeed_cruise_mps;
    for (const SteadyCondition& c :
         {SteadyCondition{Va}, SteadyCondition{a.limits.airspeed_min_mps},
          SteadyCondition{a.limits.airspeed_max_mps}, SteadyCondition{Va, 0, Turn::bank, 0.6},
          SteadyCondition{Va, 0, Turn::radius, -100}}) {
      const SteadyFlight f = steady_flight(AircraftModel(a, origin_m + height_m), c);
      REQUIRE(f.found());
      sim::Plant plant = plant_in(a, f);
      for (int i = 0; i < 4000; ++i) plant.advance(command_of(f), true, dt);
      const Euler attitude = euler_from(plant.state().q_nb);
      CHECK((plant.state().omega_b - Eigen::Vector3d(f.x.segment<3>(model::p))).norm() < 1e-6);
      CHECK((plant.air_velocity_b() - Eigen::Vector3d(f.x.segment<3>(model::u))).norm() < 1e-5);
      CHECK(std::abs(attitude.roll_rad - f.x(model::roll)) < 1e-6);
      CHECK(std::abs(attitude.pitch_rad - f.x(model::pitch)) < 1e-6);
      CHECK(std::abs(std::remainder(attitude.yaw_rad - 10 * f.turn_radps, 2 * std::numbers::pi)) < 1e-5);
      CHECK(std::abs(plant.state().p_n.z() + height_m) < 1e-4);
    }
  }
}

TEST_CASE("in a steady climb it climbs as was computed, for as long as the air is the same") {
  const Airframe a = test::airframe_file("anaconda");
  const SteadyFlight f = steady_flight(AircraftModel(a, origin_m + height_m), {17, 0.1, Turn::bank, 0.4});
  REQUIRE(f.found());
  sim::Plant plant = plant_in(a, f);
  for (int i = 0; i < 400; ++i) plant.advance(command_of(f), true, dt);
  CHECK(-plant.state().p_n.z() - height_m == Approx(17 * std::sin(0.1)).epsilon(3e-4).scale(0));
  CHECK(plant.air_velocity_b().norm() == Approx(17).epsilon(1e-4));
}

}  // namespace steady_flight_test
