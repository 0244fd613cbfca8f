// SPDX-License-Identifier: BSD-3-Clause
// Wires: resolution of port names, type checks of both ends, missing wires, and the resulting order of steps.
#include <algorithm>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

Target role_target(const Draft& draft, int index, const PortName& name) {
  const RoleDraft& role = nth(draft.roles, index);
  const int output = require_named(role.text->out, name.port, "the role " + name.owner, "output");
  Target target;
  target.source = {Source::Kind::role, index, output};
  target.type = nth(role.types, output);
  target.unclear = !target.type;
  // fillers may publish any number of samples: a request input is the strictest check
  target.kind = FULMAR_OUT_QUEUE;
  for (const int f : role.fillers) {
    const Candidate& filler = nth(draft.candidates, f);
    const Port* const port = filler.loaded ? find_named(filler.info().outputs, name.port) : nullptr;
    if (port && port->kind == FULMAR_OUT_VALUE) target.kind = FULMAR_OUT_VALUE;
  }
  return target;
}

Target component_target(const Draft& draft, int index, const PortName& name) {
  const Candidate& candidate = nth(draft.candidates, index);
  Target target;
  target.source = {Source::Kind::component, index, -1};
  target.unclear = true;
  if (!candidate.loaded) return target;
  const int output =
      require_named(candidate.info().outputs, name.port, name.owner + " (" + candidate.use + ")", "output");
  const Port& port = nth(candidate.info().outputs, output);
  target.source.output = output;
  target.type = port.type;
  target.kind = port.kind;
  target.unclear = false;
  return target;
}

/// Why an output cannot feed an input; "" when it can.
std::string misfit(const std::string& owner, const Port& input, const PortName& from, const Target& target) {
  if (target.kind == FULMAR_OUT_PROBE) return graph_messages::probe_not_connectable(from.text()).line();
  const std::string reason = incompatibility(*target.type, *input.type);
  if (!reason.empty()) {
    if (target.type->name == input.type->name)
      return graph_messages::message_types_differ(from.text(), input.type->name, owner, input.name, reason)
          .line();
    return graph_messages::message_types_mismatch(owner, input.name, input.type->name, from.text(),
                                                  target.type->name)
        .line();
  }
  if (input.kind == FULMAR_IN_REQUEST && target.kind == FULMAR_OUT_VALUE)
    return graph_messages::request_source_invalid(owner, input.name, from.text()).line();
  return "";
}

/// Another plugin by the command line: it takes the wires for which it has inputs.
bool is_exchanged(const Draft& draft, const std::string& component) {
  const auto& with = draft.overrides.with;
  return draft.overrides.swaps != component &&
         std::any_of(with.begin(), with.end(), [&](const auto& pair) { return pair.first == component; });
}

void connect(Draft& draft, std::size_t index, const WireText& text, const std::string& path) {
  if (text.from.owner.empty()) return;  // reported when it was read
  Candidate& candidate = draft.candidates[index];
  const ComponentInfo& info = candidate.info();
  const int input = info.input(text.name);
  if (input < 0 && is_exchanged(draft, candidate.name)) {
    const Diagnostic message = graph_messages::connection_left_out(path, candidate.use);
    return draft.graph.source.warnings.push_back(located(text.where, message).line());
  }
  if (input < 0)
    return draft.report.add(
        text.where, located(path, graph_messages::imported_input_unknown(
                                      candidate.use, choices_text(text.name, names_of(info.inputs)))));
  try {
    const Target target = find_target(draft, text.from);
    const std::string fault =
        target.unclear ? "" : misfit(candidate.name, nth(info.inputs, input), text.from, target);
    if (!fault.empty()) throw Error(fault);
    Wire& wire = nth(candidate.wires, input);
    wire = {};
    wire.from = target.source;
    wire.max_age_ns = text.max_age_ns.value_or(candidate.text->max_age_ns.value_or(Wire::unsaid));
    wire.delayed = text.delayed;
    wire.where = text.where;
  } catch (const Error& fault) {
    report(draft, text.where, path, fault);
  }
}

/// The wires that a role brings, except where the component has its own.
void connect_by_role(Draft& draft, std::size_t index, const RoleText& role) {
  const Candidate& candidate = draft.candidates[index];
  for (const WireText& wire : role.in) {
    const int input = candidate.info().input(wire.name);
    if (input < 0 || find_named(candidate.text->in, wire.name)) continue;
    const Source before = nth(candidate.wires, input).from;
    connect(draft, index, wire, "roles." + role.name + ".in." + wire.name);
    if (before.kind != Source::Kind::none && before != nth(candidate.wires, input).from)
      draft.report.add(candidate.where, graph_messages::role_inputs_conflict(candidate.name, wire.name));
  }
}

/// Checks the wires of a role even when no filler uses them, to find typing errors.
void check_role_wires(Draft& draft, const RoleDraft& role) {
  for (const WireText& wire : role.text->in) {
    const std::string path = "roles." + role.name + ".in." + wire.name;
    if (wire.from.owner.empty()) continue;
    try {
      find_target(draft, wire.from);
    } catch (const Error& fault) {
      report(draft, wire.where, path, fault);
    }
    std::vector<std::string> inputs;
    for (const int f : role.fillers)
      if (const Candidate& filler = nth(draft.candidates, f); filler.loaded)
        for (const Port& port : filler.info().inputs) inputs.push_back(port.name);
    const bool known = std::find(inputs.begin(), inputs.end(), wire.name) != inputs.end();
    const std::string near = nearest(wire.name, inputs);
    if (!known && !near.empty() && !role.unclear)
      draft.report.add(wire.where, located(path, graph_messages::role_input_unknown(role.name, near)));
  }
}

}  // namespace

Target find_target(const Draft& draft, const PortName& name) {
  const int role = draft.role(name.owner);
  if (role >= 0) return role_target(draft, role, name);
  const int candidate = draft.candidate(name.owner);
  if (candidate >= 0) return component_target(draft, candidate, name);
  if (draft.text.component(name.owner)) throw NoOwner(name.owner, not_there(draft, name.owner));
  std::vector<std::string> names = names_of(draft.roles);
  for (const Candidate& other : draft.candidates) names.push_back(other.name);
  throw NoOwner(name.owner, types_messages::name_unknown("role or component", name.owner,
                                                         choices_text(name.owner, names)));
}

void resolve_wires(Draft& draft) {
  for (const RoleDraft& role : draft.roles) check_role_wires(draft, role);
  for (std::size_t i = 0; i < draft.candidates.size(); ++i) {
    Candidate& candidate = draft.candidates[i];
    if (!candidate.loaded) continue;
    candidate.wires.resize(candidate.info().inputs.size());
    for (const int r : candidate.roles) connect_by_role(draft, i, *nth(draft.roles, r).text);
    for (const WireText& wire : candidate.text->in)
      connect(draft, i, wire, "components." + candidate.name + ".in." + wire.name);
  }
  mark_imports(draft);
}

namespace {

/// Outputs that fit an input, as suggestions: by role where there are roles.
std::vector<std::string> proposals(const Draft& draft, const Candidate& reader, const Port& input) {
  std::vector<std::string> names;
  const auto offer = [&](const PortName& from, const Target& target) {
    if (!target.type || target.type->name != input.type->name) return;
    if (misfit(reader.name, input, from, target).empty()) names.push_back(from.text());
  };
  for (std::size_t r = 0; r < draft.roles.size(); ++r) {
    if (reader.fills(static_cast<int>(r))) continue;
    for (const RoleOutText& out : draft.roles[r].text->out) {
      const PortName from{draft.roles[r].text->name, out.name};
      offer(from, role_target(draft, static_cast<int>(r), from));
    }
  }
  for (std::size_t i = 0; i < draft.candidates.size(); ++i) {
    const Candidate& writer = draft.candidates[i];
    if (&writer == &reader || !writer.loaded || !writer.roles.empty()) continue;
    for (const Port& port : writer.info().outputs)
      offer({writer.name, port.name}, component_target(draft, static_cast<int>(i), {writer.name, port.name}));
  }
  return names;
}

bool wire_reported(const Draft& draft, const Candidate& candidate, const std::string& input) {
  const bool own = find_named(candidate.text->in, input) != nullptr;
  return own || std::any_of(candidate.roles.begin(), candidate.roles.end(), [&](int role) {
           return find_named(nth(draft.roles, role).text->in, input) != nullptr;
         });
}

}  // namespace

void check_fed(Draft& draft) {
  for (const Candidate& candidate : draft.candidates) {
    if (!candidate.loaded || candidate.roles.size() < candidate.text->fills.size())
      continue;  // wires of an unknown role are unknown
    for (std::size_t i = 0; i < candidate.wires.size(); ++i) {
      const Port& input = candidate.info().inputs[i];
      if (input.kind != FULMAR_IN_VALUE || input.optional) continue;
      const Wire& wire = candidate.wires[i];
      const std::string path = "components." + candidate.name + ": the input '" + input.name + "' ";
      if (wire.from.kind == Source::Kind::none) {
        const WireText* const own = find_named(candidate.text->in, input.name);
        if (own && own->cut) draft.report.add(own->where, graph_messages::input_disconnected(path));
        if (wire.import >= 0 || wire_reported(draft, candidate, input.name)) continue;
        const std::vector<std::string> fitting = proposals(draft, candidate, input);
        draft.report.add(
            candidate.where,
            graph_messages::input_not_connected(
                path, fitting.empty() ? "there is no output of type " + input.type->name
                                      : "outputs of type " + input.type->name + ": " + join(fitting)));
      } else if (wire.from.kind == Source::Kind::role && candidate.used) {
        const Role& role = nth(draft.graph.roles, wire.from.index);
        if (provided(draft.graph, wire.from) || nth(draft.roles, wire.from.index).unclear) continue;
        draft.report.add(wire.where, graph_messages::output_not_provided(
                                         path, role.name, nth(role.outputs, wire.from.output).name));
      }
    }
  }
}

// ---- order

namespace {

struct Edge {
  int from = -1;
  Where where;
};

/// [component] -> the steps that must precede it. The vehicle is read first and written last: it makes no
/// edge.
std::vector<std::vector<Edge>> edges_of(const Graph& graph) {
  std::vector<std::vector<Edge>> before(graph.components.size());
  for (std::size_t i = 0; i < graph.components.size(); ++i) {
    if (static_cast<int>(i) == graph.vehicle) continue;
    for (const Wire& wire : graph.components[i].wires) {
      if (wire.delayed || wire.from.kind == Source::Kind::none) continue;
      std::vector<int> writers{wire.from.index};
      if (wire.from.kind == Source::Kind::role) writers = nth(graph.roles, wire.from.index).fillers;
      for (const int writer : writers)
        if (writer != graph.vehicle) before[i].push_back({writer, wire.where});
    }
  }
  return before;
}

/// Steps that wait for each other contain a cycle: walk back until a step occurs twice.
void report_cycle(Draft& draft, const std::vector<std::vector<Edge>>& before, const std::vector<bool>& done) {
  const auto open = [&](int i) { return !nth(done, i); };
  int at = 0;
  while (!open(at) || at == draft.graph.vehicle) ++at;
  std::vector<int> walked;
  while (std::find(walked.begin(), walked.end(), at) == walked.end()) {
    walked.push_back(at);
    for (const Edge& edge : nth(before, at))
      if (open(edge.from)) {
        at = edge.from;
        break;
      }
  }
  walked.erase(walked.begin(), std::find(walked.begin(), walked.end(), at));
  std::reverse(walked.begin(), walked.end());
  std::rotate(walked.begin(), std::min_element(walked.begin(), walked.end()), walked.end());
  std::string path;
  for (const int i : walked) path += nth(draft.graph.components, i).name + " -> ";
  Where where;
  for (const Edge& edge : nth(before, walked.front()))
    if (edge.from == walked.back()) where = edge.where;
  draft.report.add(where,
                   graph_messages::connection_cycle(path, nth(draft.graph.components, walked.front()).name));
}

}  // namespace

void order_steps(Draft& draft) {
  Graph& graph = draft.graph;
  const std::size_t n = graph.components.size();
  const auto before = edges_of(graph);
  std::vector<bool> done(n, false);
  const std::size_t steps = n - (graph.vehicle >= 0 ? 1 : 0);
  while (graph.order.size() < steps) {
    std::size_t next = n;
    for (std::size_t i = 0; i < n && next == n; ++i) {
      if (done[i] || static_cast<int>(i) == graph.vehicle) continue;
      if (std::all_of(before[i].begin(), before[i].end(),
                      [&](const Edge& edge) { return nth(done, edge.from); }))
        next = i;
    }
    if (next == n) return report_cycle(draft, before, done);
    done[next] = true;
    graph.order.push_back(static_cast<int>(next));
  }
}

}  // namespace fulmar::core
