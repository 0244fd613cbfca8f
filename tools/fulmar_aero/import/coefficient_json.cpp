// SPDX-License-Identifier: BSD-3-Clause
// A set of Beard & McLain's coefficients as JSON, in the names of Gryte et al. (ICUAS 2018) and pyfly:
// Skywalker X8.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

class JsonSet {
 public:
  explicit JsonSet(const Lines& lines) : lines_(lines) {
    try {
      root_ = nlohmann::json::parse(lines.text);
    } catch (const nlohmann::json::parse_error& fault) {
      const std::string read = lines.text.substr(0, fault.byte > 0 ? fault.byte - 1 : 0);
      refuse(lines.where(std::size_t(std::count(read.begin(), read.end(), '\n'))),
             aero_messages::json_invalid());
    }
    if (!root_.is_object()) throw core::Error(located(lines.file, aero_messages::json_object_expected()));
  }
  bool has(const std::string& key) const { return root_.contains(key); }
  Value value(const std::string& key, double factor = 1) const {
    const auto line = lines_.find("\"" + key + "\"");
    const core::Where where{lines_.file, line ? int(*line) + 1 : 0};
    if (!has(key)) throw core::Error(located(lines_.file, aero_messages::key_missing(key)));
    if (!root_[key].is_number())
      refuse(where, fulmar::located(key, aero_messages::number_expected(root_[key].dump())));
    return {root_[key].get<double>() * factor, lines_.place(line.value_or(0), key)};
  }

 private:
  const Lines& lines_;
  nlohmann::json root_;
};

constexpr std::array<const char*, forces> json_names{"L", "D", "Y", "l", "m", "n"};
constexpr std::array<const char*, 9> json_terms{"0", "alpha",   "beta",    "p",      "q",
                                                "r", "delta_a", "delta_e", "delta_r"};

std::string row(const char* key, const Value& value) {
  return padded(std::string("    ") + key + ": " + figures(value.x, 7), 30) + " # " + value.from + "\n";
}

}  // namespace

bool is_coefficient_json(const Lines& lines) {
  return begins(trimmed(lines.text), "{") && lines.has("\"C_L_alpha\"") && lines.has("\"C_l_p\"");
}

Aircraft json_aircraft(const Lines& lines) {
  const JsonSet set(lines);
  Aircraft a;
  a.sources.push_back("JSON of coefficients: " + lines.place(0).substr(0, lines.place(0).rfind(':')));
  a.name = lines.place(0).substr(0, std::min(lines.place(0).find("_param"), lines.place(0).find('.')));
  a.area_m2 = set.value("S_wing");
  a.span_m = set.value("b");
  a.chord_m = set.value("c");
  for (const Value* value : {&a.area_m2, &a.span_m, &a.chord_m})
    if (!(value->x > 0))
      throw core::Error(located(value->from, aero_messages::positive_value_expected(figures(value->x))));
  a.mass_kg = set.value("mass");
  a.xx = set.value("Jx");
  a.yy = set.value("Jy");
  a.zz = set.value("Jz");
  a.xz = set.value("Jxz");
  if (set.has("e")) a.oswald = set.value("e");
  a.stall_alpha = set.has("a_0") ? set.value("a_0") : Value(15 * degree, "assumption");
  a.stall_sharpness = set.has("M") ? set.value("M") : Value(50, "assumption");
  for (std::size_t force = 0; force < forces; ++force)
    for (std::size_t term = 0; term < json_terms.size(); ++term) {
      const std::string key = std::string("C_") + json_names[force] + "_" + json_terms[term];
      if (!set.has(key) || set.value(key).x == 0 || (force == drag && term != t_q)) continue;
      a.c[force][term] = set.value(key);
    }
  a.parasite = set.value("C_D_p");
  a.converted_parasite = a.parasite.x;
  // its simulator has q b/(2 Va) and multiplies by c: with the chord of the definition the number is larger
  // by b/c
  if (set.has("C_m_q")) {
    const double factor = a.span_m.x / a.chord_m.x;
    if (set.value("C_m_q").x > -4) {
      a.c[pitch][t_q] = set.value("C_m_q", factor);
      a.c[pitch][t_q].from += ", which belongs with the span b/2V; times b/c";
      a.notes.push_back("C_m_q belongs with the span in its source: " + figures(set.value("C_m_q").x) +
                        " becomes " + figures(a.c[pitch][t_q].x) + " with the chord");
    }
  }
  std::string squared;
  for (const auto& [key, field] : {std::pair{"C_D_beta2", "beta"}, {"C_D_delta_e", "elevator"}})
    if (set.has(key) && set.value(key).x != 0) squared += row(field, set.value(key));
  if (!squared.empty()) a.more_aero += "  drag_squared:\n" + squared;
  if (set.has("C_D_beta1") && set.value("C_D_beta1").x != 0) a.c[drag][t_beta] = set.value("C_D_beta1");
  if (set.has("C_m_fp")) a.more_aero += "  pitch_stalled: " + figures(set.value("C_m_fp").x, 7) + "\n";
  if (set.has("C_D_0"))
    a.notes.push_back(
        "C_D_0, C_D_alpha1 and C_D_alpha2 are of another polar, which would count drag twice; left out");
  const bool rudder = a.c[yaw][t_rudder].known;
  if (!rudder) a.elevons = true;
  if (set.has("S_prop")) {
    const auto text = [&](const char* key) { return figures(set.value(key).x, 8); };
    a.parts = "propulsion:\n  disc: {area: " + text("S_prop") + " m^2, efficiency: " + text("C_prop") +
              ", exit_speed: " + text("k_motor") + " m/s, torque: " + text("k_T_P") +
              ", speed: " + text("k_Omega") +
              " rad/s}\n  battery: 14.8 V                # assumption\n  time_constant: 0.2 s           # "
              "throttle of its simulator\n" +
              (a.elevons ? "mixer: elevons\n" : "");
    a.surfaces = a.elevons ? "limit: 30 deg, min: -30 deg, max: 35 deg, rate_limit: 3.49 rad/s, "
                             "natural_frequency: 100 rad/s, damping: 1.71"
                           : "limit: 30 deg, rate_limit: 3.49 rad/s";
    a.cruise_mps = 18;
    a.notes.push_back("cruise is 18 m/s, as its authors fly the X8");
    a.notes.push_back("throws and servos are those of the X8's simulator (pyfly)");
  }
  return a;
}

}  // namespace fulmar::aero::imports
