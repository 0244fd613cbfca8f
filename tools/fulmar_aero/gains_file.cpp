// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/gains_file.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "core/types/text.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

constexpr const char *inner_name = "control_slc/Inner", *slc_name = "control_slc/Outer",
                     *tecs_name = "control_tecs/Outer";

/// The section of one law.
template <class Law>
void fill_law(Law& law, const core::Node& section, const std::string& path, core::Report& report) {
  if (!core::is_a(core::Node::Kind::map, section, path, "a map {parameter: value}", report)) return;
  const std::vector<Named<Law>>& all = parameters_of(law);
  for (const core::Node::Entry& entry : section.entries) {
    if (entry.key.find('.') != std::string::npos) continue;  // a field of a record
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return entry.key == one.name; });
    if (at == all.end()) {
      std::vector<std::string> names;
      for (const Named<Law>& one : all) names.emplace_back(one.name);
      report.add(entry.where(), located(path, aero_messages::parameter_unknown(
                                                  entry.key, core::choices_text(entry.key, names))));
    } else if (at->number) {
      Number& number = law.*at->number;
      const auto read =
          core::scalar_number(entry.value, path + "." + entry.key,
                              {number.unit, core::UnitRule::optional, number.min, number.max}, report);
      if (read) number.value = *read;
    }
  }
}

/// Lines of a text; the last one also ends with a newline.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

int last_line(const core::Node& node) {
  int last = node.line;
  for (const core::Node& item : node.items) last = std::max(last, last_line(item));
  for (const core::Node::Entry& entry : node.entries)
    last = std::max({last, entry.line, last_line(entry.value)});
  return last;
}

std::string indent_of(const std::string& line) { return line.substr(0, line.find_first_not_of(' ')); }

/// Edits of a file, by line, applied together so that line numbers stay valid.
class Edit {
 public:
  Edit(const AirframeFile& file, const std::string& text) : file_(file), lines_(lines_of(text)) {}

  void set(const core::Node::Entry& section, const Gain& gain) {
    for (const core::Node::Entry& entry : section.value.entries)
      if (entry.key == gain.name) return replace(entry, gain_text(gain.value));
    add(section, gain);
  }
  void append(int after_line, const std::string& text) { added_[after_line] += text; }

  std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      out += lines_[i] + "\n";
      if (const auto at = added_.find(int(i) + 1); at != added_.end()) out += at->second;
    }
    return out;
  }
  std::size_t lines() const { return lines_.size(); }
  const std::string& line(int number) const { return lines_.at(std::size_t(number - 1)); }

 private:
  [[noreturn]] void refuse(int line, const Diagnostic& what) const {
    throw core::Error(located(core::Where{file_.name, line}, aero_messages::entry_form_unsupported(what)));
  }
  void replace(const core::Node::Entry& entry, const std::string& value) {
    std::string& line = lines_.at(std::size_t(entry.line - 1));
    const std::size_t key = line.find(entry.key + ":");
    const std::size_t old =
        key == std::string::npos ? key : line.find_first_not_of(' ', key + entry.key.size() + 1);
    if (old == std::string::npos || line.compare(old, entry.value.text.size(), entry.value.text) != 0)
      refuse(entry.line, entry.key);
    line.replace(old, entry.value.text.size(), value);
  }
  void add(const core::Node::Entry& section, const Gain& gain) {
    const std::string one = gain.name + ": " + gain_text(gain.value);
    const auto& entries = section.value.entries;
    if (entries.empty() || entries.front().line == section.line) {
      std::string& line = lines_.at(std::size_t(section.line - 1));
      const std::size_t brace = line.find('{', line.find(section.key));
      if (brace == std::string::npos) refuse(section.line, section.key);
      line.insert(brace + 1, one + (entries.empty() ? "" : ", "));
    } else {
      append(last_line(section.value), indent_of(line(entries.front().line)) + one + "\n");
    }
  }

  const AirframeFile& file_;
  std::vector<std::string> lines_;
  std::map<int, std::string> added_;
};

/// Of one component, indented.
std::string section_text(const std::vector<Gain>& gains, const std::string& component,
                         const std::string& indent) {
  std::string text = indent + component + ":\n";
  for (const Gain& gain : gains)
    if (gain.component == component) text += indent + "  " + gain.name + ": " + gain_text(gain.value) + "\n";
  return text;
}

}  // namespace

FileLaws laws_in(const AirframeFile& file) {
  FileLaws out;
  const core::Node* const section = file.root.find("params");
  if (!section) return out;
  core::Report report;
  const std::vector<std::string> known{inner_name, slc_name, tecs_name};
  if (core::is_a(core::Node::Kind::map, *section, "params", "a map {plugin/Component: {parameter: value}}",
                 report)) {
    for (const core::Node::Entry& entry : section->entries) {
      const std::string path = "params." + entry.key;
      if (entry.key == inner_name)
        fill_law(out.laws.inner, entry.value, path, report);
      else if (entry.key == slc_name)
        fill_law(out.laws.slc, entry.value, path, report);
      else if (entry.key == tecs_name)
        fill_law(out.laws.tecs, entry.value, path, report);
      else if (entry.key == "control_slc/Airspeed" || entry.key == "control_slc/Autotune" ||
               entry.key == "control_tecs/ErrorLaw")
        continue;  // loops that are not evaluated here
      else if (entry.key.rfind("control_slc", 0) == 0 || entry.key.rfind("control_tecs", 0) == 0)
        report.add(entry.where(),
                   aero_messages::component_unknown(entry.key, core::choices_text(entry.key, known)));
      out.given |= std::find(known.begin(), known.end(), entry.key) != known.end();
    }
  }
  report.throw_if_any();
  return out;
}

std::vector<Gain> computed_gains(const Laws& l, bool yaw_damper) {
  std::vector<Gain> all;
  const auto add = [&](const char* component, const char* name, const Number& p) {
    all.push_back({component, name, p.unit, p.value});
  };
  add(inner_name, "roll_kp", l.inner.roll_kp);
  add(inner_name, "roll_ki", l.inner.roll_ki);
  add(inner_name, "roll_kd", l.inner.roll_kd);
  add(inner_name, "roll_kff", l.inner.roll_kff);
  add(inner_name, "pitch_kp", l.inner.pitch_kp);
  add(inner_name, "pitch_ki", l.inner.pitch_ki);
  add(inner_name, "pitch_kd", l.inner.pitch_kd);
  add(inner_name, "yaw_kd", l.inner.yaw_kd);
  if (yaw_damper) add(inner_name, "yaw_washout", l.inner.yaw_washout);
  add(slc_name, "course_kp", l.slc.course_kp);
  add(slc_name, "altitude_kp", l.slc.altitude_kp);
  add(slc_name, "altitude_ki", l.slc.altitude_ki);
  add(slc_name, "altitude_kd", l.slc.altitude_kd);
  add(slc_name, "airspeed_kp", l.slc.airspeed_kp);
  add(slc_name, "airspeed_ki", l.slc.airspeed_ki);
  add(slc_name, "airspeed_kff", l.slc.airspeed_kff);
  add(slc_name, "climb_kff", l.slc.climb_kff);
  add(slc_name, "thrust", l.slc.thrust);
  add(slc_name, "takeoff_airspeed", l.slc.takeoff_airspeed);
  add(tecs_name, "course_kp", l.tecs.course_kp);
  add(tecs_name, "altitude_gain", l.tecs.altitude_gain);
  add(tecs_name, "airspeed_gain", l.tecs.airspeed_gain);
  add(tecs_name, "speed_weight", l.tecs.speed_weight);
  add(tecs_name, "airspeed_kff", l.tecs.airspeed_kff);
  add(tecs_name, "thrust", l.tecs.thrust);
  add(tecs_name, "takeoff_airspeed", l.tecs.takeoff_airspeed);
  return all;
}

std::string gain_text(double value) { return figures(value, 6); }

std::string params_text(const std::vector<Gain>& gains) {
  std::string text = "params:\n";
  for (const char* component : {inner_name, slc_name, tecs_name})
    text += section_text(gains, component, "  ");
  return text;
}

std::string with_gains(const AirframeFile& file, const std::string& text, const std::vector<Gain>& gains) {
  Edit edit(file, text);
  const core::Node* const params = file.root.find("params");
  if (!params || params->entries.empty()) {
    if (params) throw core::Error(located(file.where("params"), aero_messages::params_empty()));
    edit.append(int(edit.lines()), params_text(gains));
    return edit.text();
  }
  for (const char* component : {inner_name, slc_name, tecs_name}) {
    const auto at = std::find_if(params->entries.begin(), params->entries.end(),
                                 [&](const core::Node::Entry& entry) { return entry.key == component; });
    if (at == params->entries.end())
      edit.append(last_line(*params),
                  section_text(gains, component, indent_of(edit.line(params->entries.front().line))));
    else
      for (const Gain& gain : gains)
        if (gain.component == component) edit.set(*at, gain);
  }
  return edit.text();
}

}  // namespace fulmar::aero
