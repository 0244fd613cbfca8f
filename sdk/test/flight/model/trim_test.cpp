// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/trim.hpp"

#include <doctest/doctest.h>

#include "sdk/test/flight/airframe_file.hpp"

namespace trim_test {

using namespace fulmar;
using doctest::Approx;

TEST_CASE("the Anaconda's level flight at 15 m/s follows the balance of lift and weight") {
  Airframe a = test::airframe_file("anaconda");
  a.aero.lift.elevator_ratio = 0;  // the hand calculation neglects the lift of the tail
  const Trim trim = trimmed_flight(a, 15, 1.2682);
  REQUIRE(trim.found);
  const double q = 0.5 * 1.2682 * 15 * 15, degree = std::numbers::pi / 180;
  CHECK(4.5 * 9.80665 / (q * 0.52) == Approx(0.595).epsilon(0.002));  // CL
  CHECK(trim.alpha_rad / degree == Approx(0.9).epsilon(0.03));
  CHECK(trim.deflections.elevator / degree == Approx(5.3).epsilon(0.02));
  const Propeller propeller(a.propulsion);
  CHECK(propeller.thrust(trim.propeller_radps, 15, 1.2682) == Approx(4.3).epsilon(0.02));
}

TEST_CASE("a trimmed aircraft does not accelerate, in climb and descent, too") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double Va = a.limits.airspeed_cruise_mps, rho = standard_air(1457).density_kgm3;
    for (double gamma : {-0.05, 0.0, 0.08}) {
      const Trim t = trimmed_flight(a, Va, rho, gamma);
      REQUIRE(t.found);
      const Propeller propeller(a.propulsion);
      const Eigen::Vector3d v(Va * std::cos(t.alpha_rad) * std::cos(t.beta_rad), Va * std::sin(t.beta_rad),
                              Va * std::sin(t.alpha_rad) * std::cos(t.beta_rad));
      const Load l = Aerodynamic(a).load(v, Eigen::Vector3d::Zero(), t.deflections, rho);
      const double w = a.mass_kg * 9.80665;
      CHECK(l.force_b.x() + propeller.thrust(t.propeller_radps, Va, rho) - w * std::sin(t.pitch_rad) ==
            Approx(0).epsilon(1e-6));
      CHECK(l.force_b.z() + w * std::cos(t.pitch_rad) == Approx(0).epsilon(1e-6));
      CHECK(l.moment_b.y() == Approx(0).epsilon(1e-6));
      CHECK(l.moment_b.x() - propeller.torque(t.propeller_radps, Va, rho) == Approx(0).epsilon(1e-6));
      CHECK(propeller.steady_speed(t.throttle_frac, Va, rho) == Approx(t.propeller_radps).epsilon(1e-9));
    }
  }
}

TEST_CASE("the trims in the airframe files are those of level cruise 70 m above the origin") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const Trim t = trimmed_flight(a, a.limits.airspeed_cruise_mps, standard_air(1387 + 70).density_kgm3);
    CHECK(std::abs(a.aileron.trim_rad - t.deflections.aileron) < 2e-4);
    CHECK(std::abs(a.elevator.trim_rad - t.deflections.elevator) < 2e-4);
    CHECK(std::abs(a.rudder.trim_rad - t.deflections.rudder) < 2e-4);
    CHECK(std::abs(a.limits.throttle_cruise_frac - t.throttle_frac) < 1e-3);
  }
}

TEST_CASE("below the stall there is no trim, and the limits of the airframe files leave room above it") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double rho = standard_air(1457).density_kgm3;
    CHECK(trimmed_flight(a, a.limits.airspeed_min_mps, rho).found);
    CHECK(trimmed_flight(a, a.limits.airspeed_max_mps, rho).found);
    CHECK_FALSE(trimmed_flight(a, 0.75 * a.limits.airspeed_min_mps, rho).found);
  }
}

TEST_CASE("an engine that cannot hold the speed has no trim there") {
  Airframe a = test::airframe_file("anaconda");
  const double rho = standard_air(1457).density_kgm3, Va = a.limits.airspeed_cruise_mps;
  const Trim with = trimmed_flight(a, Va, rho);
  REQUIRE(with.found);
  a.propulsion.battery_volt *= 0.9 * with.throttle_frac;
  CHECK_FALSE(trimmed_flight(a, Va, rho).found);
  a.propulsion.battery_volt *= 1.2 / 0.9;
  CHECK(trimmed_flight(a, Va, rho).found);
}

TEST_CASE("in stronger gravity an aircraft is trimmed like a heavier one") {
  Airframe a = test::airframe_file("anaconda");
  const double rho = standard_air(1457).density_kgm3, Va = a.limits.airspeed_cruise_mps;
  for (const double ratio : {0.98, 1.03}) {
    const Trim strong = trimmed_flight(a, Va, rho, 0.05, ratio * 9.80665);
    Airframe heavy = a;
    heavy.mass_kg *= ratio;
    const Trim same = trimmed_flight(heavy, Va, rho, 0.05);
    REQUIRE(strong.found);
    CHECK(strong.alpha_rad == doctest::Approx(same.alpha_rad).epsilon(1e-9));
    CHECK(strong.throttle_frac == doctest::Approx(same.throttle_frac).epsilon(1e-9));
    CHECK((strong.alpha_rad > trimmed_flight(a, Va, rho, 0.05).alpha_rad) == (ratio > 1));
  }
}

}  // namespace trim_test
