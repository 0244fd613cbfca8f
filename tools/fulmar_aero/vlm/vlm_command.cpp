// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero vlm`.
#include <fstream>

#include "core/app/program.hpp"
#include "core/error.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/vlm/aircraft.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

struct Row {
  const char* name;
  double Six::*value;
};
constexpr std::array<Row, 6> rows{{{"CL", &Six::CL},
                                   {"CD", &Six::CD},
                                   {"CY", &Six::CY},
                                   {"Cl", &Six::Cl},
                                   {"Cm", &Six::Cm},
                                   {"Cn", &Six::Cn}}};

std::string number(double x) { return right(fixed(x, 4), 10); }

std::string table_text(const Aircraft& a) {
  const SixDerivatives& d = a.whole;
  std::string text =
      "\n           value     alpha      beta         p         q         r   aileron  elevator    rudder    "
      "  flap\n";
  for (const Row& row : rows) {
    text += "  " + padded(row.name, 4);
    for (const Six* six : {&d.value, &d.alpha, &d.beta, &d.p, &d.q, &d.r, &d.control[to_aileron],
                           &d.control[to_elevator], &d.control[to_rudder], &d.control[to_flap]})
      text += number(six->*row.value);
    text += "\n";
  }
  return text +
         "  per rad, of p b/2V, q c/2V, r b/2V; moments about body axes through the centre of gravity; CD of "
         "the lattice\n";
}

std::string summary_text(const GeometryFile& file, const Aircraft& a) {
  const Airframe& f = a.airframe;
  const auto line = [](const char* name, const std::string& text) {
    return "  " + padded(name, 22) + text + "\n";
  };
  return std::string(f.name.view()) + ": " + file.name + ", " + std::to_string(a.panels) + " panels\n" +
         line("mass", figures(f.mass_kg, 4) + " kg, centre of gravity at x = " + fixed(a.mass.centre.x(), 4) +
                          " m, z = " + fixed(a.mass.centre.z(), 4) + " m") +
         line("inertia", "xx " + figures(f.inertia.xx_kgm2, 4) + ", yy " + figures(f.inertia.yy_kgm2, 4) +
                             ", zz " + figures(f.inertia.zz_kgm2, 4) + ", xz " +
                             figures(f.inertia.xz_kgm2, 4) + " kg m^2") +
         line("cruise", figures(a.stream.airspeed_mps, 4) + " m/s, angle of attack " + degrees(a.alpha_rad) +
                            ", CL " + fixed(a.whole.value.CL, 3)) +
         line("static margin",
              fixed(-a.whole.alpha.Cm / a.whole.alpha.CL, 3) + " of the chord, neutral point at x = " +
                  fixed(a.mass.centre.x() - a.whole.alpha.Cm / a.whole.alpha.CL * f.wing.chord_m, 4) + " m") +
         line("drag", "parasite " + fixed(f.aero.parasite_drag_ratio, 4) + ", in cruise sections " +
                          fixed(a.skin_drag, 4) + ", bodies " + fixed(a.body_drag, 4) + ", wake " +
                          fixed(a.far.CD, 4) + " (e " + fixed(a.e_far, 3) + "), bound vortices " +
                          fixed(a.lattice.value.CD, 4)) +
         line("stall", degrees(f.wing.stall_alpha_rad, 1) +
                           (a.stalls_first.empty() ? ""
                                                   : ", first the " + a.stalls_first + " at " +
                                                         figures(a.stall_y_m) + " m from the middle")) +
         (a.turned.empty() ? "" : "note     " + a.turned + "\n") +
         (a.doubt.empty() ? "" : "warning  " + a.doubt + "\n");
}

std::string convergence_text(const std::vector<Convergence>& all) {
  std::string text =
      "\n  panels  CL_alpha  Cm_alpha      Cm_q      Cl_p   Cl_beta   Cn_beta      Cn_r  Cm_elev.  Cl_ail.\n";
  for (const Convergence& c : all) {
    const SixDerivatives& d = c.whole;
    text += right(std::to_string(c.panels), 8);
    for (const double x : {d.alpha.CL, d.alpha.Cm, d.q.Cm, d.p.Cl, d.beta.Cl, d.beta.Cn, d.r.Cn,
                           d.control[to_elevator].Cm, d.control[to_aileron].Cl})
      text += number(x);
    text += "\n";
  }
  return text;
}

nlohmann::json six_json(const Six& six) {
  nlohmann::json out;
  for (const Row& row : rows) out[row.name] = six.*row.value;
  return out;
}
nlohmann::json derivatives_json(const SixDerivatives& d) {
  return {{"value", six_json(d.value)},
          {"alpha", six_json(d.alpha)},
          {"beta", six_json(d.beta)},
          {"p", six_json(d.p)},
          {"q", six_json(d.q)},
          {"r", six_json(d.r)},
          {"aileron", six_json(d.control[to_aileron])},
          {"elevator", six_json(d.control[to_elevator])},
          {"rudder", six_json(d.control[to_rudder])},
          {"flap", six_json(d.control[to_flap])}};
}

nlohmann::json aircraft_json(const Aircraft& a, const std::vector<Convergence>& convergence) {
  nlohmann::json list = nlohmann::json::array();
  for (const Convergence& c : convergence)
    list.push_back({{"panels", c.panels}, {"derivatives", derivatives_json(c.whole)}});
  const Inertia& i = a.mass.inertia;
  return {{"name", a.airframe.name.view()},
          {"panels", a.panels},
          {"mass_kg", a.mass.mass_kg},
          {"centre_of_gravity_m", {a.mass.centre.x(), a.mass.centre.y(), a.mass.centre.z()}},
          {"inertia_kgm2", {{"xx", i.xx_kgm2}, {"yy", i.yy_kgm2}, {"zz", i.zz_kgm2}, {"xz", i.xz_kgm2}}},
          {"alpha_deg", a.alpha_rad / degree},
          {"stall_alpha_deg", a.airframe.wing.stall_alpha_rad / degree},
          {"oswald", a.airframe.wing.oswald_ratio},
          {"parasite_drag", a.airframe.aero.parasite_drag_ratio},
          {"derivatives", derivatives_json(a.whole)},
          {"lattice", derivatives_json(a.lattice)},
          {"turned", a.turned},
          {"warning", a.doubt},
          {"wake", {{"CL", a.far.CL}, {"CD", a.far.CD}, {"e", a.e_far}}},
          {"convergence", list}};
}

}  // namespace

int vlm_command(const VlmCommand& options) {
  const GeometryFile file = read_geometry_file(options.geometry);
  const Aircraft aircraft = aircraft_of(file);
  const std::vector<Convergence> convergence =
      options.convergence ? convergence_of(file, aircraft) : std::vector<Convergence>{};
  const std::string text = options.out.empty() ? "" : airframe_yaml(file, aircraft);
  if (options.json)
    print_object(aircraft_json(aircraft, convergence));
  else
    print_text(summary_text(file, aircraft) + table_text(aircraft) +
               (options.convergence ? convergence_text(convergence) : ""));
  if (options.out.empty()) return core::ExitCode::done;
  std::ofstream out(options.out);
  out << text;
  out.close();
  if (!out) throw core::Error(located(options.out, aero_messages::output_not_writable()));
  if (!options.json) print_text("written: " + options.out + "; look at it with fulmar aero check\n");
  return core::ExitCode::done;
}

}  // namespace fulmar::aero
