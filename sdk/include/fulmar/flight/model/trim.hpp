// SPDX-License-Identifier: BSD-3-Clause
// Steady straight flight: angles, deflections and propeller speed without acceleration. Newton's method on
// the six equations of motion, wings level. Source of the method: Beard & McLain, section 5.3.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <concepts>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/flight/model/propellers.hpp"
#include "fulmar/flight/model/propulsion.hpp"

namespace fulmar {

/// Result of `trimmed_flight`.
struct Trim {
  double alpha_rad = 0, beta_rad = 0, pitch_rad = 0;
  double roll_rad = 0;  ///< 0 if a rudder holds the heading
  Deflections deflections;
  double propeller_radps = 0, throttle_frac = 0;
  bool found = false;  ///< false: no such flight, or deflections or throttle beyond their limits
};

/// True if the rudder has an effect. Without one, sideslip and bank are unknowns.
inline bool rudder_acts(const Airframe& a) {
  return std::abs(a.aero.yaw.rudder_ratio) > 1e-9 || std::abs(a.aero.side.rudder_ratio) > 1e-9 ||
         Propellers(a).differential();
}

namespace detail {

/// Six equations of straight flight. Unknowns: alpha, beta, aileron, elevator, rudder or bank, propeller
/// speed / 1000.
class StraightFlight {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  StraightFlight(const Airframe& a, double Va, double rho, double gamma_rad, double gravity_mps2)
      : aero_(a),
        propeller_(a.propulsion),
        propellers_(a),
        Va_(Va),
        rho_(rho),
        gamma_(gamma_rad),
        weight_(a.mass_kg * gravity_mps2),
        qS_(0.5 * rho * Va * Va * a.wing.area_m2),
        rudder_(rudder_acts(a)) {}

  Deflections deflections(const Vector6& x) const { return {x(2), x(3), rudder_ ? x(4) : 0}; }
  double bank(const Vector6& x) const { return rudder_ ? 0 : x(4); }
  /// Pitch angle, rad: with wings level alpha + gamma; banked: Stevens, Lewis & Johnson, Aircraft Control and
  /// Simulation, 3.6, the rate-of-climb constraint.
  double pitch(const Vector6& x) const {
    if (rudder_) return x(0) + gamma_;
    const double a = std::cos(x(0)) * std::cos(x(1)), s = std::sin(gamma_);
    const double b = std::sin(x(4)) * std::sin(x(1)) + std::cos(x(4)) * std::sin(x(0)) * std::cos(x(1));
    return std::atan2(a * b + s * std::sqrt(std::max(0.0, a * a - s * s + b * b)), a * a - s * s);
  }

  Vector6 residual(const Vector6& x) const {
    const Eigen::Vector3d v(Va_ * std::cos(x(0)) * std::cos(x(1)), Va_ * std::sin(x(1)),
                            Va_ * std::sin(x(0)) * std::cos(x(1)));
    const Deflections d = deflections(x);
    Load load = aero_.load(v, Eigen::Vector3d::Zero(), d, rho_);
    const double Omega = 1000 * x(5), theta = pitch(x), phi = bank(x);
    if (aero_.washed()) aero_.add_wash<double>(v, d, propeller_.thrust(Omega, Va_, rho_), rho_, load);
    const Load push = propellers_.steady_load<double>(propeller_, Omega, d.rudder, Va_, rho_);
    Vector6 r;
    r << load.force_b, load.moment_b;
    r(0) += push.force_b.x() - weight_ * std::sin(theta);
    r(1) += push.force_b.y() + weight_ * std::sin(phi) * std::cos(theta);
    r(2) += push.force_b.z() + weight_ * std::cos(phi) * std::cos(theta);
    r.tail<3>() += push.moment_b;
    return Vector6(r / qS_);
  }

  const Propeller& propeller() const { return propeller_; }

 private:
  Aerodynamic aero_;
  Propeller propeller_;
  Propellers propellers_;
  double Va_, rho_, gamma_, weight_, qS_;
  bool rudder_;
};

}  // namespace detail

/// `gamma_rad` is the climb angle.
template <std::same_as<Airframe> Aircraft>
Trim trimmed_flight(const Aircraft& airframe, double Va, double rho, double gamma_rad = 0,
                    double gravity_mps2 = isa::g0) {
  using Vector6 = detail::StraightFlight::Vector6;
  const detail::StraightFlight flight(airframe, Va, rho, gamma_rad, gravity_mps2);
  Vector6 x;
  x << 0.05, 0, 0, 0, 0, flight.propeller().steady_speed(0.6, Va, rho) / 1000;
  Vector6 r = flight.residual(x);
  for (int i = 0; i < 50 && r.norm() > 1e-12; ++i) {
    Eigen::Matrix<double, 6, 6> J;
    for (int k = 0; k < 6; ++k) {
      Vector6 up = x, down = x;
      up(k) += 1e-6;
      down(k) -= 1e-6;
      J.col(k) = (flight.residual(up) - flight.residual(down)) / 2e-6;
    }
    const Vector6 step = J.fullPivLu().solve(r);
    x -= step * std::min(1.0, 0.2 / step.norm());
    r = flight.residual(x);
  }
  Trim trim;
  trim.alpha_rad = x(0);
  trim.beta_rad = x(1);
  trim.pitch_rad = flight.pitch(x);
  trim.roll_rad = flight.bank(x);
  trim.deflections = flight.deflections(x);
  trim.propeller_radps = 1000 * x(5);
  trim.throttle_frac = flight.propeller().throttle_for(trim.propeller_radps, Va, rho);
  trim.found = r.norm() < 1e-9 && beyond_stops(airframe, trim.deflections) == Beyond::none &&
               std::abs(trim.roll_rad) < 0.5 && x(5) >= 0 && trim.throttle_frac >= 0 &&
               trim.throttle_frac <= 1;
  return trim;
}

}  // namespace fulmar
