// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/program.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

std::string line(const std::string& name, const std::string& value, const std::string& more = "") {
  return "  " + padded(name, 18) + (more.empty() ? value : padded(value, 14) + more) + "\n";
}

std::string surface_line(const char* name, double value, double limit) {
  return line(name, degrees(value), "of +-" + degrees(limit, 1));
}

std::string trim_text(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& f) {
  const Airframe& a = file.airframe;
  const FlightForces forces = forces_of(model, f);
  const SteadyCondition& c = f.condition;
  std::string text = file.title() + ": " + condition_words(c, model.altitude_m()) + ", density " +
                     fixed(f.density_kgm3, 4) + " kg/m3\n";
  text += line("angle of attack", degrees(f.alpha_rad), "stall at " + degrees(a.wing.stall_alpha_rad, 1));
  text += line("sideslip", degrees(f.beta_rad));
  text += line("roll, pitch", degrees(f.x(model::roll)), degrees(f.x(model::pitch)));
  if (c.climb_rad != 0)
    text += line("climb", degrees(c.climb_rad), fixed(c.airspeed_mps * std::sin(c.climb_rad), 2) + " m/s");
  if (c.turn != Turn::none)
    text += line("turn", fixed(f.turn_radps / degree, 2) + " deg/s",
                 "radius " + fixed(c.airspeed_mps * std::cos(c.climb_rad) / f.turn_radps, 1) +
                     " m, load factor " + fixed(forces.load_factor, 2));
  text += surface_line("aileron", f.input(model::aileron), a.aileron.limit_rad);
  text += surface_line("elevator", f.input(model::elevator), a.elevator.limit_rad);
  text += surface_line("rudder", f.input(model::rudder), a.rudder.limit_rad);
  text += line(
      "throttle", fixed(f.input(model::throttle), 3),
      "propeller " + fixed(f.propeller_radps, 0) + " rad/s, torque " + fixed(forces.torque_nm, 3) + " N m");
  text +=
      line("lift, drag", fixed(forces.lift_newton, 2) + " N",
           fixed(forces.drag_newton, 2) + " N, ratio " + fixed(forces.lift_newton / forces.drag_newton, 1));
  text += line("CL, CD", fixed(forces.lift_ratio, 3), fixed(forces.drag_ratio, 4));
  return text +
         line("side, thrust", fixed(forces.side_newton, 2) + " N", fixed(forces.thrust_newton, 2) + " N");
}

}  // namespace

int trim_command(const FlightOptions& options) {
  const AirframeFile file = read_airframe_file(options.airframe);
  const AircraftModel model(file.airframe, options.altitude_m());
  const SteadyFlight flight = fly(model, options.condition(file.airframe));
  if (options.json) {
    nlohmann::json object = flight.found() ? flight_json(model, flight) : nlohmann::json::object();
    object["airframe"] = file.title();
    object["found"] = flight.found();
    object["reason"] = flight.found() ? nlohmann::json() : nlohmann::json(no_flight(file, model, flight));
    print_object(object);
  } else if (flight.found()) {
    print_text(trim_text(file, model, flight));
  } else {
    std::fprintf(stderr, "%s\n", no_flight(file, model, flight).c_str());
  }
  return flight.found() ? core::ExitCode::done : core::ExitCode::failed;
}

}  // namespace fulmar::aero
