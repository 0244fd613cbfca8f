// SPDX-License-Identifier: BSD-3-Clause
// The parameters that rosflight_sim reads, and their use: fixedwing_forces_and_moments.cpp and
// standalone_dynamics.cpp.
#include "tools/fulmar_aero/import/rosflight.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/graph/yaml.hpp"
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

struct Parameter {
  double value = 0;
  Value of;
  std::string node;  ///< "/fixedwing_forces_and_moments"
};
using Parameters = std::map<std::string, Parameter>;

void gather(const Lines& lines, const core::Node& map, const std::string& node, Parameters& out) {
  for (const core::Node::Entry& entry : map.entries) {
    if (entry.value.is(core::Node::Kind::map)) {
      const bool inner = entry.key == "ros__parameters";
      gather(lines, entry.value, inner ? node : node + (entry.key[0] == '/' ? "" : "/") + entry.key, out);
      continue;
    }
    if (!entry.value.is(core::Node::Kind::scalar)) continue;
    const std::size_t line = std::size_t(std::max(1, entry.line)) - 1;
    const std::string text = trimmed(entry.value.text);
    if (text.find_first_not_of("0123456789.+-eE") != std::string::npos || text.empty()) {
      const std::size_t comma = text.find(',');
      const bool decimal_comma =
          comma != std::string::npos && text.find_first_not_of("0123456789.+-eE,") == std::string::npos;
      if (begins(entry.key, "C_") || begins(entry.key, "wing_") || decimal_comma)
        refuse(lines.where(line), fulmar::located(entry.key, aero_messages::result_number_expected(text)));
      continue;
    }
    const double value = number_at(lines_of(lines.where(line).text(), text), 0, 0, entry.key);
    Parameter parameter{value, {value, lines.place(line, entry.key)}, node};
    out.emplace(entry.key, parameter);
  }
}

/// "#Jx .27   #orig Jx: 0.24855": value in a comment.
std::optional<Value> in_comment(const Lines& lines, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::string text = trimmed(lines.all[i]);
    if (text.empty() || text[0] != '#') continue;
    for (const std::string& name : names) {
      const std::string first = trimmed(text.substr(1));
      if (!begins(first, name)) continue;
      const std::size_t number = first.find_first_not_of(" :=", name.size());
      if (number == std::string::npos || number == name.size()) continue;
      if (std::string("0123456789.+-").find(first[number]) == std::string::npos) continue;
      const std::vector<double> values = numbers_at(lines_of(lines.file, first), 0, number);
      if (!values.empty()) return Value(values[0], lines.place(i, name + ", in a comment"));
    }
  }
  return {};
}

/// "trim at about 15 m/s", "start alpha is 3deg up"
std::optional<double> in_words(const Lines& lines, const std::string& words) {
  const auto line = lines.find(words);
  if (!line || trimmed(lines.all[*line])[0] != '#') return {};
  const std::string& text = lines.all[*line];
  const std::size_t digit = text.find_first_of("0123456789", text.find(words) + words.size());
  if (digit == std::string::npos) return {};
  return numbers_at(lines, *line, digit).at(0);
}

const Parameter* find(const Parameters& all, const std::string& key) {
  const auto found = all.find(key);
  return found == all.end() ? nullptr : &found->second;
}

Value needed(const Lines& lines, const Parameters& all, const std::string& key) {
  if (const Parameter* const found = find(all, key)) return found->of;
  refuse({lines.file, int(lines.all.size())}, aero_messages::key_missing(key));
}

constexpr std::array<const char*, forces> ros_names{"L", "D", "Y", "ell", "m", "n"};
constexpr std::array<const char*, 9> ros_terms{"O", "alpha",   "beta",    "p",      "q",
                                               "r", "delta_a", "delta_e", "delta_r"};

/// Parameters that rosflight_sim reads and the file lacks count as 0.
void report_missing(const Parameters& all, Aircraft& out) {
  std::string missing;
  for (const char* name : {"C_L_O", "C_L_alpha", "C_L_q", "C_L_delta_e", "C_m_O", "C_m_alpha", "C_m_q",
                           "C_m_delta_e", "C_Y_beta", "C_ell_beta", "C_ell_p", "C_ell_r", "C_ell_delta_a",
                           "C_n_beta", "C_n_p", "C_n_r", "C_n_delta_a", "C_n_delta_r", "C_Y_delta_r"}) {
    std::string other = name;  // some files write zero with a digit
    if (other.back() == 'O') other.back() = '0';
    if (!find(all, name) && !find(all, other)) missing += std::string(missing.empty() ? "" : ", ") + name;
  }
  if (!missing.empty())
    out.warnings.push_back("not in the file, and counted as 0: " + missing + "; is it cut off?");
}

void take_coefficients(const Lines& lines, const Parameters& all, Aircraft& out) {
  report_missing(all, out);
  for (std::size_t force = 0; force < forces; ++force)
    for (std::size_t term = 0; term < ros_terms.size(); ++term) {
      const Parameter* found = find(all, std::string("C_") + ros_names[force] + "_" + ros_terms[term]);
      if (!found && term == t_zero) found = find(all, std::string("C_") + ros_names[force] + "_0");
      if (!found || found->value == 0) continue;
      // read by the simulator: longitudinal terms of lift, drag and pitch, lateral ones of the others
      const bool longitudinal = term == t_zero || term == t_alpha || term == t_q || term == t_elevator;
      const bool lateral_force = force == side || force == roll || force == yaw;
      const bool drag_of_polar = force == drag && (term == t_zero || term == t_alpha || term == t_p);
      if (drag_of_polar || longitudinal == lateral_force) continue;
      out.c[force][term] = found->of;
    }
  out.parasite = needed(lines, all, "C_D_p");
  out.parasite.from += ", parasite drag (its p is not the roll rate)";
  out.converted_parasite = out.parasite.x;
  const Parameter* const polar = find(all, "C_D_O");
  if (!polar || polar->value == 0) return;
  std::string note =
      "C_D_O " + figures(polar->value) + " is of another polar and is not read by rosflight_sim";
  if (out.parasite.x == 0) {
    out.warnings.push_back(note + ", and C_D_p is 0: the aircraft has no parasite drag there");
    return;
  }
  out.notes.push_back(note + "; C_D_p is taken");
}

void turn_column(Aircraft& a, Term term, const char* name, const char* why) {
  for (std::size_t force = 0; force < forces; ++force) {
    Value& value = a.c[force][term];
    if (!value.known) continue;
    value.x = -value.x;
    value.from += ", sign turned";
  }
  a.warnings.push_back(std::string(name) + ": " + why + "; the column is turned as a whole");
}

void mend_signs(Aircraft& a) {
  if (a.c[roll][t_aileron].x < 0)
    turn_column(a, t_aileron, "aileron", "C_ell_delta_a is negative, and positive aileron rolls right");
  if (a.c[pitch][t_elevator].x > 0)
    turn_column(a, t_elevator, "elevator",
                "C_m_delta_e is positive, and positive elevator takes the nose down");
  if (a.c[yaw][t_rudder].x > 0)
    turn_column(a, t_rudder, "rudder", "C_n_delta_r is positive, and positive rudder takes the nose left");
  Value &CL = a.c[lift][t_elevator], &CD = a.c[drag][t_elevator];
  if (!(CL.x < 0)) return;
  a.warnings.push_back("C_L_delta_e " + figures(CL.x) +
                       " is negative with a tail behind the wing: it is CZ, which points down; turned" +
                       (CD.x < 0 ? ", as is C_D_delta_e, which is CX" : ""));
  CL.x = -CL.x;
  CL.from += ", sign turned";
  if (CD.x < 0) {
    CD.x = -CD.x;
    CD.from += ", sign turned";
  }
}

void report_doubts(const Lines& lines, const Parameters& all, Aircraft& a) {
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::string text = lower(lines.all[i]);
    const bool doubt = text.find("sign") != std::string::npos ||
                       text.find("double check") != std::string::npos ||
                       text.find("convention") != std::string::npos;
    if (doubt && text.find('#') != std::string::npos)
      a.notes.push_back(fulmar::located(
          lines.place(i), aero_messages::sign_doubted(trimmed(lines.all[i].substr(lines.all[i].find('#'))))));
  }
  if (a.c[roll][t_beta].x > 0)
    a.warnings.push_back(
        "C_ell_beta is positive: it rolls into the sideslip, as with negative dihedral; left as it is");
  const double zero = a.c[lift][t_zero].x, slope = a.c[lift][t_alpha].x;
  if (const auto start = in_words(lines, "start alpha is"); start && slope > 0 && zero / slope > 6 * degree)
    a.warnings.push_back(aero_messages::lift_at_start_alpha(figures(zero), figures(*start),
                                                            figures(zero - slope * *start * degree)));
  for (const auto& [key, parameter] : all) {
    if (!begins(key, "C_L_alpha")) continue;
    if (parameter.node != "/fixedwing_forces_and_moments" && parameter.node != "/**")
      a.notes.push_back(aero_messages::parameter_node_unknown(parameter.node));
  }
}

std::string motor(const Lines& lines, const Parameters& all) {
  std::string out = "propulsion:\n";
  for (const auto& [key, field, unit] : {std::array<const char*, 3>{"D_prop", "propeller_diameter", " m"},
                                         {"CT_0", "ct0", ""},
                                         {"CT_1", "ct1", ""},
                                         {"CT_2", "ct2", ""},
                                         {"CQ_0", "cq0", ""},
                                         {"CQ_1", "cq1", ""},
                                         {"CQ_2", "cq2", ""},
                                         {"KQ", "torque_constant", ""},
                                         {"R_motor", "resistance", " ohm"},
                                         {"I_0", "no_load", " A"},
                                         {"V_max", "battery", " V"}}) {
    const Value value = needed(lines, all, key);
    out +=
        padded(std::string("  ") + field + ": " + figures(value.x, 8) + unit, 30) + " # " + value.from + "\n";
  }
  return out + "  time_constant: 0.05 s          # assumption: the source has no spin-up\n";
}

std::string surface_words(const Parameters& all) {
  const auto of = [&](const char* key, double otherwise) {
    const Parameter* const found = find(all, key);
    return found ? found->value : otherwise;
  };
  return "limit: " + figures(of("max_elevator_deflection_angle", 40)) +
         " deg, rate_limit: 500 deg/s, time_constant: " + figures(of("servo_tau", 0.02)) + " s";
}

Value inertia_of(const Lines& lines, const Parameters& all, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const Parameter* const found = find(all, name)) return found->of;
  return in_comment(lines, names).value_or(Value());
}

}  // namespace

bool is_rosflight(const Lines& lines) { return lines.has("ros__parameters") && lines.has("C_L_alpha"); }

Aircraft rosflight_aircraft(const Lines& lines, bool mend) {
  core::Report report;
  const core::Node root = core::parse_yaml(
      std::make_shared<core::SourceFile>(core::SourceFile{lines.file, lines.file, lines.text}), report);
  report.throw_if_any();
  Parameters all;
  gather(lines, root, "", all);
  Aircraft a;
  a.sources.push_back("ROSflight parameters: " + lines.place(0).substr(0, lines.place(0).rfind(':')));
  std::string name = lines.place(0);
  name = name.substr(0, std::min(name.find("_dynamics"), name.find('.')));
  a.name = name;
  a.area_m2 = needed(lines, all, "wing_s");
  a.span_m = needed(lines, all, "wing_b");
  a.chord_m = needed(lines, all, "wing_c");
  for (const Value* value : {&a.area_m2, &a.span_m, &a.chord_m})
    if (!(value->x > 0))
      throw core::Error(located(value->from, aero_messages::positive_value_expected(figures(value->x))));
  a.oswald.from = "in rosflight_sim's code; wing_epsilon is not read";
  if (const Parameter* const mass = find(all, "mass")) a.mass_kg = mass->of;
  a.xx = inertia_of(lines, all, {"Jxx", "Jx"});
  a.yy = inertia_of(lines, all, {"Jyy", "Jy"});
  a.zz = inertia_of(lines, all, {"Jzz", "Jz"});
  a.xz = inertia_of(lines, all, {"Jxz"});
  if (!a.yy.known || !a.zz.known) a.xx.known = false;
  if (a.xx.known && !a.xz.known) {
    a.xz = {0, "not in the file"};
    a.warnings.push_back("Jxz is not in the file, and counted as 0");
  }
  if (!lines.text.empty() && lines.text.back() != '\n')
    a.warnings.push_back("its last line has no end: is it cut off?");
  a.stall_alpha = {15 * degree, "assumption; wing_alpha0 is not read by rosflight_sim, which does not stall"};
  if (const Parameter* const M = find(all, "wing_M"))
    a.stall_sharpness = M->of;
  else
    a.stall_sharpness = {50, "assumption"};
  if (find(all, "CT_0")) {
    a.parts = motor(lines, all);
    a.surfaces = surface_words(all);
  }
  take_coefficients(lines, all, a);
  if (const auto speed = in_words(lines, "trim at about")) a.cruise_mps = *speed;
  report_doubts(lines, all, a);
  if (mend) mend_signs(a);
  return a;
}

}  // namespace fulmar::aero::imports
