// SPDX-License-Identifier: BSD-3-Clause
// `--with nav=FILE`: a role in place of the component that fills it.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

bool is_in_run(const MissionText& text, const ComponentText& component) {
  return !component.only || *component.only == text.io;
}

/// Components that the command line or the phases name, else the first that fills it, as in phases.cpp.
std::vector<std::string> who_fills(const MissionText& text, const Overrides& overrides,
                                   const std::string& role) {
  for (const auto& [name, component] : overrides.roles)
    if (name == role) return {component};
  const auto first = std::find_if(text.components.begin(), text.components.end(),
                                  [&](const auto& c) { return c.fills_role(role) && is_in_run(text, c); });
  std::vector<std::string> names;
  for (const PhaseText& phase : phases_of(text)) {
    std::string name = first == text.components.end() ? "" : first->name;
    for (const AssignmentText& a : phase.roles)
      if (a.role == role && !a.use.text.empty()) name = a.use.text;
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

Overrides with_components(const MissionText& text, Overrides overrides, Report& report) {
  for (auto& [name, file] : overrides.with) {
    if (text.component(name) || !text.role(name)) continue;
    const std::vector<std::string> fillers = who_fills(text, overrides, name);
    if (fillers.size() == 1)
      name = fillers.front();
    else
      report.add({"--with " + name + "=" + file, 0},
                 fillers.empty() ? graph_messages::role_empty(name)
                                 : graph_messages::role_ambiguous(name, join(fillers)));
  }
  return overrides;
}

Overrides with_components(const std::string& mission, const Overrides& overrides) {
  Report report;
  for (const auto& [name, file] : overrides.with) report.opened("--with " + name + "=" + file);
  const MissionText text = parse_mission(mission, overrides, report);
  Report faults;
  for (const auto& [name, file] : overrides.with) faults.opened("--with " + name + "=" + file);
  Overrides named = with_components(text, overrides, faults);
  faults.throw_if_any();
  return named;
}

}  // namespace fulmar::core
