// SPDX-License-Identifier: BSD-3-Clause
// Maximum age of a sample on each wire, and the wires that stop their reader when it is exceeded: all that
// lead, directly or not, to the vehicle's inputs.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::int64_t min_age_ns = 1'000'000'000;  // default of a mission

std::vector<int> writers_of(const Graph& graph, const Wire& wire) {
  if (wire.from.kind == Source::Kind::component) return {wire.from.index};
  if (wire.from.kind == Source::Kind::role) return nth(graph.roles, wire.from.index).fillers;
  return {};
}

}  // namespace

std::vector<bool> chain_to_vehicle(const Graph& graph) {
  std::vector<bool> in_chain(graph.components.size(), false);
  std::vector<int> todo;
  if (graph.vehicle >= 0) todo.push_back(graph.vehicle);
  while (!todo.empty()) {
    const int reader = todo.back();
    todo.pop_back();
    for (const Wire& wire : nth(graph.components, reader).wires)
      for (const int writer : writers_of(graph, wire)) {
        if (writer == graph.vehicle || nth(in_chain, writer)) continue;
        nth(in_chain, writer) = true;
        todo.push_back(writer);
      }
  }
  return in_chain;
}

namespace {

bool from_vehicle(const Graph& graph, const Wire& wire) {
  const std::vector<int> writers = writers_of(graph, wire);
  return std::find(writers.begin(), writers.end(), graph.vehicle) != writers.end();
}

/// Sensors may pause, and estimators detect it. Other sources of the chain must keep publishing: three steps
/// of the writer may pass, and at least a second.
std::int64_t usual_age_ns(const Graph& graph, const Component& reader, const Wire& wire) {
  if (from_vehicle(graph, wire)) return 0;
  if (wire.import >= 0 && reader.roles.empty())
    return 0;  // for example a plan from another host, which is published on changes
  std::int64_t age_ns = min_age_ns;
  for (const int i : writers_of(graph, wire)) {
    const Component& writer = nth(graph.components, i);
    age_ns = std::max(age_ns, 3 * writer.period_ns + writer.latency_ns);
  }
  return age_ns;
}

std::string warning(const Component& reader, const Port& input, const Wire& wire) {
  return located(wire.where.text(),
                 graph_messages::age_unlimited(
                     reader.name, input.name,
                     wire.import >= 0 ? ": it comes from outside, and its writer is not monitored; "
                                        "set a max_age"
                                      : ", even when its writer was stopped: max_age is off"))
      .line();
}

}  // namespace

void guard_wires(Draft& draft) {
  Graph& graph = draft.graph;
  const std::vector<bool> in_chain = chain_to_vehicle(graph);
  for (std::size_t i = 0; i < graph.components.size(); ++i) {
    Component& reader = graph.components[i];
    for (std::size_t k = 0; k < reader.wires.size(); ++k) {
      Wire& wire = reader.wires[k];
      const Port& input = reader.info().inputs[k];
      const bool fed = wire.from.kind != Source::Kind::none || wire.import >= 0;
      const bool watched = fed && input.kind == FULMAR_IN_VALUE && !input.optional &&
                           !reader.info().vehicle && (!reader.roles.empty() || in_chain[i]);
      // A role's filler has a fallback, or failsafe; the loop observes other components that command the
      // vehicle.
      const bool obeyed = fed && reader.info().vehicle && wire.from.kind == Source::Kind::component;
      const bool is_set = wire.max_age_ns != Wire::unsaid;
      if (!is_set) wire.max_age_ns = watched || obeyed ? usual_age_ns(graph, reader, wire) : 0;
      wire.by_steps = !is_set;
      wire.guarded = watched && wire.max_age_ns > 0;
      const bool blind = watched ? !wire.guarded : obeyed && wire.max_age_ns == 0;
      if (blind && !from_vehicle(graph, wire)) graph.source.warnings.push_back(warning(reader, input, wire));
    }
  }
}

}  // namespace fulmar::core
