// SPDX-License-Identifier: BSD-3-Clause
// Aerodynamic force and moment of a fixed-wing aircraft. Source: Beard & McLain, Small Unmanned Aircraft,
// chapter 4: (4.6)-(4.16), with the stall blending (4.9), (4.10). Smooth down to zero airspeed: rates enter
// as rho Va S c q / 4, never as c q / 2 Va.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/flight/model/more_aerodynamics.hpp"
#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Aerodynamic force, N, and moment, N m, in body axes, about the centre of gravity. Angles in rad.
class Aerodynamic {
 public:
  explicit Aerodynamic(const Airframe& a)
      : wing_(a.wing),
        aero_(a.aero),
        induced_free_(
            1 / (std::numbers::pi * a.wing.oswald_ratio * a.wing.span_m * a.wing.span_m / a.wing.area_m2)),
        induced_(induced_free_),
        more_(has_more(a.aero)),
        disc_m2_(propeller_disc(a.propulsion)),
        alpha_range_(table_range(a.aero, TableVariable::alpha)),
        beta_range_(table_range(a.aero, TableVariable::beta)),
        over_mach_(std::isfinite(table_range(a.aero, TableVariable::mach).max)) {}

  /// Sets the induced drag to `part` of that in free air.
  void near_ground(double part) { induced_ = part * induced_free_; }

  /// Share of separated flow, 0 to 1. (4.10)
  double stall(double alpha) const { return separated(alpha); }

  /// Load at air-relative velocity `v_r` and body rate `omega` in air of density `rho`. (4.18), (4.19),
  /// (4.20) The wing uses the flow in the plane of symmetry, Va cos(beta): equal to the book at small
  /// sideslip, and continuous at 90 degrees.
  Load load(const Eigen::Vector3d& v_r, const Eigen::Vector3d& omega, const Deflections& d,
            double rho) const {
    return load_of<double>(v_r, omega, d, rho);
  }

  template <class S>
  LoadOf<S> load_of(const Eigen::Vector3<S>& v_r, const Eigen::Vector3<S>& omega, const DeflectionsOf<S>& d,
                    const S& rho) const {
    const AirDataOf<S> air(v_r);
    const S sigma = separated(air.alpha);
    const S alpha =
        (1 - sigma) * air.alpha + sigma * air.sin_alpha;  // linear terms: bounded and continuous at pi
    const S half_rho_S = 0.5 * rho * wing_.area_m2;
    const S qS = half_rho_S * air.Va * air.Va, plane_qS = half_rho_S * air.in_plane * air.in_plane;
    const S rates = 0.5 * half_rho_S * air.Va;  // (rho Va^2 S / 2) / (2 Va)
    const Eigen::Vector3<S> rate(rates * wing_.span_m * omega.x(), rates * wing_.chord_m * omega.y(),
                                 rates * wing_.span_m * omega.z());
    const auto sum = [&](const Derivatives& c) -> S {
      return qS * (c.beta_ratio * air.beta + c.aileron_ratio * d.aileron + c.elevator_ratio * d.elevator +
                   c.rudder_ratio * d.rudder) +
             c.p_ratio * rate.x() + c.q_ratio * rate.y() + c.r_ratio * rate.z();
    };
    const auto sum_all = [&](const Derivatives& c, const S& qS_static) -> S {
      return qS_static * (c.zero_ratio + c.alpha_ratio * alpha) + sum(c);
    };
    const S L = plane_qS * lift(air.alpha, air.sin_alpha, air.cos_alpha, sigma) + sum(aero_.lift);
    const S D = plane_qS * drag(air.alpha, air.sin_alpha, sigma) + sum(aero_.drag) +
                half_rho_S * air.Va * air.in_plane * aero_.parasite_drag_ratio;
    LoadOf<S> out;
    out.force_b = {-D * air.cos_alpha + L * air.sin_alpha, sum_all(aero_.side, qS),
                   -D * air.sin_alpha - L * air.cos_alpha};
    out.moment_b = {wing_.span_m * sum_all(aero_.roll, qS), wing_.chord_m * sum_all(aero_.pitch, plane_qS),
                    wing_.span_m * sum_all(aero_.yaw, qS)};
    if (more_) add_more<S>(air, sigma, d, half_rho_S, out);
    return out;
  }

  /// Adds the effect of elevator and rudder in the slipstream of a propeller with this thrust, N. Far behind
  /// it V^2 = Va^2 + 2 T / (rho A): Froude's momentum theory (Glauert, The Elements of Aerofoil and Airscrew
  /// Theory, chapter XV). A braking propeller removes at most the available flow.
  template <class S>
  void add_wash(const Eigen::Vector3<S>& v_r, const DeflectionsOf<S>& d, const S& thrust, const S& rho,
                LoadOf<S>& load) const {
    if (aero_.wash_frac == 0) return;
    const AirDataOf<S> air(v_r);
    const S q = 0.5 * rho * air.Va * air.Va;
    const S more_qS = aero_.wash_frac * wing_.area_m2 * std::max(S(thrust / disc_m2_), S(-q));
    add_forces<S>(
        air, more_qS, more_qS,
        [&](const Derivatives& c, Coefficient) -> S {
          return c.elevator_ratio * d.elevator + c.rudder_ratio * d.rudder;
        },
        load);
  }
  bool washed() const { return aero_.wash_frac != 0; }

  /// True if tables depend on the Mach number; then the load needs the speed of sound.
  bool over_mach() const { return over_mach_; }
  void set_speed_of_sound(double mps) { sound_mps_ = mps; }

  /// Range of the airframe's tables; infinite without tables.
  const TableRange& alpha_range() const { return alpha_range_; }
  const TableRange& beta_range() const { return beta_range_; }
  bool beyond_tables(double alpha, double beta) const {
    return !(alpha_range_.holds(alpha) && beta_range_.holds(beta));
  }

 private:
  /// Adds the coefficients `of`(derivatives, index); those of the plane of symmetry times `plane_qS`.
  template <class S, class Of>
  void add_forces(const AirDataOf<S>& air, const S& plane_qS, const S& qS, Of&& of, LoadOf<S>& out) const {
    using C = Coefficient;
    const S L = plane_qS * of(aero_.lift, C::lift), D = plane_qS * of(aero_.drag, C::drag);
    out.force_b.x() += -D * air.cos_alpha + L * air.sin_alpha;
    out.force_b.y() += qS * of(aero_.side, C::side);
    out.force_b.z() += -D * air.sin_alpha - L * air.cos_alpha;
    out.moment_b.x() += wing_.span_m * qS * of(aero_.roll, C::roll);
    out.moment_b.y() += wing_.chord_m * plane_qS * of(aero_.pitch, C::pitch);
    out.moment_b.z() += wing_.span_m * qS * of(aero_.yaw, C::yaw);
  }

  /// Optional terms, in a separate function so that airframes without them have no cost.
  template <class S>
  [[gnu::noinline]] void add_more(const AirDataOf<S>& air, const S& sigma, const DeflectionsOf<S>& d,
                                  const S& half_rho_S, LoadOf<S>& out) const {
    const S qS = half_rho_S * air.Va * air.Va, plane_qS = half_rho_S * air.in_plane * air.in_plane;
    const TablePoint<S> point = table_point<S>(air, d, sound_mps_);
    add_forces<S>(
        air, plane_qS, qS,
        [&](const Derivatives& c, Coefficient which) -> S {
          S sum = c.flap_ratio * d.flap;
          for (const CoefficientTable& t : aero_.tables)
            if (t.coefficient == which) sum += value_of<S>(t, point);
          if (which == Coefficient::drag) sum += squared_drag<S>(aero_.drag_squared, air.beta, d);
          if (which == Coefficient::pitch && aero_.pitch_stalled_ratio != 0)
            sum += stalled_pitch<S>(aero_, air, sigma);
          return sum;
        },
        out);
  }

  template <class S>
  S separated(const S& alpha) const {
    using std::exp;
    const double M = wing_.stall_sharpness_ratio, alpha0 = wing_.stall_alpha_rad;
    const S e1 = exp(std::min(S(-M * (alpha - alpha0)), S(300.0)));
    const S e2 = exp(std::min(S(M * (alpha + alpha0)), S(300.0)));
    return (1 + e1 + e2) / ((1 + e1) * (1 + e2));
  }

  /// CL(alpha): linear, blended into a flat plate. (4.9)
  template <class S>
  S lift(const S& alpha, const S& sin_alpha, const S& cos_alpha, const S& sigma) const {
    using std::copysign;
    const S plate = 2 * copysign(S(sin_alpha * sin_alpha), alpha) * cos_alpha;
    return (1 - sigma) * (aero_.lift.zero_ratio + aero_.lift.alpha_ratio * alpha) + sigma * plate;
  }

  /// CD(alpha) without the parasite drag: induced (4.11), blended into a flat plate.
  template <class S>
  S drag(const S& alpha, const S& sin_alpha, const S& sigma) const {
    using std::abs;
    const S linear_lift = aero_.lift.zero_ratio + aero_.lift.alpha_ratio * alpha;
    const S attached =
        aero_.drag.zero_ratio + aero_.drag.alpha_ratio * alpha + induced_ * linear_lift * linear_lift;
    return (1 - sigma) * attached + sigma * 2 * abs(sin_alpha) * sin_alpha * sin_alpha;
  }

  Wing wing_;
  Aerodynamics aero_;
  double induced_free_;  ///< 1 / (pi e AR)
  double induced_;
  bool more_;       ///< true for terms beyond the derivative set
  double disc_m2_;  ///< disc area of the propeller
  TableRange alpha_range_, beta_range_;
  bool over_mach_;
  double sound_mps_ = 340.29;  ///< speed of sound, at sea level
};

/// Part of the induced drag that remains `height_m` above the ground. McCormick, Aerodynamics, Aeronautics
/// and Flight Mechanics (1979), chapter 7: phi = (16 h/b)^2 / (1 + (16 h/b)^2).
inline double induced_drag_near_ground(double height_m, double span_m) {
  const double x = 16 * std::max(height_m, 0.0) / span_m;
  return x * x / (1 + x * x);
}

}  // namespace fulmar
