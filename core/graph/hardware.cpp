// SPDX-License-Identifier: BSD-3-Clause
// Whether a mission is for hardware: its own `hardware:` section, and the ports read by its conditions and
// steering components that no flight controller measures.
#include <algorithm>
#include <cctype>
#include <utility>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"
#include "core/graph/steering.hpp"

namespace fulmar::core {

/// yes, or {fit: no, because: "..."}, or {with: nav, because: "..."}.
void read_hardware(const Keys& mission, MissionText& text, Report& report) {
  const Node* const node = mission.get("hardware");
  if (!node) return;
  HardwareText& hardware = text.hardware;
  hardware.where = node->where();
  if (node->is(Node::Kind::scalar)) {
    if (node->text == "yes") return;
    return report.add(hardware.where, graph_messages::hardware_value_invalid(found_words(*node)));
  }
  const Keys keys(*node, "hardware", {"fit", "with", "because"}, report);
  if (!node->is(Node::Kind::map)) return;
  hardware.fit = keys.word("fit", {"yes", "no"}).value_or("yes") == "yes";
  hardware.with = keys.text("with").value_or("");
  hardware.because = keys.text("because").value_or("");
  if ((!hardware.fit || !hardware.with.empty()) && hardware.because.empty())
    report.add(hardware.where, graph_messages::hardware_reason_missing());
}

void check_hardware(const MissionText& text, const Overrides& overrides, Report& report) {
  const HardwareText& hardware = text.hardware;
  if (text.io != Io::fcu) return;
  if (!hardware.fit) {
    report.add(hardware.where, graph_messages::hardware_not_allowed(hardware.because));
    report.throw_if_any();  // its other faults on hardware follow from that
  }
  const auto fills = [&](const std::string& name) {
    const ComponentText* const c = text.component(name);
    return name == hardware.with || (c && c->fills_role(hardware.with));
  };
  const auto given = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& o) { return fills(o.first); });
  };
  if (hardware.with.empty() || given(overrides.roles) || given(overrides.with)) return;
  if (!text.role(hardware.with))
    return report.add(hardware.where,
                      graph_messages::hardware_plugin_missing(hardware.with, hardware.because));
  std::vector<std::string> names;
  for (const ComponentText& c : text.components)
    if (c.fills_role(hardware.with) && c.only.value_or(Io::fcu) == Io::fcu) names.push_back(c.name);
  report.add(hardware.where,
             graph_messages::hardware_component_missing(hardware.with, hardware.because, join(names)));
}

namespace {

/// A message with the field `contact_known` declares that its vehicle may not measure contact: these fields
/// are valid only while that one is true. A message without it measures all its fields.
constexpr std::string_view contact_fields[] = {"on_ground", "crashed"};
constexpr const char* contact_known = "contact_known";

/// An error with io: fcu, a warning with io: sim.
void object(Draft& draft, const Where& where, const Diagnostic& message) {
  if (draft.graph.io == Io::fcu) return draft.report.add(where, message);
  const std::string warning = located(where, message).line();
  std::vector<std::string>& warnings = draft.graph.source.warnings;
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
}

/// Every name such as vehicle.status.on_ground in a condition, split at its dots.
std::vector<std::vector<std::string>> names_in(const std::string& condition) {
  std::vector<std::vector<std::string>> names;
  std::vector<std::string> parts(1);
  const auto finish = [&] {
    if (parts.size() > 1) names.push_back(parts);
    parts.assign(1, "");
  };
  for (const char c : condition)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
      parts.back() += c;
    else if (c == '.')
      parts.emplace_back();
    else
      finish();
  finish();
  return names;
}

/// The vehicle of this mission on hardware; null: none.
const ComponentText* hardware_vehicle(const MissionText& text) {
  for (const ComponentText& c : text.components)
    if (c.fills_role("vehicle") && c.only == Io::fcu) return &c;
  return nullptr;
}

class SimulatorPorts {
 public:
  SimulatorPorts(Draft& draft, Catalogue& catalogue) : draft_(draft), catalogue_(catalogue) {}

  void check() {
    for (const TransitionText& t : draft_.text.any) look(t, "any");
    for (const PhaseText& phase : draft_.text.phases)
      for (const TransitionText& t : phase.next) look(t, phase.name);
    for (const int i : deciding_components(draft_.graph, draft_.text)) look(nth(draft_.graph.components, i));
  }

 private:
  bool is_vehicle(const std::string& owner) const {
    const ComponentText* const c = draft_.text.component(owner);
    return owner == "vehicle" || (c && c->fills_role("vehicle"));
  }
  static bool has(const ComponentInfo& info, const std::string& port) { return info.output(port) >= 0; }
  /// A port of both vehicles needs no check of the other one, and a port that this one lacks is not from the
  /// simulator.
  bool lacks(const std::string& port) {
    const ComponentInfo& flown = draft_.vehicle().info();
    if (draft_.graph.io == Io::fcu) return !has(flown, port);
    const RoleText* const role = draft_.text.role("vehicle");
    const RoleOutText* const out = role ? find_named(role->out, port) : nullptr;
    if ((out && !out->optional) || !has(flown, port)) return false;
    const ComponentInfo* const real = real_vehicle();
    return real && !has(*real, port);
  }
  /// Null when its plugin cannot be opened: its missing ports are then unknown.
  const ComponentInfo* real_vehicle() {
    if (!plugin_ && std::exchange(tried_, true)) return nullptr;
    if (!plugin_) try {
        const auto [plugin, name] = split_use(hardware_vehicle(draft_.text)->use.text);
        plugin_ = catalogue_.open(plugin).info;
        real_name_ = name;
      } catch (const Error&) {
        return nullptr;
      }
    for (const ComponentInfo& info : plugin_->components)
      if (real_name_.empty() || info.name == real_name_) return &info;
    return nullptr;
  }
  /// Whether a field of contact may be unknown, and the condition does not check `contact_known`.
  bool is_guess(const std::vector<std::string>& name,
                const std::vector<std::vector<std::string>>& all) const {
    const ComponentInfo& flown = draft_.vehicle().info();
    const int output = flown.output(name[1]);
    const TypePtr type = output < 0 ? nullptr : nth(flown.outputs, output).type;
    if (!type || !type->find(contact_known)) return false;
    if (std::find(all.begin(), all.end(), std::vector<std::string>{name[0], name[1], contact_known}) !=
        all.end())
      return false;
    const RoleText* const role = draft_.text.role("vehicle");
    for (std::size_t i = 0; role && i < role->flags.size(); ++i)
      if (role->flags[i].first == "on_ground" && role->flags[i].second.text == name[1] + "." + name.back())
        return true;
    return std::find(std::begin(contact_fields), std::end(contact_fields), name.back()) !=
           std::end(contact_fields);
  }

  void look(const TransitionText& t, const std::string& phase) {
    const std::vector<std::vector<std::string>> names = names_in(t.when.text);
    for (const std::vector<std::string>& name : names) {
      if (!is_vehicle(name[0]) || name.size() < 3) continue;
      const std::string path = "phases." + phase + ".next: " + name[0] + "." + name[1];
      if (lacks(name[1]))
        object(draft_, t.when.where, graph_messages::simulated_output(path));
      else if (is_guess(name, names))
        object(draft_, t.when.where,
               graph_messages::contact_not_measured(path, name.back(), name[0] + "." + name[1]));
    }
  }

  /// A component that exists only with io: sim is declared as such.
  void look(const Component& reader) {
    const Candidate& candidate = nth(draft_.candidates, draft_.candidate(reader.name));
    if (candidate.text->only == Io::sim) return;
    for (std::size_t i = 0; i < candidate.wires.size(); ++i) {
      const std::string port = vehicle_port(candidate.wires[i].from);
      if (!port.empty() && lacks(port))
        object(draft_, candidate.wires[i].where,
               graph_messages::simulated_input(reader.name, reader.info().inputs[i].name, port));
    }
  }

  /// "truth" of a wire that begins at the vehicle, by role or by name; else "".
  std::string vehicle_port(const Source& from) const {
    if (from.kind == Source::Kind::role && nth(draft_.roles, from.index).name == "vehicle")
      return nth(nth(draft_.roles, from.index).text->out, from.output).name;
    if (from.kind != Source::Kind::component || from.output < 0) return "";
    const Candidate& writer = nth(draft_.candidates, from.index);
    return writer.text->fills_role("vehicle") ? nth(writer.info().outputs, from.output).name : "";
  }

  Draft& draft_;
  Catalogue& catalogue_;
  std::shared_ptr<const PluginInfo> plugin_;  // of the vehicle on hardware
  std::string real_name_;
  bool tried_ = false;  ///< the plugin has been opened, or could not be
};

}  // namespace

void report_simulator_ports(Draft& draft, Catalogue& catalogue) {
  const bool flies = draft.graph.io == Io::fcu || hardware_vehicle(draft.text);
  if (draft.graph.vehicle < 0 || !draft.text.hardware.fit || !flies) return;
  SimulatorPorts(draft, catalogue).check();
}

}  // namespace fulmar::core
