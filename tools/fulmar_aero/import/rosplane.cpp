// SPDX-License-Identifier: BSD-3-Clause
// ROSplane 2.0: parameters of its nodes `controller`, `path_follower` and `path_manager`, and mission files
// (a map whose key `wp` is repeated).
#include "tools/fulmar_aero/import/rosplane.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "tools/fulmar_aero/import/lines.hpp"
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr std::size_t max_files = 500;
constexpr double full_deflection = 40 * degree;  // rosflight_sim: deflection of a command of 1

std::vector<Lines> yaml_files(const std::string& folder) {
  std::error_code fault;
  if (!std::filesystem::is_directory(folder, fault))
    throw core::Error(located(folder, aero_messages::rosplane_folder_expected()));
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, fault)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && (ending == ".yaml" || ending == ".yml"))
      names.push_back(entry.path().string());
    if (names.size() > max_files) throw core::Error(located(folder, aero_messages::too_many_files()));
  }
  std::sort(names.begin(), names.end());
  std::vector<Lines> all;
  for (const std::string& name : names)
    if (std::filesystem::file_size(name, fault) > 0) all.push_back(read_lines(name));
  return all;
}

/// "key: number # comment" anywhere in a file.
struct Setting {
  double value = 0;
  std::size_t line = 0;
};
std::map<std::string, Setting> settings(const Lines& lines) {
  std::map<std::string, Setting> out;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::string text = trimmed(lines.all[i]);
    const std::size_t colon = text.find(':');
    if (text.empty() || text[0] == '#' || colon == std::string::npos) continue;
    const std::string value = trimmed(text.substr(colon + 1));
    if (value.empty() || std::string("0123456789.+-").find(value[0]) == std::string::npos) continue;
    const std::size_t at = lines.all[i].find(value, lines.all[i].find(':'));
    out.emplace(trimmed(text.substr(0, colon)), Setting{number_at(lines, i, at, text.substr(0, colon)), i});
  }
  return out;
}

struct GainRule {
  const char *theirs, *component, *ours;
  double factor;
  bool surface;  ///< its sign depends on the sign of the surface
};
constexpr std::array<GainRule, 15> gain_rules{
    {{"r_kp", "Inner", "roll_kp", full_deflection, true},
     {"r_ki", "Inner", "roll_ki", full_deflection, true},
     {"r_kd", "Inner", "roll_kd", full_deflection, true},
     {"p_kp", "Inner", "pitch_kp", full_deflection, true},
     {"p_ki", "Inner", "pitch_ki", full_deflection, true},
     {"p_kd", "Inner", "pitch_kd", full_deflection, true},
     {"y_kr", "Inner", "yaw_kd", full_deflection, true},
     {"y_pwo", "Inner", "yaw_washout", 1, false},
     {"c_kp", "Outer", "course_kp", 1, false},
     {"a_kp", "Outer", "altitude_kp", 1, false},
     {"a_ki", "Outer", "altitude_ki", 1, false},
     {"a_t_kp", "Outer", "airspeed_kp", 1, false},
     {"a_t_ki", "Outer", "airspeed_ki", 1, false},
     {"takeoff_airspeed", "Outer", "takeoff_airspeed", 1, false},
     {"cmd_takeoff_pitch", "Outer", "takeoff_pitch", degree, false}}};

/// The section `params` of the airframe file from one file of gains.
std::string gains_text(const Lines& lines, RosplaneSet& out) {
  const std::map<std::string, Setting> all = settings(lines);
  std::map<std::string, std::string> sections;
  std::string used;
  for (const GainRule& rule : gain_rules) {
    const auto found = all.find(rule.theirs);
    if (found == all.end()) continue;
    double value = found->second.value * rule.factor;
    std::string why = lines.place(found->second.line, rule.theirs);
    if (rule.factor == full_deflection) why += " times 40 deg";
    if (rule.surface && value < 0) {
      out.doubts.push_back(fulmar::located(
          lines.place(found->second.line),
          aero_messages::gain_sign_reversed(rule.theirs, figures(found->second.value), figures(-value))));
      value = -value;
    }
    sections[rule.component] +=
        padded(std::string("    ") + rule.ours + ": " + figures(value, 5), 30) + " # " + why + "\n";
    used += std::string(used.empty() ? "" : ", ") + rule.theirs;
  }
  for (const auto& [key, setting] : all)
    if (key == "autopilot" || key == "p_ff" || key == "trim_r" || key == "frequency")
      out.doubts.push_back(fulmar::located(lines.place(setting.line), aero_messages::gain_undeclared(key)));
  if (lines.find("autopilot:"))
    out.doubts.push_back(
        fulmar::located(lines.place(*lines.find("autopilot:")), aero_messages::autopilot_node_renamed()));
  out.notes.push_back("gains: " + lines.place(0) + ": " + used +
                      "; all others are Fulmar's defaults, and `fulmar aero tune --write` computes them");
  std::string text =
      "# Gains of ROSplane. `fulmar aero tune --write` replaces them with computed ones.\nparams:\n";
  for (const auto& [component, rows] : sections) text += "  control_slc/" + component + ":\n" + rows;
  return text;
}

struct RosWaypoint {
  std::array<double, 3> at{};
  double airspeed = 0, course = 0;
  bool lla = false, use_course = false, placed = false;
  std::size_t line = 0;
};

std::array<double, 3> three(const Lines& lines, std::size_t i) {
  std::string text = lines.all[i].substr(lines.all[i].find(':') + 1);
  for (char& c : text)
    if (c == '[' || c == ']' || c == ',') c = ' ';
  const std::vector<double> values = numbers_at(lines_of(lines.file, text), 0, 0);
  if (values.size() != 3)
    refuse(lines.where(i), aero_messages::waypoint_position_invalid(trimmed(lines.all[i])));
  return {values[0], values[1], values[2]};
}

std::vector<RosWaypoint> waypoints(const Lines& lines) {
  std::vector<RosWaypoint> all;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    std::string text = trimmed(lines.all[i]);
    if (begins(text, "- ")) text = trimmed(text.substr(2));
    if (begins(text, "wp:")) {
      all.emplace_back();
      all.back().line = i;
      continue;
    }
    if (all.empty() || text.empty() || text[0] == '#') continue;
    RosWaypoint& last = all.back();
    const std::size_t colon = lines.all[i].find(':');
    if (colon == std::string::npos) continue;
    const std::string value = lower(trimmed(lines.all[i].substr(colon + 1)));
    if (begins(text, "w:")) {
      last.at = three(lines, i);
      last.placed = true;
    } else if (begins(text, "va_d"))
      last.airspeed = number_at(lines, i, colon + 1, "va_d");
    else if (begins(text, "chi_d"))
      last.course = number_at(lines, i, colon + 1, "chi_d");
    else if (begins(text, "lla"))
      last.lla = begins(value, "true");
    else if (begins(text, "use_chi"))
      last.use_course = begins(value, "true");
  }
  for (const RosWaypoint& one : all)
    if (!one.placed || !(one.airspeed > 0))
      refuse(lines.where(one.line), "wp: expected 'w: [north, east, down]' and 'va_d: airspeed' above 0");
  if (all.size() < 2) refuse(lines.where(all.empty() ? 0 : all[0].line), aero_messages::too_few_waypoints());
  return all;
}

std::string plan_text(const Lines& lines, const std::string& name, double radius) {
  const std::vector<RosWaypoint> all = waypoints(lines);
  std::string text = "# From " + lines.place(0).substr(0, lines.place(0).rfind(':')) + ".\nname: " + name +
                     "\nend: circuit\nairspeed: " + figures(all[0].airspeed) +
                     " m/s\nturn_radius: " + figures(radius) + " m\nwaypoints:\n";
  for (const RosWaypoint& one : all) {
    const auto at = [&](std::size_t k) { return figures(one.at[k], 10); };
    text += one.lla
                ? "  - {lat: " + at(0) + ", lon: " + at(1) + ", alt_msl: " + at(2) + " m"
                : "  - {north: " + at(0) + " m, east: " + at(1) + " m, up: " + figures(-one.at[2], 10) + " m";
    if (one.use_course) text += ", course: " + figures(one.course, 6) + " rad";
    text += "}\n";
  }
  return text;
}

}  // namespace

RosplaneSet rosplane_set(const std::string& folder) {
  RosplaneSet out;
  const Lines* aircraft = nullptr;
  const Lines* gains = nullptr;
  std::vector<const Lines*> missions;
  double radius = 50;
  const std::vector<Lines> all = yaml_files(folder);
  for (const Lines& lines : all) {
    const std::map<std::string, Setting> own = settings(lines);
    if (is_rosflight(lines)) {
      if (aircraft) throw core::Error(located(lines.file, aero_messages::aircraft_duplicate(aircraft->file)));
      aircraft = &lines;
    } else if (own.count("r_kp") && own.count("c_kp")) {
      if (gains) throw core::Error(located(lines.file, aero_messages::gains_duplicate(gains->file)));
      gains = &lines;
    } else if (lines.has("wp:")) {
      missions.push_back(&lines);
    } else {
      out.notes.push_back(lines.file + ": not used; it has neither coefficients, gains nor waypoints");
    }
    if (own.count("R_min")) radius = own.at("R_min").value;
  }
  if (!aircraft) throw core::Error(located(folder, aero_messages::rosflight_file_missing()));
  ImportOptions options;
  Aircraft a = rosflight_aircraft(*aircraft, true);
  if (!missions.empty()) a.cruise_mps = options.cruise_mps = waypoints(*missions[0])[0].airspeed;
  const std::string name = a.name;
  out.airframe = written(std::move(a), options, name + ".yaml");
  std::string text = out.airframe.text;
  if (gains) text += gains_text(*gains, out);
  out.airframe.file = airframe_of_text(text, name + ".yaml");
  out.files.push_back({name + ".yaml", text});
  for (const Lines* mission : missions) {
    const std::string plan = std::filesystem::path(mission->file).stem().string();
    out.files.push_back({plan + "_plan.yaml", plan_text(*mission, plan, radius)});
    out.files.push_back(
        {plan + ".yaml",
         "# From " + mission->place(0).substr(0, mission->place(0).rfind(':')) +
             ". The origin is an assumption: Provo, Utah, as in ROSplane's launch files.\nmission: " + plan +
             "\nextends: fulmar:missions/common.yaml\nio: sim\nairframe: " + name +
             ".yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
             "done: \"manage.progress.circuits >= 2\"\ncomponents:\n  plan: {params: {plan: " +
             plan + "_plan.yaml}}\n"});
  }
  return out;
}

}  // namespace fulmar::aero::imports
