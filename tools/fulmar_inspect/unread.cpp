// SPDX-License-Identifier: BSD-3-Clause
// Ports that may stay open and seem to belong together: an output without a reader and an input without a
// source, of one type that no other port has.
#include <algorithm>

#include "tools/fulmar_inspect/advice.hpp"
#include "tools/fulmar_inspect/messages.hpp"

namespace fulmar::core {
namespace {

/// A port of a component of the graph.
struct Open {
  const Component* owner = nullptr;
  const Port* port = nullptr;
  std::string text() const { return owner->name + "." + port->name; }
};

bool is_read(const Graph& graph, const Component& writer, int output) {
  const int index = index_named(graph.components, writer.name);
  const auto from_role = [&](const Source& from) {
    const Role& role = nth(graph.roles, from.index);
    for (std::size_t f = 0; f < role.fillers.size(); ++f)
      if (role.fillers[f] == index && nth(role.provides[f], from.output) == output) return true;
    return false;
  };
  for (const Component& reader : graph.components)
    for (const Wire& wire : reader.wires)
      if (wire.from == Source{Source::Kind::component, index, output} ||
          (wire.from.kind == Source::Kind::role && from_role(wire.from)))
        return true;
  const std::string name = writer.name + "." + nth(writer.info().outputs, output).name;
  return std::any_of(graph.dds.exports.begin(), graph.dds.exports.end(),
                     [&](const DdsOptions::Export& e) { return e.port == name; });
}

/// The only output of that type; no value when there are several.
Open only_writer(const Graph& graph, const Port& input, const Component& reader) {
  Open found;
  for (const Component& c : graph.components)
    for (const Port& out : c.info().outputs) {
      if (!out.type || out.type->name != input.type->name) continue;
      if (found.port || &c == &reader || c.info().vehicle) return {};
      found = {&c, &out};
    }
  return found;
}

}  // namespace

void add_unread(const Graph& graph, Advice& advice) {
  for (const Component& reader : graph.components)
    for (std::size_t i = 0; i < reader.wires.size(); ++i) {
      const Port& input = reader.info().inputs[i];
      const bool open = input.optional || input.kind == FULMAR_IN_QUEUE;
      const Wire& wire = reader.wires[i];
      if (!open || input.kind == FULMAR_IN_REQUEST || wire.from.kind != Source::Kind::none ||
          wire.import >= 0)
        continue;
      const Open writer = only_writer(graph, input, reader);
      if (!writer.port || !incompatibility(*writer.port->type, *input.type).empty()) continue;
      const Open to{&reader, &input};
      const std::string wiring = reader.name + ": {in: {" + input.name + ": " + writer.text() + "}}";
      const bool read = is_read(graph, *writer.owner, writer.owner->info().output(writer.port->name));
      if (!read && writer.port->kind != FULMAR_OUT_VALUE)
        advice.push_back(located(
            writer.owner->where,
            inspect_messages::output_without_reader(writer.text(), to.text(), input.type->name, wiring)));
      else if (read && input.kind == FULMAR_IN_QUEUE)
        advice.push_back(located(reader.where, inspect_messages::input_without_source(
                                                   to.text(), writer.text(), input.type->name, wiring)));
    }
}

}  // namespace fulmar::core
