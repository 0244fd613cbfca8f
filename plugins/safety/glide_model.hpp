// SPDX-License-Identifier: BSD-3-Clause
// Glide of an airframe by its drag polar and the drag of its stopped propeller. The propeller dominates on a
// motor that is braked by its windings.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/turn_trim.hpp"
#include "fulmar/flight/model/propulsion.hpp"

namespace fulmar::safety {

/// Thrust of all propellers at a throttle, N; their tilt is neglected.
inline double thrust_of(const Airframe& a, double throttle_frac, double Va, double rho) {
  const Propeller propeller(a.propulsion);
  const double Omega = propeller.steady_speed(throttle_frac, Va, rho);
  return propeller.thrust(Omega, Va, rho) *
         std::max<double>(1, static_cast<double>(a.propulsion.propellers.size()));
}

/// Sink of a steady glide at bank `roll_rad`, m/s: Va (D - T) / (m g). Beard & McLain, Small Unmanned
/// Aircraft (2012), section 5.3, for small path angles; drag by turn_trim.
inline double sink_rate(const Airframe& a, double Va, double roll_rad, double rho) {
  constexpr double g = 9.80665;
  const double drag = turn_trim(a, roll_rad, Va, rho).drag_newton - thrust_of(a, 0, Va, rho);
  return Va * drag / (a.mass_kg * g);
}

struct BestGlide {
  double airspeed_mps = 0;
  double sink_mps = 0;
};

/// Flattest glide over the ground with `head_wind_mps`, within the airspeed limits: maximum of (Va - w) /
/// sink, from `margin_ratio` times the least speed on.
inline BestGlide best_glide(const Airframe& a, double rho, double head_wind_mps, double margin_ratio) {
  const FlightLimits& limits = a.limits;
  BestGlide best;
  double best_ratio = -1e9;
  const double from = margin_ratio * limits.airspeed_min_mps, to = limits.airspeed_max_mps;
  for (int i = 0; i <= 40; ++i) {
    const double Va = from + (to - from) * i / 40, sink = std::max(sink_rate(a, Va, 0, rho), 1e-3);
    const double ratio = (Va - head_wind_mps) / sink;
    if (ratio > best_ratio) {
      best_ratio = ratio;
      best = {Va, sink};
    }
  }
  return best;
}

}  // namespace fulmar::safety
