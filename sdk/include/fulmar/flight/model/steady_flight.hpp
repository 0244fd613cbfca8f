// SPDX-License-Identifier: BSD-3-Clause
// Steady flight: straight or turning, level, climbing or descending. Newton's method on the equations of
// motion, with the exact Jacobian of the simulator's model. Sources: Beard & McLain, Small Unmanned Aircraft
// (2012), section 5.3; Stevens, Lewis & Johnson, Aircraft Control and Simulation (2016), section 3.6.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>

#include "fulmar/flight/math/dual.hpp"
#include "fulmar/flight/model/aircraft_model.hpp"
#include "fulmar/flight/model/max_lift.hpp"
#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/flight/model/trim.hpp"

namespace fulmar {

/// Unit in which a SteadyCondition has its turn.
enum class Turn : std::uint8_t { none, bank, radius };

/// The requested flight; true airspeed.
struct SteadyCondition {
  double airspeed_mps = 0;
  double climb_rad = 0;  ///< flight path angle, up
  Turn turn = Turn::none;
  double turn_by = 0;  ///< rad of bank or m of radius of the horizontal track, right positive
  /// False: straight flight has wings level, and a turn no side force. True: both have no sideslip.
  bool no_sideslip = false;
};

/// Limit that prevents a steady flight.
enum class TrimLimit : std::uint8_t {
  none,
  no_aileron,  ///< no aileron effect
  no_elevator,
  no_thrust,  ///< no thrust at any speed
  stall,      ///< weight beyond the maximum lift
  elevator,   ///< beyond its throw
  aileron,
  rudder,
  throttle_high,  ///< more than full
  throttle_low,   ///< more drag needed than that of the propeller at zero throttle
  not_found,
};

/// Result of `steady_flight`. States and inputs are in the order and units of model::State and model::Input.
struct SteadyFlight {
  SteadyCondition condition;
  TrimLimit limit = TrimLimit::not_found;
  double residual = 0;  ///< remaining accelerations, m/s2 and rad/s2; heading is north
  model::StateVector<double> x = model::StateVector<double>::Zero();
  model::InputVector<double> input = model::InputVector<double>::Zero();
  double alpha_rad = 0, beta_rad = 0, turn_radps = 0;
  double propeller_radps = 0, density_kgm3 = 0;
  bool found() const { return limit == TrimLimit::none; }
  Deflections deflections() const {
    return {input(model::aileron), input(model::elevator), input(model::rudder)};
  }
};

namespace detail {

/// Unknowns and equations of a steady flight.
class SteadyEquations {
 public:
  enum Unknown : int { alpha, beta, aileron, elevator, rudder, propeller, bank, turn, unknowns };
  template <class S>
  using Vector = Eigen::Matrix<S, unknowns, 1>;
  static constexpr double propeller_scale = 1000;  // rad/s: scales all unknowns to about 1

  SteadyEquations(const AircraftModel& m, const SteadyCondition& c)
      : model_(m), condition_(c), has_rudder_(rudder_acts(m.airframe())) {}

  template <class S>
  model::StateVector<S> state(const Vector<S>& z) const {
    using std::atan2, std::cos, std::sin, std::sqrt;
    // pitch angle for the flight path angle: Stevens, Lewis & Johnson, rate-of-climb constraint
    const S a = cos(z(alpha)) * cos(z(beta));
    const S b = sin(z(bank)) * sin(z(beta)) + cos(z(bank)) * sin(z(alpha)) * cos(z(beta));
    const double s = std::sin(condition_.climb_rad);
    const S root = sqrt(std::max(S(0.0), S(a * a - s * s + b * b)));
    const S theta = atan2(S(a * b + s * root), S(a * a - s * s));
    model::StateVector<S> x = model::StateVector<S>::Zero();
    x.template segment<3>(model::u) = air_velocity<S>(condition_.airspeed_mps, z(alpha), z(beta));
    x(model::roll) = z(bank);
    x(model::pitch) = theta;
    x(model::p) = -z(turn) * sin(theta);  // rates at a constant psi dot: B&M (3.2)
    x(model::q) = z(turn) * sin(z(bank)) * cos(theta);
    x(model::r) = z(turn) * cos(z(bank)) * cos(theta);
    return x;
  }

  template <class S>
  Vector<S> residual(const Vector<S>& z) const {
    const model::StateVector<S> x = state(z);
    const DeflectionsOf<S> d{z(aileron), z(elevator), z(rudder), S(model_.flap_rad())};
    const S Omega = propeller_scale * z(propeller);
    const model::StateVector<S> rate = model_.rate_at<S>(x, d, Omega);
    Vector<S> r;
    r.template head<3>() = rate.template segment<3>(model::u);
    r.template segment<3>(3) = rate.template segment<3>(model::p);
    r(6) = turning(z);
    r(7) = balance(z, x, d, Omega);
    return r;
  }

 private:
  template <class S>
  S turning(const Vector<S>& z) const {
    if (condition_.turn == Turn::bank) return z(bank) - condition_.turn_by;
    if (condition_.turn == Turn::none) return z(turn);
    return z(turn) - condition_.airspeed_mps * std::cos(condition_.climb_rad) / condition_.turn_by;
  }
  template <class S>
  S balance(const Vector<S>& z, const model::StateVector<S>& x, const DeflectionsOf<S>& d,
            const S& Omega) const {
    if (!has_rudder_) return z(rudder);
    if (condition_.no_sideslip) return z(beta);
    if (condition_.turn == Turn::none) return z(bank);
    const LoadOf<S> load = model_.load<S>(x.template segment<3>(model::u), x.template segment<3>(model::p), d,
                                          Omega, model_.density(x));
    return load.force_b.y() / model_.airframe().mass_kg;
  }

  const AircraftModel& model_;
  SteadyCondition condition_;
  bool has_rudder_;
};

/// Newton's method from `z`; returns the residual.
template <std::same_as<SteadyEquations> Equations>
double solve_steady(const Equations& equations, SteadyEquations::Vector<double>& z) {
  constexpr int n = SteadyEquations::unknowns;
  double left = 1e9;
  for (int steps = 0; steps < 60; ++steps) {
    SteadyEquations::Vector<Dual<n>> dual;
    for (int k = 0; k < n; ++k) dual(k) = Dual<n>::variable(z(k), k);
    const SteadyEquations::Vector<Dual<n>> f = equations.residual(dual);
    SteadyEquations::Vector<double> r;
    Eigen::Matrix<double, n, n> J;
    for (int k = 0; k < n; ++k) {
      r(k) = f(k).v;
      for (int i = 0; i < n; ++i) J(k, i) = f(k).d[std::size_t(i)];
    }
    left = r.norm();
    if (!std::isfinite(left)) return 1e9;
    if (left < 1e-12) break;
    const SteadyEquations::Vector<double> step = J.fullPivLu().solve(r);
    if (!step.allFinite()) return 1e9;
    if (step.norm() < 1e-15) break;
    z -= step * std::min(1.0, 0.2 / step.norm());
  }
  return left;
}

inline double density_of(const AircraftModel& m) {
  return m.density<double>(model::StateVector<double>::Zero());
}

/// Initial guess: lift carries the weight of the turn, the elevator balances the moment.
inline SteadyEquations::Vector<double> steady_guess(const AircraftModel& m, const SteadyCondition& c) {
  using E = SteadyEquations;
  const Airframe& a = m.airframe();
  const double Va = c.airspeed_mps, rho = density_of(m);
  const double phi = c.turn == Turn::bank     ? c.turn_by
                     : c.turn == Turn::radius ? std::atan(Va * Va / (isa::g0 * c.turn_by))
                                              : 0;
  const Derivatives &L = a.aero.lift, &M = a.aero.pitch;
  const double CL = a.mass_kg * isa::g0 / (0.5 * rho * Va * Va * a.wing.area_m2 * std::cos(phi));
  const double slope = L.alpha_ratio > 0.1 ? L.alpha_ratio : 5;
  E::Vector<double> z = E::Vector<double>::Zero();
  z(E::alpha) = std::clamp((CL - L.zero_ratio) / slope, -0.1, 0.8 * a.wing.stall_alpha_rad);
  z(E::elevator) =
      std::clamp(-(M.zero_ratio + M.alpha_ratio * z(E::alpha) + tables_at(a, z(E::alpha))) / M.elevator_ratio,
                 -0.5, 0.5);
  z(E::propeller) = m.propeller().steady_speed(0.6, Va, rho) / E::propeller_scale;
  z(E::bank) = phi;
  z(E::turn) = isa::g0 * std::tan(phi) / Va;
  return z;
}

/// Thrust needed, N: drag at a lift coefficient, plus the component of the weight along the flight path.
inline double thrust_needed(const AircraftModel& m, const SteadyCondition& c, double CL, double rho) {
  const Airframe& a = m.airframe();
  const double Va = c.airspeed_mps;
  const double alpha = (CL - a.aero.lift.zero_ratio) / std::max(a.aero.lift.alpha_ratio, 0.1);
  const Load load =
      m.aerodynamic().load({Va * std::cos(alpha), 0, Va * std::sin(alpha)}, Eigen::Vector3d::Zero(), {}, rho);
  const double drag = -load.force_b.x() * std::cos(alpha) - load.force_b.z() * std::sin(alpha);
  return (drag + a.mass_kg * isa::g0 * std::sin(c.climb_rad)) / std::cos(alpha);
}

/// Limit that explains the failure of Newton's method, from a balance of lift and thrust.
inline TrimLimit reason_of_none(const AircraftModel& m, const SteadyFlight& f) {
  const double Va = f.condition.airspeed_mps, rho = f.density_kgm3;
  const double load_factor = std::cos(f.condition.climb_rad) / std::cos(f.x(model::roll));
  const double CL =
      load_factor * m.airframe().mass_kg * isa::g0 / (0.5 * rho * Va * Va * m.airframe().wing.area_m2);
  if (CL > max_lift(m.airframe()).coefficient) return TrimLimit::stall;
  const double thrust = thrust_needed(m, f.condition, CL, rho);
  const auto there = [&](double throttle) {
    const Propeller& propeller = m.propeller();
    return m.propellers().along() * propeller.thrust(propeller.steady_speed(throttle, Va, rho), Va, rho);
  };
  if (thrust > there(1)) return TrimLimit::throttle_high;
  if (thrust < there(0)) return TrimLimit::throttle_low;
  return TrimLimit::not_found;
}

inline TrimLimit trim_limit(const AircraftModel& m, const SteadyFlight& f) {
  const Airframe& a = m.airframe();
  if (f.residual > 1e-9) return reason_of_none(m, f);
  if (std::abs(f.alpha_rad) > a.wing.stall_alpha_rad) return TrimLimit::stall;
  const Beyond beyond = beyond_stops(a, f.deflections());
  if (beyond == Beyond::elevator) return TrimLimit::elevator;
  if (beyond == Beyond::aileron) return TrimLimit::aileron;
  if (beyond == Beyond::rudder) return TrimLimit::rudder;
  if (f.propeller_radps < 0 || f.input(model::throttle) < 0) return TrimLimit::throttle_low;
  const double Omega = m.propeller().steady_speed(std::min(f.input(model::throttle), 1.0),
                                                  f.condition.airspeed_mps, f.density_kgm3);
  if (Omega < f.propeller_radps - 1e-6 * (1 + f.propeller_radps)) return TrimLimit::throttle_high;
  return TrimLimit::none;
}

inline TrimLimit missing_part(const Airframe& a) {
  if (std::abs(a.aero.roll.aileron_ratio) < 1e-9) return TrimLimit::no_aileron;
  if (std::abs(a.aero.pitch.elevator_ratio) < 1e-9) return TrimLimit::no_elevator;
  return has_thrust(a.propulsion) ? TrimLimit::none : TrimLimit::no_thrust;
}

inline SteadyFlight filled(const AircraftModel& m, const SteadyCondition& c,
                           const SteadyEquations::Vector<double>& z, double left) {
  using E = SteadyEquations;
  SteadyFlight f;
  f.condition = c;
  f.residual = left;
  f.density_kgm3 = density_of(m);
  f.x = E(m, c).state(z);
  f.alpha_rad = z(E::alpha);
  f.beta_rad = z(E::beta);
  f.turn_radps = z(E::turn);
  f.propeller_radps = E::propeller_scale * z(E::propeller);
  f.input << z(E::aileron), z(E::elevator), z(E::rudder),
      m.propeller().throttle_for(f.propeller_radps, c.airspeed_mps, f.density_kgm3);
  if (left > 1e-9) f.x(model::roll) = steady_guess(m, c)(E::bank);
  f.limit = trim_limit(m, f);
  return f;
}

}  // namespace detail

/// The steady flight, or the best approximation with the limit that prevents it. Beyond the stall several
/// solutions exist; this is the one with attached flow. A template, so that only its users compile its
/// derivatives.
template <std::same_as<AircraftModel> Model>
SteadyFlight steady_flight(const Model& m, const SteadyCondition& c) {
  using E = detail::SteadyEquations;
  if (const TrimLimit missing = detail::missing_part(m.airframe()); missing != TrimLimit::none) {
    SteadyFlight f;
    f.condition = c;
    f.limit = missing;
    return f;
  }
  const E::Vector<double> guess = detail::steady_guess(m, c);
  E::Vector<double> z = guess;
  double left = detail::solve_steady(E(m, c), z);
  for (double alpha : {0.05, 0.15}) {
    if (left < 1e-9 && std::abs(z(E::alpha)) < m.airframe().wing.stall_alpha_rad) break;
    E::Vector<double> other = guess;
    other(E::alpha) = alpha;
    if (const double with = detail::solve_steady(E(m, c), other); with < left) {
      z = other;
      left = with;
    }
  }
  return detail::filled(m, c, z, left);
}

}  // namespace fulmar
