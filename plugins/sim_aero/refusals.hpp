// SPDX-License-Identifier: BSD-3-Clause
// Aircraft that do not fly, each with what is wrong. A sentence begins with the parameter at fault: the host
// then says in which line of which file it stands.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/plant.hpp"

namespace fulmar::sim {

inline std::string figures(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}
inline std::string degrees(double rad) { return figures(rad * 57.29577951308232) + " deg"; }

/// Why this is no aircraft that flies: a map of some fields leaves the rest at nothing. Empty when it is one.
inline std::string missing_part(const Airframe& a) {
  if (!(a.aero.lift.alpha_ratio > 0)) return "the airframe has no lift: aero.lift.alpha is missing";
  if (!has_thrust(a.propulsion))
    return "the airframe has no thrust: propulsion.ct0 or propulsion.disc is missing";
  const Inertia& J = a.inertia;
  if (!(J.xz_kgm2 * J.xz_kgm2 < J.xx_kgm2 * J.zz_kgm2))
    return "airframe.inertia.xz: the inertia is not positive definite: xz is " + figures(J.xz_kgm2) +
           " kg m2, and its square has to be less than xx zz, so xz less than " +
           figures(std::sqrt(J.xx_kgm2 * J.zz_kgm2)) + " either way";
  return "";
}

/// What stands against a steady flight, and the parameter that says so.
inline std::string trim_words(const Airframe& a, const SteadyFlight& f, const std::string& airspeed_from) {
  const auto surface = [&](const char* name, double value, double limit) {
    return "airframe." + std::string(name) + ".limit: no level flight at " +
           figures(f.condition.airspeed_mps) + " m/s: it takes " + degrees(value) + " of " + name +
           ", which moves " + degrees(limit);
  };
  const auto at = [&](const std::string& field, const std::string& why) {
    return field + ": no level flight at " + figures(f.condition.airspeed_mps) + " m/s: " + why;
  };
  const double Va = f.condition.airspeed_mps, q = 0.5 * f.density_kgm3 * Va * Va;
  switch (f.limit) {
    case TrimLimit::none: break;
    case TrimLimit::no_aileron: return at("airframe.aero.roll", "the aileron does not roll it");
    case TrimLimit::no_elevator: return at("airframe.aero.pitch", "the elevator does not pitch it");
    case TrimLimit::no_thrust: return at("airframe.propulsion", "the propeller has no thrust");
    case TrimLimit::stall:
      return at(airspeed_from, "the wing stalls: it would have to carry CL " +
                                   figures(a.mass_kg * isa::g0 / (q * a.wing.area_m2)) +
                                   ", and the most is " + figures(max_lift(a).coefficient));
    case TrimLimit::elevator: return surface("elevator", f.input(model::elevator), a.elevator.limit_rad);
    case TrimLimit::aileron: return surface("aileron", f.input(model::aileron), a.aileron.limit_rad);
    case TrimLimit::rudder: return surface("rudder", f.input(model::rudder), a.rudder.limit_rad);
    case TrimLimit::throttle_high:
      return at("airframe.propulsion", "it takes more thrust than full throttle gives");
    case TrimLimit::throttle_low:
      return at("airframe.propulsion", "the propeller would have to brake more than it does");
    case TrimLimit::not_found: break;
  }
  return at(airspeed_from, "no angles and deflections balance all forces and moments");
}

/// Why the flight cannot go on. [ends the flight]
inline std::string departure_words(const Plant& p) {
  const Departure d = p.departure();
  if (d == Departure::beyond_alpha || d == Departure::beyond_beta) {
    const AirData air(p.air_velocity_b());
    const bool alpha = d == Departure::beyond_alpha;
    return (alpha ? "angle of attack " : "sideslip ") + degrees(alpha ? air.alpha : air.beta) +
           " is beyond the tables of the airframe" + table_ends(p.aerodynamic(), d);
  }
  const RigidBody& x = p.state();
  return "the motion has left the model: speed " + figures(x.v_n.norm()) + " m/s, body rate " +
         figures(x.omega_b.norm()) +
         " rad/s; a coefficient or inertia of the airframe is wrong, or the rate of "
         "the loop too low for it";
}

}  // namespace fulmar::sim
