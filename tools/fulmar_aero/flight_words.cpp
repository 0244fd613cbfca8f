// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/flight_words.hpp"

#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// CL for the load factor of the flight.
double lift_needed(const AircraftModel& model, const SteadyFlight& f) {
  const Airframe& a = model.airframe();
  const double Va = f.condition.airspeed_mps;
  return std::cos(f.condition.climb_rad) / std::cos(f.x(model::roll)) * a.mass_kg * isa::g0 /
         (0.5 * f.density_kgm3 * Va * Va * a.wing.area_m2);
}

std::string stall_words(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& f) {
  const MostLift most = max_lift(file.airframe);
  const double needed = lift_needed(model, f);
  std::string hint;
  if (needed > most.coefficient && most.coefficient > 0)
    hint = aero_messages::stall_airspeed_required(
               fixed(f.condition.airspeed_mps * std::sqrt(needed / most.coefficient), 1))
               .line();
  return aero_messages::wing_stalls(fixed(needed, 2), fixed(most.coefficient, 2), degrees(most.alpha_rad, 1),
                                    hint, file.where("wing.stall_alpha_rad").text())
      .line();
}

std::string surface_words(const AirframeFile& file, const char* name, double value, double limit) {
  return aero_messages::surface_throw_exceeded(degrees(value, 1), name, degrees(limit, 1),
                                               file.where(std::string(name) + ".limit_rad").text())
      .line();
}

std::string thrust_words(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& f,
                         bool high) {
  const double Va = f.condition.airspeed_mps, rho = f.density_kgm3;
  const Propeller& propeller = model.propeller();
  const double all = model.propellers().along();
  const double needed = f.residual < 1e-9
                            ? all * propeller.thrust(f.propeller_radps, Va, rho)
                            : detail::thrust_needed(model, f.condition, lift_needed(model, f), rho);
  const double there = all * propeller.thrust(propeller.steady_speed(high ? 1 : 0, Va, rho), Va, rho);
  const std::string place = " (propulsion: " + file.where("propulsion").text() + ")";
  if (high) return aero_messages::thrust_insufficient(fixed(needed, 1), fixed(there, 1), place).line();
  return aero_messages::braking_insufficient(fixed(-needed, 1), fixed(-there, 1), place).line();
}

}  // namespace

std::string condition_words(const SteadyCondition& c, double altitude_m) {
  const char* const path = c.climb_rad > 1e-9 ? "climb" : c.climb_rad < -1e-9 ? "descent" : "level flight";
  std::string text = c.turn == Turn::none ? std::string("steady ") + path
                     : c.climb_rad == 0   ? std::string("steady level turn")
                                          : std::string("steady turning ") + path;
  if (c.climb_rad != 0) text += " of " + degrees(std::abs(c.climb_rad), 1);
  if (c.turn == Turn::bank) text += " with " + degrees(c.turn_by, 1) + " of bank";
  if (c.turn == Turn::radius) text += " of " + fixed(c.turn_by, 1) + " m radius";
  return aero_messages::flight_condition(text, figures(c.airspeed_mps, 4), fixed(altitude_m, 0)).line();
}

std::string limit_words(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& f) {
  const Airframe& a = file.airframe;
  const auto missing = [&](const MessageText<1>& what, const char* field) {
    return what(std::string(field) + ": " + file.where(field).text()).line();
  };
  switch (f.limit) {
    case TrimLimit::none: break;
    case TrimLimit::no_aileron:
      return missing(aero_messages::aileron_without_roll, "aero.roll.aileron_ratio");
    case TrimLimit::no_elevator:
      return missing(aero_messages::elevator_without_pitch, "aero.pitch.elevator_ratio");
    case TrimLimit::no_thrust:
      return missing(aero_messages::propeller_without_thrust, "propulsion.ct0_ratio");
    case TrimLimit::stall: return stall_words(file, model, f);
    case TrimLimit::elevator:
      return surface_words(file, "elevator", f.input(model::elevator), a.elevator.limit_rad);
    case TrimLimit::aileron:
      return surface_words(file, "aileron", f.input(model::aileron), a.aileron.limit_rad);
    case TrimLimit::rudder: return surface_words(file, "rudder", f.input(model::rudder), a.rudder.limit_rad);
    case TrimLimit::throttle_high: return thrust_words(file, model, f, true);
    case TrimLimit::throttle_low: return thrust_words(file, model, f, false);
    case TrimLimit::not_found: return aero_messages::equilibrium_missing(file.name).line();
  }
  return "";
}

std::string no_flight(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& f) {
  return located(file.name, aero_messages::flight_impossible(condition_words(f.condition, model.altitude_m()),
                                                             limit_words(file, model, f), ""))
      .line();
}

FlightForces forces_of(const AircraftModel& model, const SteadyFlight& f) {
  const Airframe& a = model.airframe();
  const double Va = f.condition.airspeed_mps, rho = f.density_kgm3, qS = 0.5 * rho * Va * Va * a.wing.area_m2;
  const Eigen::Vector3d v_b = f.x.segment<3>(model::u), omega_b = f.x.segment<3>(model::p);
  const Load load = model.aerodynamic().load(v_b, omega_b, f.deflections(), rho);
  const AirData air(v_b);
  FlightForces out;
  out.lift_newton = load.force_b.x() * air.sin_alpha - load.force_b.z() * air.cos_alpha;
  out.drag_newton = -load.force_b.x() * air.cos_alpha - load.force_b.z() * air.sin_alpha;
  out.side_newton = load.force_b.y();
  out.thrust_newton = model.propellers().along() * model.propeller().thrust(f.propeller_radps, Va, rho);
  out.torque_nm = model.propeller().torque(f.propeller_radps, Va, rho);
  out.lift_ratio = out.lift_newton / qS;
  out.drag_ratio = out.drag_newton / qS;
  out.load_factor = -load.force_b.z() / (a.mass_kg * isa::g0);
  return out;
}

nlohmann::json flight_json(const AircraftModel& model, const SteadyFlight& f) {
  const FlightForces forces = forces_of(model, f);
  const SteadyCondition& c = f.condition;
  const double across = c.airspeed_mps * std::cos(c.climb_rad);
  nlohmann::json radius;
  if (c.turn != Turn::none) radius = across / f.turn_radps;
  return {{"airspeed_mps", c.airspeed_mps},
          {"altitude_m", model.altitude_m()},
          {"density_kgm3", f.density_kgm3},
          {"climb_deg", c.climb_rad / degree},
          {"climb_rate_mps", c.airspeed_mps * std::sin(c.climb_rad)},
          {"alpha_deg", f.alpha_rad / degree},
          {"beta_deg", f.beta_rad / degree},
          {"roll_deg", f.x(model::roll) / degree},
          {"pitch_deg", f.x(model::pitch) / degree},
          {"turn_degps", f.turn_radps / degree},
          {"turn_radius_m", radius},
          {"aileron_deg", f.input(model::aileron) / degree},
          {"elevator_deg", f.input(model::elevator) / degree},
          {"rudder_deg", f.input(model::rudder) / degree},
          {"throttle_frac", f.input(model::throttle)},
          {"propeller_radps", f.propeller_radps},
          {"lift_newton", forces.lift_newton},
          {"drag_newton", forces.drag_newton},
          {"side_newton", forces.side_newton},
          {"thrust_newton", forces.thrust_newton},
          {"lift_coefficient_ratio", forces.lift_ratio},
          {"drag_coefficient_ratio", forces.drag_ratio},
          {"load_factor_ratio", forces.load_factor},
          {"residual", f.residual}};
}

}  // namespace fulmar::aero
