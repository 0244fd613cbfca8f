// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/command/command.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/graph/params.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

/// Text of a log field, up to its room.
template <std::size_t N>
void put_whole(std::array<char, N>& to, const std::string& text, const char* what) {
  if (text.size() >= N) throw Error(run_messages::text_too_long(what, text, N - 1));
  put(to, text);
}

}  // namespace

Command command_of(CommandKind kind, std::string component, std::string name) {
  Command c;
  c.kind = kind;
  c.component = std::move(component);
  c.name = std::move(name);
  return c;
}

CommandNote swap_note(const std::string& component, const PluginInfo& plugin) {
  CommandNote note;
  note.kind = CommandKind::swap;
  put_whole(note.component, component, "the name");
  put_whole(note.text, plugin.file, "the name");
  put_whole(note.version, plugin.version, "the version");
  put_whole(note.sha256, plugin.sha256, "the SHA-256");
  return note;
}

namespace {

/// Whether `integer` is the value; `number` is then equal.
bool is_whole(const ParamInfo& info) {
  return info.kind == FULMAR_FLAG || info.kind == FULMAR_COUNT || info.kind == FULMAR_CHOICE;
}

}  // namespace

ParamValue value_of(const CommandNote& note, const ParamInfo& info) {
  ParamValue value;
  std::copy(note.number.begin(), note.number.end(), std::begin(value.number));
  value.integer = note.integer;
  if (info.kind == FULMAR_STRING) value.text = note.text.data();
  if (info.kind == FULMAR_CHOICE) {  // by its label: another version of the plugin may have another order
    const std::string word = note.text.data();
    const auto choice = std::find(info.choices.begin(), info.choices.end(), word);
    if (choice == info.choices.end())
      throw Error(run_messages::choice_unknown(note.component.data(), info.name, word,
                                               choices_text(word, info.choices)));
    value.integer = choice - info.choices.begin();
  }
  if (is_whole(info)) value.number[0] = static_cast<double>(value.integer);
  return value;
}

void check_live(const std::string& component, const ParamInfo& info) {
  if (!info.live || info.kind == FULMAR_RECORD || info.kind == FULMAR_BLOB)
    throw Error(run_messages::parameter_not_live(component, info.name));
}

CommandTable::CommandTable(const Graph& graph) {
  phases_ = names_of(graph.phases);
  for (const Component& c : graph.components) {
    Party party{c.name, c.plugin, &c.info(), {}};
    for (std::size_t i = 0; i < c.wires.size(); ++i) {
      const Port& port = c.info().inputs[i];
      if (port.kind == FULMAR_IN_REQUEST || c.wires[i].import >= 0)
        party.entrances.push_back(
            {port.name, i, c.wires[i].import, port.type, std::make_shared<const Guard>(*port.type)});
    }
    parties_.push_back(std::move(party));
  }
}

std::size_t CommandTable::component(const std::string& name) const {
  const int at = index_named(parties_, name);
  if (at < 0) throw Error(no_such("component", name, parties_));
  return static_cast<std::size_t>(at);
}

std::size_t CommandTable::param(std::size_t component, const std::string& name) const {
  const Party& party = parties_[component];
  if (const ParamPath at = param_path(*party.info, name); !at.field.empty())
    check_live(party.name, nth(party.info->params, at.param));
  return static_cast<std::size_t>(
      require_named(party.info->params, name, "'" + party.name + "'", "parameter"));
}

const CommandTable::Entrance& CommandTable::entrance(std::size_t component, const std::string& port,
                                                     bool imported) const {
  std::vector<std::string> names;
  for (const Entrance& e : parties_[component].entrances) {
    if ((e.import >= 0) != imported) continue;
    names.push_back(e.port);
    if (e.port == port) return e;
  }
  throw Error(run_messages::entrance_unknown(parties_[component].name,
                                             imported ? "imported samples for" : "request", port,
                                             choices_text(port, names)));
}

std::size_t CommandTable::phase(const std::string& name) const {
  const auto at = std::find(phases_.begin(), phases_.end(), name);
  if (at == phases_.end()) throw Error(run_messages::phase_unknown(name, choices_text(name, phases_)));
  return static_cast<std::size_t>(at - phases_.begin());
}

void CommandTable::prepare_parameter(Command& c) const {
  c.part = param(c.at, c.name);
  const ParamInfo& info = parties_[c.at].info->params[c.part];
  check_live(c.component, info);
  const bool ranged = info.kind == FULMAR_NUMBER || info.kind == FULMAR_COUNT;
  const double number = info.kind == FULMAR_NUMBER ? c.value.number[0] : static_cast<double>(c.value.integer);
  if (ranged && !(number >= info.min && number <= info.max))
    throw Error(run_messages::value_out_of_range(c.component, c.name, number, info.min, info.max,
                                                 info.unit.empty() ? "" : " " + info.unit));
  if (is_whole(info)) c.value.number[0] = number;
  std::copy(std::begin(c.value.number), std::end(c.value.number), c.note.number.begin());
  c.note.integer = c.value.integer;
  put_whole(c.note.text, value_text(info, c.value), "the value");
}

void CommandTable::prepare_message(Command& c) const {
  const Entrance& e = entrance(c.at, c.name, c.kind == CommandKind::import);
  c.part = e.import >= 0 ? static_cast<std::size_t>(e.import) : e.input;
  if (c.message.size() != e.type->size)
    throw Error(run_messages::message_size_invalid(c.component, c.name, c.message.size(), e.type->name,
                                                   e.type->size));
  if (!e.guard->check(c.message.data()))
    throw Error(located(c.component + "." + c.name, e.guard->explain(c.message.data())));
}

void CommandTable::prepare(Command& c) const {
  if (c.kind != CommandKind::phase && c.kind != CommandKind::reset) {
    c.at = component(c.component);
    if (c.kind != CommandKind::swap) c.made_for = parties_[c.at].plugin;
  }
  c.note.kind = c.kind;
  put_whole(c.note.component, c.component, "the name");
  switch (c.kind) {
    case CommandKind::parameter: prepare_parameter(c); break;
    case CommandKind::request:
    case CommandKind::import: prepare_message(c); break;
    case CommandKind::phase: c.part = phase(c.name); break;
    case CommandKind::swap:  // reported when it is done
    case CommandKind::reset: return;
  }
  put_whole(c.note.name, c.name, c.kind == CommandKind::phase ? "the phase" : "the name");
}

}  // namespace fulmar::core
