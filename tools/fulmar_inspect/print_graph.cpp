// SPDX-License-Identifier: BSD-3-Clause
// The graph as plain text, Graphviz dot, Mermaid.
#include "tools/fulmar_inspect/print_graph.hpp"

#include <algorithm>

#include "core/graph/condition.hpp"
#include "core/graph/quantity.hpp"
#include "tools/fulmar_inspect/messages.hpp"

namespace fulmar::core {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string source_text(const Graph& graph, const Source& source) {
  if (source.kind == Source::Kind::none) return "-";
  if (source.kind == Source::Kind::role) {
    const Role& role = graph.roles[at(source.index)];
    return role.name + "." + role.outputs[at(source.output)].name;
  }
  const Component& component = graph.components[at(source.index)];
  return component.name + "." + component.info().outputs[at(source.output)].name;
}

std::string rate_text(const Graph& graph, const Component& component) {
  const std::int64_t period = component.period_ns > 0 ? component.period_ns : graph.tick_ns;
  const std::string rate = number_text(1e9 / static_cast<double>(period)) + " Hz";
  switch (component.run) {
    case RunMode::process: return inspect_messages::rate_in_child(rate).line();
    case RunMode::async:
      return rate + ", " + number_text(1e-6 * static_cast<double>(component.latency_ns)) + " ms later";
    case RunMode::driver: return inspect_messages::driver_thread().line();
    default: return rate;
  }
}

std::string role_text(const Graph& graph, const Component& component) {
  std::string text;
  for (const int role : component.roles) text += (text.empty() ? "" : ", ") + graph.roles[at(role)].name;
  return text.empty() ? "-" : text;
}

std::string seconds_text(std::int64_t ns) { return number_text(static_cast<double>(ns) / 1e9) + " s"; }

class Text {
 public:
  explicit Text(const Graph& graph) : graph_(graph) {}

  std::string print() {
    out_ = "mission " + graph_.mission + ", io " + io_word(graph_.io) + ", " +
           number_text(1e9 / static_cast<double>(graph_.tick_ns)) + " Hz, seed " +
           std::to_string(graph_.seed) + "\n";
    order();
    wires();
    phases();
    return out_;
  }

 private:
  void component(const std::string& first, const Component& c) {
    out_ += "  " + padded(first, 4) + padded(c.name, width_) + "  " + padded(c.use, use_width_) + "  " +
            padded(role_text(graph_, c), 8) + "  " + rate_text(graph_, c) + "\n";
  }

  void order() {
    for (const Component& c : graph_.components) {
      width_ = std::max(width_, c.name.size());
      use_width_ = std::max(use_width_, c.use.size());
    }
    out_ += "\norder of a tick\n";
    if (graph_.vehicle >= 0) component("in", graph_.components[at(graph_.vehicle)]);
    for (std::size_t i = 0; i < graph_.order.size(); ++i)
      component(std::to_string(i + 1), graph_.components[at(graph_.order[i])]);
    if (graph_.vehicle >= 0) component("out", graph_.components[at(graph_.vehicle)]);
  }

  void wires_of(const Component& c) {
    const auto& inputs = c.info().inputs;
    for (std::size_t i = 0; i < c.wires.size(); ++i) {
      const Wire& wire = c.wires[i];
      const std::string name = c.name + "." + inputs[i].name;
      std::string notes;
      if (wire.max_age_ns > 0) notes += ", at most " + seconds_text(wire.max_age_ns) + " old";
      if (wire.delayed) notes += ", of the tick before";
      out_ += "  " + padded(name, 24) + " <- " + padded(source_text(graph_, wire.from), 20) + "  " +
              (inputs[i].type ? inputs[i].type->name : "") + notes + "\n";
    }
  }

  void wires() {
    out_ += "\nwires\n";
    for (const int i : graph_.order) wires_of(graph_.components[at(i)]);
    if (graph_.vehicle >= 0) wires_of(graph_.components[at(graph_.vehicle)]);
  }

  void transition(const Transition& t) {
    out_ += "    -> " + (t.to < 0 ? std::string("?") : graph_.phases[at(t.to)].name) + " when " +
            (t.when ? t.when->text() : "?") + (t.for_ns > 0 ? " for " + seconds_text(t.for_ns) : "") + "\n";
  }

  void phases() {
    out_ += "\nphases\n";
    if (!graph_.any.empty()) out_ += "  any\n";
    for (const Transition& t : graph_.any) transition(t);
    for (const Phase& phase : graph_.phases) {
      out_ += "  " + phase.name + ":";
      for (std::size_t r = 0; r < phase.roles.size(); ++r) role(graph_.roles[r], phase.roles[r], r == 0);
      out_ += "\n";
      for (const Transition& t : phase.next) transition(t);
    }
  }

  void role(const Role& role, const Assignment& a, bool first) {
    out_ += (first ? " " : ", ") + role.name + " " +
            (a.component < 0 ? "-" : graph_.components[at(a.component)].name);
    if (a.set.empty() && a.fallback < 0) return;
    out_ += " (";
    for (std::size_t i = 0; i < a.set.size(); ++i) {
      const ParamInfo& param = graph_.components[at(a.component)].info().params[at(a.set[i].param)];
      out_ += (i > 0 ? ", " : "") + param.name;
    }
    if (!a.set.empty()) out_ += " set";
    if (a.fallback >= 0)
      out_ += std::string(a.set.empty() ? "" : "; ") + "fallback " + graph_.components[at(a.fallback)].name;
    out_ += ")";
  }

  const Graph& graph_;
  std::string out_;
  std::size_t width_ = 0, use_width_ = 0;
};

/// Every wire as component -> component with a label; a wire to a role comes from each of its fillers.
template <class F>
void each_edge(const Graph& graph, F edge) {
  for (std::size_t i = 0; i < graph.components.size(); ++i) {
    const Component& c = graph.components[i];
    for (const Wire& wire : c.wires) {
      if (wire.from.kind == Source::Kind::none) continue;
      if (wire.from.kind == Source::Kind::component) {
        edge(wire.from.index, static_cast<int>(i),
             graph.components[at(wire.from.index)].info().outputs[at(wire.from.output)].name, wire.delayed);
        continue;
      }
      const Role& role = graph.roles[at(wire.from.index)];
      for (std::size_t f = 0; f < role.fillers.size(); ++f)
        if (role.provides[f][at(wire.from.output)] >= 0)
          edge(role.fillers[f], static_cast<int>(i), role.outputs[at(wire.from.output)].name, wire.delayed);
    }
  }
}

std::string dot(const Graph& graph) {
  std::string name = graph.mission;
  std::replace(name.begin(), name.end(), '"', '\'');
  std::string out =
      "digraph \"" + name + "\" {\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n";
  for (const Role& role : graph.roles) {
    out += "  subgraph cluster_" + role.name + " {\n    label=\"" + role.name + "\";\n";
    for (const int f : role.fillers) out += "    " + graph.components[at(f)].name + ";\n";
    out += "  }\n";
  }
  for (const Component& c : graph.components)
    out += "  " + c.name + " [label=\"" + c.name + "\\n" + c.use + "\\n" + rate_text(graph, c) + "\"];\n";
  each_edge(graph, [&](int from, int to, const std::string& label, bool delayed) {
    out += "  " + graph.components[at(from)].name + " -> " + graph.components[at(to)].name + " [label=\"" +
           label + "\"" + (delayed ? ", style=dashed" : "") + "];\n";
  });
  return out + "}\n";
}

std::string mermaid(const Graph& graph) {
  std::string out = "flowchart LR\n";
  for (const Role& role : graph.roles) {
    out += "  subgraph role_" + role.name + "[" + role.name + "]\n";
    for (const int f : role.fillers) out += "    c_" + graph.components[at(f)].name + "\n";
    out += "  end\n";
  }
  for (const Component& c : graph.components)
    out += "  c_" + c.name + "[\"" + c.name + "<br/>" + c.use + "<br/>" + rate_text(graph, c) + "\"]\n";
  each_edge(graph, [&](int from, int to, const std::string& label, bool delayed) {
    out += "  c_" + graph.components[at(from)].name + (delayed ? " -. " : " -- ") + label +
           (delayed ? " .-> " : " --> ") + "c_" + graph.components[at(to)].name + "\n";
  });
  return out;
}

}  // namespace

std::string print_graph(const Graph& graph, const std::string& format) {
  if (format == "text") return Text(graph).print();
  if (format == "dot") return dot(graph);
  if (format == "mermaid") return mermaid(graph);
  throw Error(inspect_messages::format_unknown(format, choices_text(format, {"text", "dot", "mermaid"})));
}

}  // namespace fulmar::core
