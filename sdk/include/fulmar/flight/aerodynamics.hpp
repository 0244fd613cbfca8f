// SPDX-License-Identifier: BSD-3-Clause
// Aerodynamic force and moment of a fixed-wing aircraft. Source: Beard & McLain, Small Unmanned Aircraft,
// chapter 4: (4.6)-(4.16), with the stall blending (4.9), (4.10). Smooth down to no airspeed: rates enter as
// rho Va S c q / 4, never as c q / 2 Va.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/flight/rigid_body.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Deflections as they are, in radians: signs as in `Actuators`.
template <class S>
struct DeflectionsOf {
  S aileron = 0, elevator = 0, rudder = 0;
};
using Deflections = DeflectionsOf<double>;

/// Airspeed, angle of attack and sideslip of an air-relative velocity in body axes. Beard & McLain (2.8).
template <class S>
struct AirDataOf {
  explicit AirDataOf(const Eigen::Vector3<S>& v_r) : Va(plain::norm<S>(v_r)) {
    using std::sqrt, std::atan2, std::asin;
    in_plane = sqrt(v_r.x() * v_r.x() + v_r.z() * v_r.z());
    if (in_plane > 0) {
      cos_alpha = v_r.x() / in_plane;
      sin_alpha = v_r.z() / in_plane;
      alpha = atan2(v_r.z(), v_r.x());
    }
    if (Va > 0) beta = asin(std::clamp(S(v_r.y() / Va), S(-1.0), S(1.0)));
  }
  S Va;
  S in_plane;  ///< speed in the plane of symmetry
  S alpha = 0, beta = 0, cos_alpha = 1, sin_alpha = 0;
};
using AirData = AirDataOf<double>;

class Aerodynamic {
 public:
  explicit Aerodynamic(const Airframe& a)
      : wing_(a.wing),
        aero_(a.aero),
        induced_free_(
            1 / (std::numbers::pi * a.wing.oswald_ratio * a.wing.span_m * a.wing.span_m / a.wing.area_m2)),
        induced_(induced_free_) {}

  /// From here on the induced drag is `part` of that in free air.
  void near_ground(double part) { induced_ = part * induced_free_; }

  /// Share of separated flow, 0 to 1. (4.10)
  double stall(double alpha) const { return separated(alpha); }

  /// At air-relative velocity `v_r` and body rate `omega` in air of density `rho`. (4.18), (4.19), (4.20)
  /// The wing works with the flow in the plane of symmetry, Va cos(beta): the book's equations at small
  /// sideslip, and no jump at 90 degrees.
  Load load(const Eigen::Vector3d& v_r, const Eigen::Vector3d& omega, const Deflections& d,
            double rho) const {
    return load_of<double>(v_r, omega, d, rho);
  }

  template <class S>
  LoadOf<S> load_of(const Eigen::Vector3<S>& v_r, const Eigen::Vector3<S>& omega, const DeflectionsOf<S>& d,
                    const S& rho) const {
    const AirDataOf<S> air(v_r);
    const S sigma = separated(air.alpha);
    const S alpha = (1 - sigma) * air.alpha +
                    sigma * air.sin_alpha;  // of the linear terms: bounded and without a jump at pi
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
    return out;
  }

 private:
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
};

/// Part of the induced drag that is left `height_m` above the ground. McCormick, Aerodynamics, Aeronautics
/// and Flight Mechanics (1979), chapter 7: phi = (16 h/b)^2 / (1 + (16 h/b)^2).
inline double induced_drag_near_ground(double height_m, double span_m) {
  const double x = 16 * std::max(height_m, 0.0) / span_m;
  return x * x / (1 + x * x);
}

}  // namespace fulmar
