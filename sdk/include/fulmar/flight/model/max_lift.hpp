// SPDX-License-Identifier: BSD-3-Clause
// Maximum lift of a trimmed wing by the model of the airframe: derivatives, stall blending and tables.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/model/aerodynamics.hpp"

namespace fulmar {

/// Pitching moment coefficient of the tables at an angle of attack, with all other arguments 0.
inline double tables_at(const Airframe& a, double alpha) {
  double sum = 0;
  for (const CoefficientTable& t : a.aero.tables)
    if (t.coefficient == Coefficient::pitch) sum += value_of<double>(t, {0, alpha, 0, 0, 0, 0, 0});
  return sum;
}

/// CL at an angle of attack, with the elevator balancing the pitching moment within its throw.
inline double trimmed_lift(const Aerodynamic& aero, const Airframe& a, double alpha) {
  const Derivatives &M = a.aero.pitch, &L = a.aero.lift;
  const Load load =
      aero.load({std::cos(alpha), 0, std::sin(alpha)}, Eigen::Vector3d::Zero(), {}, 2 / a.wing.area_m2);
  const double elevator =
      M.elevator_ratio != 0
          ? std::clamp(-(M.zero_ratio + M.alpha_ratio * alpha + tables_at(a, alpha)) / M.elevator_ratio,
                       -a.elevator.limit_rad, a.elevator.limit_rad)
          : 0;
  return load.force_b.x() * std::sin(alpha) - load.force_b.z() * std::cos(alpha) +
         L.elevator_ratio * elevator;
}

/// Maximum lift, with the elevator balancing the pitching moment: CL and its angle of attack.
struct MostLift {
  double coefficient = 0, alpha_rad = 0;
};
/// Search in steps of 1e-3 rad from 0 to 0.1 rad beyond the stall angle, at most 1 rad.
inline MostLift max_lift(const Airframe& a) {
  const Aerodynamic aero(a);
  MostLift most;
  for (double alpha = 0; alpha < std::min(a.wing.stall_alpha_rad + 0.1, 1.0); alpha += 1e-3) {
    const double CL = trimmed_lift(aero, a, alpha);
    if (CL > most.coefficient) most = {CL, alpha};
  }
  return most;
}

}  // namespace fulmar
