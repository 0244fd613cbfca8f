// SPDX-License-Identifier: BSD-3-Clause
// Deflection for a body rate, from the airframe's derivatives at the present dynamic pressure. One set of
// bandwidths is therefore valid for every airframe. Beard & McLain, Small Unmanned Aircraft (2012), (4.10) to
// (4.21).
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/pid.hpp"
#include "fulmar/flight/control/turn_trim.hpp"

namespace fulmar::manual {

/// Angular acceleration per surface, 1/s2 per rad, and surface per steady rate, rad s/rad.
struct Authority {
  double power = 0;
  double steady = 0;
};

/// At true airspeed `Va`, m/s, in air of density `rho`, kg/m3.
inline Authority aileron_authority(const Airframe& a, double Va, double rho) {
  const double qSb = 0.5 * rho * Va * Va * a.wing.area_m2 * a.wing.span_m;
  const Derivatives& l = a.aero.roll;
  if (l.aileron_ratio == 0) return {};
  return {qSb * l.aileron_ratio / a.inertia.xx_kgm2, -a.wing.span_m / (2 * Va) * l.p_ratio / l.aileron_ratio};
}

/// A steady pitch rate q needs a lift of m Va q beyond level flight, CL = m Va q / (q_bar S), and no moment:
/// the equations of turn_trim().
inline Authority elevator_authority(const Airframe& a, double Va, double rho) {
  const Derivatives &L = a.aero.lift, &M = a.aero.pitch;
  const double qS = 0.5 * rho * Va * Va * a.wing.area_m2, hat = a.wing.chord_m / (2 * Va);
  const double determinant = L.alpha_ratio * M.elevator_ratio - L.elevator_ratio * M.alpha_ratio;
  if (M.elevator_ratio == 0 || std::abs(determinant) < 1e-9) return {};
  const double lift = a.mass_kg * Va / qS - L.q_ratio * hat, moment = -M.q_ratio * hat;
  return {qS * a.wing.chord_m * M.elevator_ratio / a.inertia.yy_kgm2,
          (L.alpha_ratio * moment - M.alpha_ratio * lift) / determinant};
}

/// A rate loop: surface = trim + steady rate_c + kp (rate_c - rate) + integral. kp adds `damping`, rad/s, to
/// that of the airframe.
struct RateLoop {
  Authority authority;
  double trim = 0;  ///< rad, of the surface at zero rate
  double kp = 0;    ///< rad s/rad

  RateLoop(const Authority& of, double trim_rad, double damping)
      : authority(of), trim(trim_rad), kp(of.power != 0 ? damping / of.power : 0) {}
  double feedforward(double rate_c) const { return trim + authority.steady * rate_c; }
  /// Without integral: the point where a limit of the rate begins to govern a surface under the stick.
  double proportional(double rate_c, double rate) const { return feedforward(rate_c) + kp * (rate_c - rate); }
};

}  // namespace fulmar::manual
