// SPDX-License-Identifier: BSD-3-Clause
// Reasons to reject an aircraft. A message begins with the parameter at fault: the host adds the line and the
// file.
#pragma once
#include <cmath>
#include <string>

#include "figures.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/plant.hpp"
#include "messages.hpp"

namespace fulmar::sim {

/// Reason why the airframe cannot fly: in a map of some fields the others are zero. Empty for a complete one.
inline std::string missing_part(const Airframe& a) {
  if (!(a.aero.lift.alpha_ratio > 0)) return sim_aero_messages::lift_missing();
  if (!has_thrust(a.propulsion)) return sim_aero_messages::thrust_missing();
  const Inertia& J = a.inertia;
  if (!(J.xz_kgm2 * J.xz_kgm2 < J.xx_kgm2 * J.zz_kgm2))
    return located("airframe.inertia.xz", sim_aero_messages::inertia_not_definite(
                                              figures(J.xz_kgm2), figures(std::sqrt(J.xx_kgm2 * J.zz_kgm2))));
  return "";
}

/// Cause that prevents a steady flight, and its parameter.
inline std::string trim_words(const Airframe& a, const SteadyFlight& f, const std::string& airspeed_from) {
  const auto surface = [&](const char* name, double value, double limit) {
    return located("airframe." + std::string(name) + ".limit",
                   sim_aero_messages::surface_too_small(figures(f.condition.airspeed_mps), degrees(value),
                                                        name, degrees(limit)))
        .line();
  };
  const auto at = [&](const std::string& field, const Diagnostic& why) {
    return located(field, sim_aero_messages::level_flight_impossible(figures(f.condition.airspeed_mps), why))
        .line();
  };
  const double Va = f.condition.airspeed_mps, q = 0.5 * f.density_kgm3 * Va * Va;
  switch (f.limit) {
    case TrimLimit::none: break;
    case TrimLimit::no_aileron: return at("airframe.aero.roll", sim_aero_messages::aileron_without_effect());
    case TrimLimit::no_elevator:
      return at("airframe.aero.pitch", sim_aero_messages::elevator_without_effect());
    case TrimLimit::no_thrust:
      return at("airframe.propulsion", sim_aero_messages::propeller_without_thrust());
    case TrimLimit::stall:
      return at(airspeed_from,
                sim_aero_messages::wing_stalls(figures(a.mass_kg * isa::g0 / (q * a.wing.area_m2)),
                                               figures(max_lift(a).coefficient)));
    case TrimLimit::elevator: return surface("elevator", f.input(model::elevator), a.elevator.limit_rad);
    case TrimLimit::aileron: return surface("aileron", f.input(model::aileron), a.aileron.limit_rad);
    case TrimLimit::rudder: return surface("rudder", f.input(model::rudder), a.rudder.limit_rad);
    case TrimLimit::throttle_high: return at("airframe.propulsion", sim_aero_messages::thrust_too_small());
    case TrimLimit::throttle_low: return at("airframe.propulsion", sim_aero_messages::brake_too_small());
    case TrimLimit::not_found: break;
  }
  return at(airspeed_from, sim_aero_messages::balance_impossible());
}

/// Reason why the flight ends.
inline std::string departure_words(const Plant& p) {
  const Departure d = p.departure();
  if (d == Departure::beyond_alpha || d == Departure::beyond_beta) {
    const AirData air(p.air_velocity_b());
    const bool alpha = d == Departure::beyond_alpha;
    return sim_aero_messages::flow_beyond_tables(alpha ? "angle of attack" : "sideslip",
                                                 degrees(alpha ? air.alpha : air.beta),
                                                 table_ends(p.aerodynamic(), d));
  }
  const RigidBody& x = p.state();
  return sim_aero_messages::motion_diverged(figures(x.v_n.norm()), figures(x.omega_b.norm()));
}

}  // namespace fulmar::sim
