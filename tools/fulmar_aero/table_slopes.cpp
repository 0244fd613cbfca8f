// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/math/dual.hpp"
#include "fulmar/flight/math/tables.hpp"
#include "tools/fulmar_aero/findings.hpp"

namespace fulmar::aero {
namespace {

using Slope = Dual<5>;  // alpha, beta, aileron, elevator, rudder

TablePoint<Slope> point_at(double alpha, double mach) {
  return {0.0,
          Slope::variable(alpha, 0),
          Slope::variable(0, 1),
          mach,
          Slope::variable(0, 2),
          Slope::variable(0, 3),
          Slope::variable(0, 4)};
}

/// Angle of attack at which the wing carries the weight, elevator at 0; up to the stall.
double alpha_of(const Airframe& a, double CL, double mach) {
  double low = -0.2, high = a.wing.stall_alpha_rad;
  for (int i = 0; i < 50; ++i) {
    const double alpha = 0.5 * (low + high);
    double lift = a.aero.lift.zero_ratio + a.aero.lift.alpha_ratio * alpha;
    for (const CoefficientTable& t : a.aero.tables)
      if (t.coefficient == Coefficient::lift) lift += value_of<Slope>(t, point_at(alpha, mach)).v;
    (lift < CL ? low : high) = alpha;
  }
  return 0.5 * (low + high);
}

}  // namespace

Aerodynamics with_table_slopes(const Airframe& a) {
  Aerodynamics out = a.aero;
  if (a.aero.tables.empty()) return out;
  const double Va = std::max(a.limits.airspeed_cruise_mps, 1.0), mach = Va / 340.29;
  const double CL = a.mass_kg * isa::g0 / (0.5 * isa::sea_level_density * Va * Va * a.wing.area_m2);
  const double alpha = alpha_of(a, CL, mach);
  constexpr std::array<Derivatives Aerodynamics::*, 6> of{&Aerodynamics::lift,  &Aerodynamics::drag,
                                                          &Aerodynamics::side,  &Aerodynamics::roll,
                                                          &Aerodynamics::pitch, &Aerodynamics::yaw};
  for (const CoefficientTable& t : a.aero.tables) {
    const Slope slope = value_of<Slope>(t, point_at(alpha, mach));
    Derivatives& to = out.*(of[std::size_t(t.coefficient)]);
    to.zero_ratio += slope.v - slope.d[0] * alpha;
    to.alpha_ratio += slope.d[0];
    to.beta_ratio += slope.d[1];
    to.aileron_ratio += slope.d[2];
    to.elevator_ratio += slope.d[3];
    to.rudder_ratio += slope.d[4];
  }
  return out;
}

}  // namespace fulmar::aero
