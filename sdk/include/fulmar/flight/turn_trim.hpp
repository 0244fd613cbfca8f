// SPDX-License-Identifier: BSD-3-Clause
// Trim of a steady coordinated turn, from an airframe's linear lift and pitching moment: what a control law
// feeds forward so that height does not sag when the wing banks. Beard & McLain, Small Unmanned Aircraft
// (2012), sections 5.3 and 9.2.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Body rates of a steady coordinated turn at bank phi: psi' = g tan(phi) / Va, turned into body axes.
struct TurnRates {
  double p_radps = 0, q_radps = 0, r_radps = 0;
};

inline TurnRates turn_rates(double roll_rad, double pitch_rad, double airspeed_mps,
                            double gravity_mps2 = 9.80665) {
  const double psi_dot =
      gravity_mps2 * std::tan(std::clamp(roll_rad, -1.2, 1.2)) / std::max(airspeed_mps, 1.0);
  return {-psi_dot * std::sin(pitch_rad), psi_dot * std::sin(roll_rad) * std::cos(pitch_rad),
          psi_dot * std::cos(roll_rad) * std::cos(pitch_rad)};
}

/// Lift over weight of a level turn, bounded: at 1.2 rad it is 2.8.
inline double load_factor(double roll_rad) { return 1 / std::cos(std::clamp(roll_rad, -1.2, 1.2)); }

struct TurnTrim {
  double alpha_rad = 0;
  double elevator_rad = 0;
  double drag_newton = 0;
};

/// Solves CL = n W / (q S), Cm = 0 with the pitch rate of the turn. All zeros for an airframe whose elevator
/// moves nothing (none given).
inline TurnTrim turn_trim(const Airframe& airframe, double roll_rad, double airspeed_mps,
                          double density_kgpm3, double gravity_mps2 = 9.80665) {
  const Derivatives &L = airframe.aero.lift, &M = airframe.aero.pitch, &D = airframe.aero.drag;
  const double Va = std::max(airspeed_mps, 0.5 * airframe.limits.airspeed_min_mps);
  const double qS = 0.5 * density_kgpm3 * Va * Va * airframe.wing.area_m2;
  const double determinant = L.alpha_ratio * M.elevator_ratio - L.elevator_ratio * M.alpha_ratio;
  if (std::abs(determinant) < 1e-9 || qS < 1e-9) return {};
  const bool turns = roll_rad != 0;  // level flight needs no angles, and is asked for at each step
  const double q = turns ? turn_rates(roll_rad, 0, Va, gravity_mps2).q_radps : 0;
  const double q_hat = q * airframe.wing.chord_m / (2 * Va);
  const double CL = (turns ? load_factor(roll_rad) : 1) * airframe.mass_kg * gravity_mps2 / qS;
  const double lift = CL - L.zero_ratio - L.q_ratio * q_hat, moment = -M.zero_ratio - M.q_ratio * q_hat;
  TurnTrim trim;
  trim.alpha_rad = (lift * M.elevator_ratio - L.elevator_ratio * moment) / determinant;
  trim.elevator_rad = (L.alpha_ratio * moment - M.alpha_ratio * lift) / determinant;
  const double aspect = airframe.wing.span_m * airframe.wing.span_m / airframe.wing.area_m2;
  const double induced = CL * CL / (3.14159265358979323846 * airframe.wing.oswald_ratio * aspect);
  trim.drag_newton = qS * (airframe.aero.parasite_drag_ratio + induced + D.q_ratio * q_hat +
                           D.elevator_ratio * trim.elevator_rad);
  return trim;
}

}  // namespace fulmar
