// SPDX-License-Identifier: BSD-3-Clause
// Steady straight flight: the angles, deflections and propeller speed at which nothing accelerates. Newton's
// method on the six equations of motion, wings level. Source of the idea: Beard & McLain, chapter 5.3.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fulmar/flight/aerodynamics.hpp"
#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/mixer.hpp"
#include "fulmar/flight/propellers.hpp"
#include "fulmar/flight/propulsion.hpp"

namespace fulmar {

struct Trim {
  double alpha_rad = 0, beta_rad = 0, pitch_rad = 0;
  Deflections deflections;
  double propeller_radps = 0, throttle_frac = 0;
  bool found = false;  ///< false: no such flight, or deflections and throttle outside what the aircraft has
};

/// `gamma_rad` is the climb angle.
inline Trim trimmed_flight(const Airframe& airframe, double Va, double rho, double gamma_rad = 0,
                           double gravity_mps2 = isa::g0) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Aerodynamic aero(airframe);
  const Propeller propeller(airframe.propulsion);
  const Propellers propellers(airframe);
  const double weight = airframe.mass_kg * gravity_mps2, q = 0.5 * rho * Va * Va;
  const auto velocity = [&](const Vector6& x) {
    return Eigen::Vector3d(Va * std::cos(x(0)) * std::cos(x(1)), Va * std::sin(x(1)),
                           Va * std::sin(x(0)) * std::cos(x(1)));
  };
  const auto residual =
      [&](const Vector6& x) {  // alpha, beta, aileron, elevator, rudder, propeller speed / 1000
        const Load load = aero.load(velocity(x), Eigen::Vector3d::Zero(), {x(2), x(3), x(4)}, rho);
        const double theta = x(0) + gamma_rad;
        const Load push = propellers.steady_load<double>(propeller, 1000 * x(5), x(4), Va, rho);
        Vector6 r;
        r << load.force_b, load.moment_b;
        r(0) += push.force_b.x() - weight * std::sin(theta);
        r(1) += push.force_b.y();
        r(2) += push.force_b.z() + weight * std::cos(theta);
        r.tail<3>() += push.moment_b;
        return Vector6(r / (q * airframe.wing.area_m2));
      };
  Vector6 x;
  x << 0.05, 0, 0, 0, 0, propeller.steady_speed(0.6, Va, rho) / 1000;
  Vector6 r = residual(x);
  for (int i = 0; i < 50 && r.norm() > 1e-12; ++i) {
    Eigen::Matrix<double, 6, 6> J;
    for (int k = 0; k < 6; ++k) {
      Vector6 up = x, down = x;
      up(k) += 1e-6;
      down(k) -= 1e-6;
      J.col(k) = (residual(up) - residual(down)) / 2e-6;
    }
    const Vector6 step = J.fullPivLu().solve(r);
    x -= step * std::min(1.0, 0.2 / step.norm());
    r = residual(x);
  }
  Trim trim;
  trim.alpha_rad = x(0);
  trim.beta_rad = x(1);
  trim.pitch_rad = x(0) + gamma_rad;
  trim.deflections = {x(2), x(3), x(4)};
  trim.propeller_radps = 1000 * x(5);
  trim.throttle_frac = propeller.throttle_for(trim.propeller_radps, Va, rho);
  trim.found = r.norm() < 1e-9 && beyond_stops(airframe, trim.deflections) == Beyond::none && x(5) >= 0 &&
               trim.throttle_frac >= 0 && trim.throttle_frac <= 1;
  return trim;
}

}  // namespace fulmar
