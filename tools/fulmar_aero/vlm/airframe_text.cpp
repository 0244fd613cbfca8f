// SPDX-License-Identifier: BSD-3-Clause
// The airframe file of a drawing.
#include <cmath>

#include "core/types/text.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/vlm/aircraft.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// A node of the drawing, unchanged, on one line.
std::string flow_text(const core::Node& node) {
  std::string out;
  if (node.is(core::Node::Kind::map)) {
    for (const core::Node::Entry& e : node.entries)
      out += (out.empty() ? "" : ", ") + e.key + ": " + flow_text(e.value);
    return "{" + out + "}";
  }
  if (node.is(core::Node::Kind::sequence)) {
    for (const core::Node& item : node.items) out += (out.empty() ? "" : ", ") + flow_text(item);
    return "[" + out + "]";
  }
  return node.quoted ? "\"" + node.text + "\"" : node.text;
}

bool says(const core::Node* map, const std::string& name) {
  if (!map) return false;
  for (const core::Node::Entry& e : map->entries)
    if (e.key == name || e.key.rfind(name + "_", 0) == 0) return true;
  return false;
}

/// A section with further entries behind those of the drawing.
std::string section(const core::Node& root, const char* key,
                    const std::vector<std::pair<std::string, std::string>>& more = {}) {
  const core::Node* const node = root.find(key);
  if (!node && more.empty()) return "";
  std::string text = node ? flow_text(*node) : "{}";
  text.pop_back();
  for (const auto& [name, value] : more)
    if (!says(node, name)) text += (text == "{" ? "" : ", ") + name + ": " + value;
  return std::string(key) + ": " + text + "}\n";
}

std::string derivatives_text(const char* name, const Derivatives& d) {
  std::string out;
  const auto put = [&](const char* key, double value) {
    if (value != 0) out += (out.empty() ? "" : ", ") + std::string(key) + ": " + figures(value, 5);
  };
  put("zero", d.zero_ratio);
  put("alpha", d.alpha_ratio);
  put("beta", d.beta_ratio);
  put("p", d.p_ratio);
  put("q", d.q_ratio);
  put("r", d.r_ratio);
  put("aileron", d.aileron_ratio);
  put("elevator", d.elevator_ratio);
  put("rudder", d.rudder_ratio);
  put("flap", d.flap_ratio);
  return out.empty() ? "" : "  " + padded(std::string(name) + ":", 7) + "{" + out + "}\n";
}

std::string inertia_text(const Inertia& i) {
  return "{xx_kgm2: " + figures(i.xx_kgm2, 5) + ", yy_kgm2: " + figures(i.yy_kgm2, 5) +
         ", zz_kgm2: " + figures(i.zz_kgm2, 5) + ", xz_kgm2: " + figures(i.xz_kgm2, 5) + "}";
}

std::string aero_text(const GeometryFile& file, const Aircraft& a) {
  const Geometry& g = *file.geometry;
  const Airframe& f = a.airframe;
  const std::string e_source =
      g.oswald_ratio > 0 ? "the drawing's" : "fit of wake and sections over the speeds of limits";
  const std::string stall = a.stalls_first.empty()
                                ? "no section reaches its most lift before"
                                : "the first section with its most lift: " + a.stalls_first + ", " +
                                      figures(a.stall_y_m) + " m from the middle";
  std::string text = "wing:\n  area_m2: " + figures(f.wing.area_m2, 6) +
                     "\n  span: " + figures(f.wing.span_m, 6) + " m\n  chord: " + figures(f.wing.chord_m, 6) +
                     " m\n  oswald: " + figures(f.wing.oswald_ratio, 4) + "  # " + e_source +
                     "\n  stall_alpha: " + fixed(f.wing.stall_alpha_rad / degree, 2) + " deg  # " + stall +
                     "\n  stall_sharpness: 50  # assumption, as of other aircraft\n";
  text += "# Vortex lattice, " + std::to_string(a.panels) + " panels, at " + degrees(a.alpha_rad) +
          "; zero: carried back to no angle.";
  if (!g.bodies.empty()) text += " Bodies in pitch.alpha and yaw.beta: NACA Report 184.";
  if (!g.propellers.empty())
    text += "\n# Propellers in oblique flow, at " + figures(a.propeller_radps, 4) +
            " rad/s: in alpha, beta, q and r, NACA Report 820.";
  if (!a.turned.empty()) text += "\n# " + a.turned + ".";
  if (!a.doubt.empty()) text += "\n# WARNING: " + a.doubt;
  text += "\naero:\n  parasite_drag: " + figures(f.aero.parasite_drag_ratio, 4) + "  # sections " +
          figures(a.skin_drag, 3) + " in cruise, bodies " + figures(a.body_drag, 3) + "; polars and plates\n";
  text += derivatives_text("lift", f.aero.lift) + derivatives_text("drag", f.aero.drag) +
          derivatives_text("side", f.aero.side) + derivatives_text("roll", f.aero.roll) +
          derivatives_text("pitch", f.aero.pitch) + derivatives_text("yaw", f.aero.yaw);
  return text;
}

}  // namespace

std::string airframe_yaml(const GeometryFile& file, const Aircraft& aircraft) {
  const Airframe& a = aircraft.airframe;
  AirframeFile trimmed;
  trimmed.name = file.name;
  trimmed.airframe = a;
  trimmed.root = file.root;
  const AircraftModel model(a, file.geometry->altitude_m);
  const SteadyFlight flight = fly(model, {.airspeed_mps = a.limits.airspeed_cruise_mps});
  if (!flight.found()) throw core::Error(no_flight(trimmed, model, flight));

  const double least =
      1.2 * std::sqrt(isa::g0 * a.mass_kg /
                      (0.5 * aircraft.stream.density_kgm3 * a.wing.area_m2 * max_lift(a).coefficient));
  const auto trim = [&](int input) {
    return std::pair<std::string, std::string>("trim", figures(flight.input(input), 4) + " rad");
  };
  const std::string folder_free = file.name.substr(file.name.find_last_of('/') + 1);
  std::string text = "# SPDX-License-Identifier: BSD-3-Clause\n# " + std::string(a.name.view()) +
                     ": made by fulmar aero vlm from " + folder_free +
                     ". Signs and equations: Beard & McLain, Small Unmanned\n# Aircraft, chapter 4. Angles "
                     "in coefficients are radians.\n";
  text += "name: " + std::string(a.name.view()) + "\nmass: " + figures(a.mass_kg, 5) +
          " kg  # sum of the parts, with the centre of gravity at x = " + fixed(aircraft.mass.centre.x(), 4) +
          " m, z = " + fixed(aircraft.mass.centre.z(), 4) +
          " m of the drawing\ninertia: " + inertia_text(a.inertia) + "\n";
  text += aero_text(file, aircraft) + "# As the drawing has them:\n" + section(file.root, "propulsion");
  if (a.mixer != Mixer::conventional)
    text += a.mixer == Mixer::elevons ? "mixer: elevons\n" : "mixer: v_tail\n";
  text += "# Trims: steady level flight at " + figures(a.limits.airspeed_cruise_mps, 4) + " m/s, " +
          fixed(file.geometry->altitude_m, 0) + " m above the sea; they cancel propeller torque, too.\n";
  text += section(file.root, "aileron", {trim(model::aileron)}) +
          section(file.root, "elevator", {trim(model::elevator)}) +
          section(file.root, "rudder", {trim(model::rudder)}) + section(file.root, "flap");
  // the least airspeed: 1.2 times that of the most lift with the elevator holding the pitching moment
  text += section(file.root, "limits",
                  {{"airspeed_min", figures(least, 3) + " m/s"},
                   {"throttle_cruise", figures(flight.input(model::throttle), 4)}});
  return text + section(file.root, "gear");
}

}  // namespace fulmar::aero
