// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/propulsion.hpp"

#include <doctest/doctest.h>

#include "sdk/test/flight/airframe_file.hpp"

namespace propulsion_test {

using namespace fulmar;
using doctest::Approx;

TEST_CASE("the Anaconda's motor gives the thrust that its figures imply") {
  const Propeller propeller(test::airframe_file("anaconda").propulsion);
  const double rho = 1.2682;
  const double Omega = propeller.steady_speed(1, 0, rho);
  CHECK(Omega * 60 / (2 * std::numbers::pi) == Approx(10670).epsilon(0.001));
  CHECK(propeller.thrust(Omega, 0, rho) == Approx(53.2).epsilon(0.001));
  CHECK(propeller.thrust(propeller.steady_speed(1, 15, rho), 15, rho) == Approx(44.2).epsilon(0.001));
}

TEST_CASE("at its steady speed the motor's torque is the propeller's") {
  const Propulsion p = test::airframe_file("aerosonde").propulsion;
  const Propeller propeller(p);
  for (double throttle : {0.3, 0.7, 1.0})
    for (double Va : {0.0, 10.0, 25.0}) {
      const double Omega = propeller.steady_speed(throttle, Va, 1.1);
      const double motor = p.torque_constant_ratio * (propeller.current(throttle, Omega) - p.no_load_amp);
      CHECK(motor == Approx(propeller.torque(Omega, Va, 1.1)).epsilon(1e-9));
      CHECK(propeller.throttle_for(Omega, Va, 1.1) == Approx(throttle));
    }
}

TEST_CASE("thrust and torque are the polynomials of the advance ratio") {
  const Propulsion p = test::airframe_file("anaconda").propulsion;
  const Propeller propeller(p);
  const double rho = 1.1, Va = 17, Omega = 780, D = p.propeller_diameter_m,
               n = Omega / (2 * std::numbers::pi), J = Va / (n * D);
  CHECK(propeller.thrust(Omega, Va, rho) ==
        Approx(rho * n * n * std::pow(D, 4) * (p.ct0_ratio + p.ct1_ratio * J + p.ct2_ratio * J * J)));
  CHECK(propeller.torque(Omega, Va, rho) ==
        Approx(rho * n * n * std::pow(D, 5) * (p.cq0_ratio + p.cq1_ratio * J + p.cq2_ratio * J * J)));
}

TEST_CASE("the propeller's speed stays finite and never negative, for any airspeed") {
  Propulsion p = test::airframe_file("anaconda").propulsion;
  p.cq2_ratio = 0.5;  // gives a negative discriminant
  const Propeller propeller(p);
  for (double Va : {0.0, 20.0, 60.0, 200.0})
    for (double throttle : {0.0, 0.01, 1.0}) {
      const double Omega = propeller.steady_speed(throttle, Va, 1.2);
      CHECK(std::isfinite(Omega));
      CHECK(Omega >= 0);
    }
}

}  // namespace propulsion_test
