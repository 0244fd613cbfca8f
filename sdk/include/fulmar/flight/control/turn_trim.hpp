// SPDX-License-Identifier: BSD-3-Clause
// Trim of a steady coordinated turn, from linear lift and pitching moment of an airframe: feed-forward of a
// law that holds height in a bank. Beard & McLain, Small Unmanned Aircraft (2012), sections 5.3 and 9.2.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Body rates of a steady coordinated turn at bank phi: psi' = g tan(phi) / Va, turned into body axes.
struct TurnRates {
  double p_radps = 0, q_radps = 0, r_radps = 0;
};

/// Steepest bank for the feed-forward, rad; beyond it tan and 1 / cos are constant.
inline constexpr double steepest_turn_rad = 1.2, steepest_turn_tan = 2.5721516221263188,
                        steepest_turn_load = 2.759703601332406;

/// TurnRates at bank, pitch and true airspeed. The bank is limited to `steepest_turn_rad` in the tangent, the
/// airspeed to at least 1 m/s.
inline TurnRates turn_rates(double roll_rad, double pitch_rad, double airspeed_mps,
                            double gravity_mps2 = 9.80665) {
  const double s = std::sin(roll_rad),
               c = std::cos(roll_rad);  // the compiler computes sine and cosine together, but not a tangent
  const double tan =
      std::abs(roll_rad) <= steepest_turn_rad ? s / c : std::copysign(steepest_turn_tan, roll_rad);
  const double psi_dot = gravity_mps2 * tan / std::max(airspeed_mps, 1.0);
  return {-psi_dot * std::sin(pitch_rad), psi_dot * s * std::cos(pitch_rad),
          psi_dot * c * std::cos(pitch_rad)};
}

/// Lift over weight of a level turn, limited to 2.8, its value at 1.2 rad.
inline double load_factor(double roll_rad) {
  return std::abs(roll_rad) <= steepest_turn_rad ? 1 / std::cos(roll_rad) : steepest_turn_load;
}

/// Angle of attack, elevator and drag of a level turn.
struct TurnTrim {
  double alpha_rad = 0;
  double elevator_rad = 0;
  double drag_newton = 0;
};

/// Trims of level turns of one airframe at one airspeed and density: solves CL = n W / (q S), Cm = 0 with the
/// pitch rate of the turn. All zeros for an airframe without elevator effect.
class TurnTrims {
 public:
  TurnTrims(const Airframe& airframe, double airspeed_mps, double density_kgpm3,
            double gravity_mps2 = 9.80665)
      : a_(airframe), g_(gravity_mps2) {
    const Derivatives &L = a_.aero.lift, &M = a_.aero.pitch;
    Va_ = std::max(airspeed_mps, 0.5 * a_.limits.airspeed_min_mps);
    qS_ = 0.5 * density_kgpm3 * Va_ * Va_ * a_.wing.area_m2;
    const double determinant = L.alpha_ratio * M.elevator_ratio - L.elevator_ratio * M.alpha_ratio;
    if (std::abs(determinant) < 1e-9 || qS_ < 1e-9) return;
    solvable_ = true;
    // Divisions dominate the cost of a trim, and a law needs two trims in each step.
    per_determinant_ = 1 / determinant;
    level_lift_ = a_.mass_kg * g_ / qS_;
    half_chord_time_ = 0.5 * a_.wing.chord_m / Va_;
    induced_ =
        a_.wing.area_m2 / (3.14159265358979323846 * a_.wing.oswald_ratio * a_.wing.span_m * a_.wing.span_m);
  }

  TurnTrim at(double roll_rad) const {
    if (!solvable_) return {};
    const Derivatives &L = a_.aero.lift, &M = a_.aero.pitch, &D = a_.aero.drag;
    const bool turns = roll_rad != 0;  // level flight needs no angles
    const double q_hat = turns ? turn_rates(roll_rad, 0, Va_, g_).q_radps * half_chord_time_ : 0;
    const double CL = turns ? load_factor(roll_rad) * level_lift_ : level_lift_;
    const double lift = CL - L.zero_ratio - L.q_ratio * q_hat, moment = -M.zero_ratio - M.q_ratio * q_hat;
    TurnTrim trim;
    trim.alpha_rad = (lift * M.elevator_ratio - L.elevator_ratio * moment) * per_determinant_;
    trim.elevator_rad = (L.alpha_ratio * moment - M.alpha_ratio * lift) * per_determinant_;
    trim.drag_newton = qS_ * (a_.aero.parasite_drag_ratio + induced_ * CL * CL + D.q_ratio * q_hat +
                              D.elevator_ratio * trim.elevator_rad);
    return trim;
  }

 private:
  const Airframe& a_;
  double g_, Va_ = 0, qS_ = 0, per_determinant_ = 0, level_lift_ = 0, half_chord_time_ = 0, induced_ = 0;
  bool solvable_ = false;
};

/// One of these trims.
inline TurnTrim turn_trim(const Airframe& airframe, double roll_rad, double airspeed_mps,
                          double density_kgpm3, double gravity_mps2 = 9.80665) {
  return TurnTrims(airframe, airspeed_mps, density_kgpm3, gravity_mps2).at(roll_rad);
}

}  // namespace fulmar
