// SPDX-License-Identifier: BSD-3-Clause
// Who was replaced and is still listened to. A mission that brings a path of its own, say, wires it to the
// follower; what goes on looking at the former manager, a scorer or `done`, then speaks of a flight that is
// not flown. Who steered is what the layers below say.
#include <algorithm>
#include <cctype>
#include <set>

#include "core/graph/draft.hpp"

namespace fulmar::core {
namespace {

using Names = std::set<std::string>;

/// Whoever exists in `io`.
bool exists(const ComponentText& c, Io io) { return !c.only || *c.only == io; }

/// Components of a layer whose outputs lead to what the role `vehicle` takes. What a vehicle has under wires
/// of its own it looks at, and does not obey.
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

/// Every component that leads to one of `ends`, the vehicle left out.
std::vector<int> leading_to(const Graph& graph, std::vector<Source> ends) {
  std::vector<int> found;
  while (!ends.empty()) {
    const Source end = ends.back();
    ends.pop_back();
    std::vector<int> writers;
    if (end.kind == Source::Kind::component) writers = {end.index};
    if (end.kind == Source::Kind::role) writers = nth(graph.roles, end.index).fillers;
    for (const int writer : writers) {
      if (writer == graph.vehicle || std::find(found.begin(), found.end(), writer) != found.end()) continue;
      found.push_back(writer);
      for (const Wire& wire : nth(graph.components, writer).wires) ends.push_back(wire.from);
    }
  }
  return found;
}

/// What the vehicle obeys.
std::vector<Source> commands(const Graph& graph, const MissionText& text) {
  std::vector<Source> ends;
  const RoleText* const role = text.role("vehicle");
  if (graph.vehicle < 0 || !role) return ends;
  const Component& vehicle = nth(graph.components, graph.vehicle);
  for (const WireText& wire : role->in)
    if (const int input = vehicle.info().input(wire.name); input >= 0)
      ends.push_back(nth(vehicle.wires, input).from);
  return ends;
}

/// The same of the built graph, which knows who has which input.
Names who_steers(const Graph& graph, const MissionText& text) {
  Names steer;
  for (const int i : leading_to(graph, commands(graph, text))) steer.insert(nth(graph.components, i).name);
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

/// Component -> why it does not steer any more, though it did in a layer.
using Bypassed = std::vector<std::pair<std::string, std::string>>;

bool is_listed(const Bypassed& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.first == name; });
}

Bypassed bypassed(const Draft& draft, const Names& steer) {
  Bypassed list;
  for (const MissionText& layer : draft.text.below) {
    const Names before = who_steers(layer, draft.text.io);
    std::vector<std::string> newcomers;
    for (const std::string& name : steer)
      if (!layer.component(name)) newcomers.push_back(name);
    if (newcomers.empty()) continue;  // who steers is chosen, not replaced
    for (const std::string& name : before) {
      const Component* const c = find_named(draft.graph.components, name);
      if (!c || !c->roles.empty() || steer.count(name) > 0 || is_listed(list, name)) continue;
      list.emplace_back(name, name + ", which steers in " + layer.file->name + " and not here: " +
                                  join(newcomers) + (newcomers.size() == 1 ? " does" : " do"));
    }
  }
  return list;
}

/// What a mission says that looks at `component`.
std::vector<std::pair<Where, std::string>> onlookers(const MissionText& text, const std::string& component) {
  std::vector<std::pair<Where, std::string>> list;
  const auto look = [&](const Word& word, const std::string& sentence) {
    if (names(word.text, component)) list.emplace_back(word.where, sentence);
  };
  const auto transitions = [&](const std::vector<TransitionText>& next, const std::string& phase) {
    for (const TransitionText& t : next) look(t.when, "phases." + phase + ".next looks at ");
  };
  if (text.done) look(*text.done, "done looks at ");
  if (text.failed) look(*text.failed, "failed looks at ");
  if (text.flown) look(*text.flown, "flown looks at ");
  if (text.verdict) look(*text.verdict, "verdict comes from ");
  for (const Word& word : text.progress) look(word, "progress shows ");
  for (const auto& [key, word] : text.summary) look(word, "summary." + key + " shows ");
  for (const auto& [param, word] : text.resume) look(word, "resume." + param + " takes up what was of ");
  for (const Word& word : text.tell) look(word, "tell listens to ");
  transitions(text.any, "any");
  for (const PhaseText& phase : text.phases) transitions(phase.next, phase.name);
  return list;
}

void tell_untold(Draft& draft) {
  const std::vector<Word>& told = draft.text.tell;
  if (told.empty()) return;
  for (const MissionText& layer : draft.text.below)
    for (const Word& word : layer.tell) {
      const bool still =
          std::any_of(told.begin(), told.end(), [&](const Word& w) { return w.text == word.text; });
      const std::string owner = word.text.substr(0, word.text.find('.'));
      const bool there = draft.role(owner) >= 0 || draft.candidate(owner) >= 0;
      if (!still && there)
        draft.graph.warnings.push_back(told[0].where.text() + ": tell: leaves out " + word.text + ", which " +
                                       word.where.text() + " lists; a list takes the place of the other");
    }
}

}  // namespace

std::vector<int> deciding_components(const Graph& graph, const MissionText& text) {
  std::vector<Source> ends = commands(graph, text);
  const auto add = [&](const std::vector<Transition>& next) {
    for (const Transition& t : next)
      if (t.when) ends.insert(ends.end(), t.when->ports().begin(), t.when->ports().end());
  };
  add(graph.any);
  for (const Phase& phase : graph.phases) add(phase.next);
  return leading_to(graph, ends);
}

void tell_bypassed(Draft& draft) {
  Graph& graph = draft.graph;
  const Bypassed list = bypassed(draft, who_steers(graph, draft.text));
  const auto warn = [&](const std::string& sentence) {
    if (std::find(graph.warnings.begin(), graph.warnings.end(), sentence) == graph.warnings.end())
      graph.warnings.push_back(sentence);
  };
  for (const auto& [name, why] : list) {
    const int index = index_named(graph.components, name);
    for (const Component& reader : graph.components)
      for (std::size_t k = 0; k < reader.wires.size() && !is_listed(list, reader.name); ++k) {
        const Wire& wire = reader.wires[k];
        if (wire.from.kind == Source::Kind::component && wire.from.index == index)
          warn(wire.where.text() + ": " + reader.name + "." + reader.info().inputs[k].name + " comes from " +
               why);
      }
    for (const auto& [where, sentence] : onlookers(draft.text, name))
      warn(where.text() + ": " + sentence + why);
  }
  tell_untold(draft);
}

}  // namespace fulmar::core
