// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/steering.hpp"

#include <algorithm>

#include "core/graph/condition.hpp"

namespace fulmar::core {
namespace {

/// Every component that leads to one of `ends`, without the vehicle.
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

/// Sources of the vehicle's command inputs.
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

}  // namespace

std::vector<int> steering_components(const Graph& graph, const MissionText& text) {
  return leading_to(graph, commands(graph, text));
}

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

}  // namespace fulmar::core
