// SPDX-License-Identifier: BSD-3-Clause
// Changes of the command line without effect in a phase: a value that the phase sets itself, a component in a
// phase that was written for another one.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

/// The phases that also set this parameter of the component.
std::vector<std::string> phases_that_set(const Draft& draft, int candidate, int param) {
  std::vector<std::string> names;
  const auto& phases = phases_of(draft.text);
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const auto sets = [&](const Assignment& a) {
      const auto same = [&](const Overlay& o) { return o.param == param; };
      return a.component == candidate && std::any_of(a.set.begin(), a.set.end(), same);
    };
    const std::vector<Assignment>& roles = nth(draft.assignments, static_cast<int>(p));
    if (std::any_of(roles.begin(), roles.end(), sets)) names.push_back(phases[p].name);
  }
  return names;
}

void report_hidden_values(Draft& draft) {
  for (const auto& [name, value] : draft.overrides.set) {
    const auto dot = name.find('.');
    const int i = dot == std::string::npos ? -1 : draft.candidate(name.substr(0, dot));
    if (i < 0 || !nth(draft.candidates, i).loaded) continue;
    const ParamPath path = param_path(nth(draft.candidates, i).info(), name.substr(dot + 1));
    if (path.param < 0) continue;
    const std::vector<std::string> phases = phases_that_set(draft, i, path.param);
    if (!phases.empty())
      draft.graph.source.warnings.push_back(graph_messages::setting_hidden(name, value, join(phases)).line());
  }
}

/// Parameters that a phase sets on the replaced component and that the new one does not have.
std::vector<std::string> lost_settings(const Draft& draft, const AssignmentText& text, int seated) {
  std::vector<std::string> names;
  const ComponentInfo& info = nth(draft.candidates, seated).info();
  for (const Node::Entry& entry : text.set.entries) {
    const int p = param_path(info, entry.key).param;
    if (p < 0 || !nth(info.params, p).live) names.push_back(entry.key);
  }
  return names;
}

void report_lost_settings(Draft& draft) {
  for (const auto& [role, component] : draft.overrides.roles) {
    const int seated = draft.candidate(component);
    if (role == "vehicle" || seated < 0 || !nth(draft.candidates, seated).loaded) continue;
    for (const PhaseText& phase : phases_of(draft.text))
      for (const AssignmentText& text : phase.roles) {
        if (text.role != role || !text.set.is(Node::Kind::map) || text.use.text == component) continue;
        const std::vector<std::string> lost = lost_settings(draft, text, seated);
        if (!lost.empty())
          draft.graph.source.warnings.push_back(
              graph_messages::phase_settings_lost(role, component, phase.name, join(lost)).line());
      }
  }
}

}  // namespace

void report_overlaid(Draft& draft) {
  report_hidden_values(draft);
  report_lost_settings(draft);
}

}  // namespace fulmar::core
