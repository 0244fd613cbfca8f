// SPDX-License-Identifier: BSD-3-Clause
// Who was replaced and is still listened to. A mission that brings a path of its own, say, wires it to the
// follower; what goes on looking at the former manager, a scorer or `done`, then speaks of a flight that is
// not flown.
#include <cctype>
#include <optional>

#include "core/graph/draft.hpp"

namespace fulmar::core {
namespace {

/// An output that leads to the vehicle, and one input that it feeds there.
struct Steering {
  std::string port;  // of the output
  TypePtr type;
  int writer = -1;
  std::string words;  // "follow.path comes from search.path"
};

std::vector<Steering> what_steers(const Graph& graph, const std::vector<bool>& in_chain) {
  std::vector<Steering> list;
  for (std::size_t i = 0; i < graph.components.size(); ++i) {
    const Component& reader = graph.components[i];
    for (std::size_t k = 0; in_chain[i] && k < reader.wires.size(); ++k) {
      const Source& from = reader.wires[k].from;
      if (from.kind != Source::Kind::component) continue;
      const Component& writer = nth(graph.components, from.index);
      const Port& out = nth(writer.info().outputs, from.output);
      if (out.type && from.index != graph.vehicle)
        list.push_back({out.name, out.type, from.index,
                        reader.name + "." + reader.info().inputs[k].name + " comes from " + writer.name +
                            "." + out.name});
    }
  }
  return list;
}

/// Why a component does not steer although it could: another one's output of the same name and type does.
std::optional<std::string> bypassed_by(const Graph& graph, const std::vector<Steering>& steering, int index) {
  const Component& c = nth(graph.components, index);
  if (!c.roles.empty() || index == graph.vehicle) return std::nullopt;
  for (const Port& out : c.info().outputs)
    for (const Steering& s : steering)
      if (out.type && s.writer != index && out.name == s.port && out.type->hash == s.type->hash)
        return c.name + ", which does not steer: " + s.words;
  return std::nullopt;
}

bool names(const std::string& text, const std::string& component) {
  const std::string prefix = component + ".";
  for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at + 1))
    if (at == 0 || !(std::isalnum(static_cast<unsigned char>(text[at - 1])) || text[at - 1] == '_' ||
                     text[at - 1] == '.'))
      return true;
  return false;
}

}  // namespace

void tell_bypassed(Draft& draft) {
  Graph& graph = draft.graph;
  const std::vector<bool> in_chain = chain_to_vehicle(graph);
  const std::vector<Steering> steering = what_steers(graph, in_chain);
  for (std::size_t i = 0; i < graph.components.size(); ++i) {
    const int index = static_cast<int>(i);
    const auto why = in_chain[i] ? std::nullopt : bypassed_by(graph, steering, index);
    if (!why) continue;
    const auto warn = [&](const Where& where, const std::string& who, const char* does) {
      graph.warnings.push_back(where.text() + ": " + who + does + *why);
    };
    for (const Component& reader : graph.components)
      for (std::size_t k = 0; k < reader.wires.size(); ++k) {
        const Wire& wire = reader.wires[k];
        if (wire.from.kind == Source::Kind::component && wire.from.index == index)
          warn(wire.where, reader.name + "." + reader.info().inputs[k].name, " comes from ");
      }
    const std::string& name = graph.components[i].name;
    const auto condition = [&](const char* key, const std::optional<Word>& word) {
      if (word && names(word->text, name)) warn(word->where, key, " looks at ");
    };
    condition("done", draft.text.done);
    condition("failed", draft.text.failed);
    for (const Word& word : draft.text.progress)
      if (names(word.text, name)) warn(word.where, "progress", " shows ");
  }
}

}  // namespace fulmar::core
