// SPDX-License-Identifier: BSD-3-Clause
// Possible fillers of a role: the outputs of its contract, and components that fill several roles.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

std::vector<std::string> output_words(const ComponentInfo& info) {
  std::vector<std::string> words;
  for (const Port& port : info.outputs)
    if (port.type) words.push_back(port.name + ": " + port.type->name);
  return words;
}

/// Whether a filler has the outputs of its role.
bool keeps_contract(Draft& draft, const RoleDraft& role, const Candidate& filler) {
  const std::string path = "components." + filler.name + ": ";
  const ComponentInfo& info = filler.info();
  const Where& where = filler.text->fills.front().where;
  bool keeps = true;
  if (role.name == "vehicle" && !info.vehicle)
    draft.report.add(where, graph_messages::vehicle_expected(path, filler.use));
  if (role.name != "vehicle" && info.vehicle)
    draft.report.add(where, graph_messages::vehicle_role_invalid(path, filler.use, role.name));
  for (const RoleOutText& out : role.text->out) {
    const Port* const port = find_named(info.outputs, out.name);
    if (!port && out.optional) continue;
    if (port && port->type && port->type->name == out.type) continue;
    const std::string has =
        !port ? "; it has " + join(output_words(info))
              : "; its '" + out.name + "' is " + (port->type ? port->type->name : "a probe");
    draft.report.add(where, graph_messages::role_output_missing(path, role.name, out.name, out.type, has));
    keeps = false;
  }
  return keeps;
}

/// The table of a role's output: the filler's table that all other fillers can feed.
TypePtr common_type(Draft& draft, const RoleDraft& role, const RoleOutText& out) {
  std::vector<std::pair<const Candidate*, TypePtr>> given;
  for (const int f : role.fillers) {
    const Candidate& filler = nth(draft.candidates, f);
    const Port* const port = filler.loaded ? find_named(filler.info().outputs, out.name) : nullptr;
    if (port && port->type && port->type->name == out.type) given.emplace_back(&filler, port->type);
  }
  for (const auto& [reader, table] : given) {
    const TypePtr wanted = table;
    if (std::all_of(given.begin(), given.end(),
                    [&](const auto& writer) { return incompatibility(*writer.second, *wanted).empty(); }))
      return wanted;
  }
  for (std::size_t i = 1; i < given.size(); ++i) {
    const std::string fault = incompatibility(*given[i].second, *given[0].second);
    if (fault.empty()) continue;
    draft.report.add(
        given[i].first->text->where,
        graph_messages::role_output_differs(given[i].first->name, out.name, given[0].first->name, fault));
    break;
  }
  return given.empty() ? nullptr : given[0].second;
}

std::vector<std::string> role_names(const Draft& draft, const Candidate& candidate) {
  std::vector<std::string> names;
  for (const int r : candidate.roles) names.push_back(nth(draft.roles, r).name);
  return names;
}

}  // namespace

void resolve_roles(Draft& draft) {
  for (std::size_t r = 0; r < draft.roles.size(); ++r) {
    RoleDraft& role = draft.roles[r];
    for (std::size_t i = 0; i < draft.candidates.size(); ++i) {
      const Candidate& candidate = draft.candidates[i];
      if (!candidate.fills(static_cast<int>(r))) continue;
      role.fillers.push_back(static_cast<int>(i));
      if (!candidate.loaded || !keeps_contract(draft, role, candidate)) role.unclear = true;
    }
    for (const RoleOutText& out : role.text->out) role.types.push_back(common_type(draft, role, out));
    if (!role.fillers.empty()) continue;
    role.unclear = true;
    std::string why = graph_messages::role_filler_hint(role.name).text;
    for (const ComponentText& text : draft.text.components)
      if (text.fills_role(role.name))
        why = " with io: " + io_word(draft.text.io) + "; " + not_there(draft, text.name).text;
    draft.report.add(role.text->where, graph_messages::role_not_filled(role.name, why));
  }
}

void check_groups(Draft& draft) {
  for (std::size_t i = 0; i < draft.candidates.size(); ++i) {
    const Candidate& group = draft.candidates[i];
    if (group.roles.size() < 2) continue;
    const std::string path = "components." + group.name + ".fills: ";
    const Where& where = group.text->fills.front().where;
    if (group.fills(draft.role("vehicle")))
      draft.report.add(where, graph_messages::vehicle_roles_shared(path));
    std::vector<const RoleOutText*> outputs;
    for (const int r : group.roles)
      for (const RoleOutText& out : nth(draft.roles, r).text->out) {
        // An optional output such as the notices is one port that both roles have.
        const auto same = [&](const RoleOutText* other) {
          return other->name == out.name && !(other->optional && out.optional);
        };
        if (std::any_of(outputs.begin(), outputs.end(), same))
          draft.report.add(where, graph_messages::role_outputs_clash(path, out.name));
        outputs.push_back(&out);
      }
    for (std::size_t k = 0; k < i; ++k) {
      const Candidate& other = draft.candidates[k];
      const bool shares =
          std::any_of(other.roles.begin(), other.roles.end(), [&](int r) { return group.fills(r); });
      if (other.roles.size() > 1 && shares && other.roles != group.roles)
        draft.report.add(where,
                         graph_messages::role_groups_overlap(path, join(role_names(draft, group)), other.name,
                                                             join(role_names(draft, other))));
    }
  }
}

void choose_vehicle(Draft& draft) {
  std::vector<std::string> vehicles;
  bool unclear = false;
  for (const Candidate& candidate : draft.candidates) {
    unclear = unclear || !candidate.loaded;
    if (candidate.loaded && candidate.info().vehicle && candidate.used) vehicles.push_back(candidate.name);
  }
  const Where where{draft.text.file->name, 0};
  if (vehicles.empty() && !unclear && draft.role("vehicle") < 0)
    draft.report.add(where, graph_messages::vehicle_missing());
  if (vehicles.size() > 1) draft.report.add(where, graph_messages::vehicles_repeated(join(vehicles)));
}

}  // namespace fulmar::core
