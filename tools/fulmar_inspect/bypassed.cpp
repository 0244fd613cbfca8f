// SPDX-License-Identifier: BSD-3-Clause
// Components that were replaced and are still read. For example, a mission adds a path and connects it to the
// follower. A scorer or `done` that still reads the former manager then evaluates an inactive path. The
// layers below state which components steered.
#include <algorithm>
#include <cctype>
#include <set>

#include "core/graph/steering.hpp"
#include "tools/fulmar_inspect/advice.hpp"
#include "tools/fulmar_inspect/messages.hpp"

namespace fulmar::core {
namespace {

using Names = std::set<std::string>;

/// True when the component is created in `io`.
bool exists(const ComponentText& c, Io io) { return !c.only || *c.only == io; }

/// Components of a layer whose outputs lead to the inputs of the role `vehicle`. Further wires of a vehicle
/// are only observed by it and do not count.
Names who_steers(const MissionText& text, Io io) {
  std::vector<std::string> todo;
  Names steer, seen;
  const auto follow = [&](const std::vector<WireText>& wires, const ComponentText* own) {
    for (const WireText& wire : wires)
      if (!own || !find_named(own->in, wire.name)) todo.push_back(wire.from.owner);
  };
  if (const RoleText* vehicle = text.role("vehicle")) follow(vehicle->in, nullptr);
  while (!todo.empty()) {
    const std::string owner = todo.back();
    todo.pop_back();
    if (!seen.insert(owner).second) continue;
    for (const ComponentText& c : text.components) {
      if (!exists(c, io) || c.fills_role("vehicle") || (c.name != owner && !c.fills_role(owner))) continue;
      steer.insert(c.name);
      follow(c.in, nullptr);
      for (const Word& role : c.fills)
        if (const RoleText* r = text.role(role.text)) follow(r->in, &c);
    }
  }
  return steer;
}

/// The same for the built graph, which has the source of each input.
Names who_steers(const Graph& graph, const MissionText& text) {
  Names steer;
  for (const int i : steering_components(graph, text)) steer.insert(nth(graph.components, i).name);
  return steer;
}

bool names(const std::string& text, const std::string& component) {
  const std::string prefix = component + ".";
  for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at + 1))
    if (at == 0 || !(std::isalnum(static_cast<unsigned char>(text[at - 1])) || text[at - 1] == '_' ||
                     text[at - 1] == '.'))
      return true;
  return false;
}

/// A component that steers in a layer and not in the mission.
struct Replaced {
  std::string name, mission;  // place where it steers
  std::string successors;
};
using Bypassed = std::vector<Replaced>;

bool is_listed(const Bypassed& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
}

Bypassed bypassed(const Graph& graph, const MissionText& text, const Names& steer) {
  Bypassed list;
  for (const MissionText& layer : text.below) {
    const Names before = who_steers(layer, text.io);
    std::vector<std::string> newcomers;
    for (const std::string& name : steer)
      if (!layer.component(name)) newcomers.push_back(name);
    if (newcomers.empty()) continue;  // a choice among components, no replacement
    for (const std::string& name : before) {
      const Component* const c = find_named(graph.components, name);
      if (!c || !c->roles.empty() || steer.count(name) > 0 || is_listed(list, name)) continue;
      list.push_back({name, layer.file->name, join(newcomers)});
    }
  }
  return list;
}

/// Entries of a mission that read `component`.
std::vector<std::pair<Where, std::string>> onlookers(const MissionText& text, const std::string& component) {
  std::vector<std::pair<Where, std::string>> list;
  const auto look = [&](const Word& word, const std::string& reader) {
    if (names(word.text, component)) list.emplace_back(word.where, reader);
  };
  const auto transitions = [&](const std::vector<TransitionText>& next, const std::string& phase) {
    for (const TransitionText& t : next) look(t.when, "phases." + phase + ".next");
  };
  if (text.judge.done) look(*text.judge.done, "done");
  if (text.judge.failed) look(*text.judge.failed, "failed");
  if (text.judge.flown) look(*text.judge.flown, "flown");
  if (text.judge.verdict) look(*text.judge.verdict, "verdict");
  for (const Word& word : text.judge.progress) look(word, "progress");
  for (const auto& [key, word] : text.judge.summary) look(word, "summary." + key);
  for (const auto& [param, word] : text.resume) look(word, "resume." + param);
  for (const Word& word : text.report) look(word, "tell");
  transitions(text.any, "any");
  for (const PhaseText& phase : text.phases) transitions(phase.next, phase.name);
  return list;
}

void add_unreported(const MissionText& text, Advice& advice) {
  if (text.report.empty()) return;
  for (const MissionText& layer : text.below)
    for (const Word& word : layer.report) {
      const bool still = std::any_of(text.report.begin(), text.report.end(),
                                     [&](const Word& w) { return w.text == word.text; });
      const std::string owner = word.text.substr(0, word.text.find('.'));
      const ComponentText* const component = text.component(owner);
      const bool there = text.role(owner) || (component && exists(*component, text.io));
      if (!still && there)
        advice.push_back(
            located(text.report[0].where,
                    located("tell", inspect_messages::report_list_incomplete(word.text, word.where.text()))));
    }
}

}  // namespace

void add_bypassed(const Graph& graph, const MissionText& text, Advice& advice) {
  const Bypassed list = bypassed(graph, text, who_steers(graph, text));
  const auto add = [&](const Where& where, const std::string& reader, const Replaced& replaced) {
    const std::string sentence =
        located(where, inspect_messages::replaced_component_read(reader, replaced.name, replaced.mission,
                                                                 replaced.successors));
    if (std::find(advice.begin(), advice.end(), sentence) == advice.end()) advice.push_back(sentence);
  };
  for (const Replaced& replaced : list) {
    const int index = index_named(graph.components, replaced.name);
    for (const Component& reader : graph.components)
      for (std::size_t k = 0; k < reader.wires.size() && !is_listed(list, reader.name); ++k) {
        const Wire& wire = reader.wires[k];
        if (wire.from.kind == Source::Kind::component && wire.from.index == index)
          add(wire.where, reader.name + "." + reader.info().inputs[k].name, replaced);
      }
    for (const auto& [where, reader] : onlookers(text, replaced.name)) add(where, reader, replaced);
  }
  add_unreported(text, advice);
}

}  // namespace fulmar::core
