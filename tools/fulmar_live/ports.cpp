// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/ports.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/messages.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

struct PathWord {
  std::string name;
  std::vector<std::uint32_t> index;  // of [3]; one at most
};

/// "waypoints[3].airspeed_mps" -> words. Throws Error.
std::vector<PathWord> path_words(const std::string& field) {
  std::vector<PathWord> words;
  for (std::size_t from = 0; from <= field.size();) {
    const std::size_t dot = std::min(field.find('.', from), field.size());
    PathWord word{field.substr(from, dot - from), {}};
    if (const std::size_t open = word.name.find('['); open != std::string::npos) {
      std::uint32_t index = 0;
      const char* end = word.name.data() + word.name.size();
      const auto [at, code] = std::from_chars(word.name.data() + open + 1, end, index);
      if (code != std::errc{} || at + 1 != end || *at != ']')
        throw Error(remote_messages::index_invalid(word.name));
      word.index.push_back(index);
      word.name.resize(open);
    }
    words.push_back(word);
    from = dot + 1;
  }
  return words;
}

/// By its own name or the displayed one.
const Field* find_field(const Type& type, const std::string& name) {
  if (const Field* found = type.find(name)) return found;
  for (const Field& f : type.fields)
    if (shown_name(f.name) == name) return &f;
  return nullptr;
}

/// The name of the field in the message, and the displayed one.
struct Names {
  std::string own, shown;
};
Names check_field(const Type& type, const std::string& field, const std::string& port) {
  Names names;
  const Type* at = &type;
  std::string path = port;
  for (const PathWord& word : path_words(field)) {
    if (!at) throw Error(remote_messages::field_is_scalar(path, word.name));
    const Field* found = find_field(*at, word.name);
    if (!found) {
      std::vector<std::string> choices;
      for (const Field& f : at->fields) choices.push_back(shown_name(f.name));
      throw Error(remote_messages::field_unknown(path, word.name, choices_text(word.name, choices)));
    }
    path += "." + word.name;
    if (!word.index.empty() && found->shape == FULMAR_SCALAR)
      throw Error(remote_messages::list_expected(path));
    if (!word.index.empty() && word.index[0] >= found->count)
      throw Error(remote_messages::index_out_of_range(path, found->count, found->count - 1));
    const std::string index = word.index.empty() ? "" : "[" + std::to_string(word.index[0]) + "]";
    names.own += (names.own.empty() ? "" : ".") + found->name + index;
    names.shown += (names.shown.empty() ? "" : ".") + shown_name(found->name) + index;
    at = found->shape == FULMAR_SCALAR || !word.index.empty() ? found->type.get() : nullptr;
  }
  return names;
}

std::string owner_of(const std::string& port) { return port.substr(0, port.find('.')); }

/// Topic of an output by the name of its component, where the topic has that of the role.
std::string topic_by_component(const json& view, const std::string& component, const std::string& port) {
  for (const json& c : view.value("components", json::array())) {
    if (c.value("name", "") != component) continue;
    for (const json& p : c.value("outputs", json::array()))
      if (p.value("name", "") == port) return p.value("topic", "");
  }
  return "";
}

[[noreturn]] void unknown(Session& session, const std::string& owner, const std::string& port) {
  std::set<std::string> owners, ports;
  for (const std::string& name : port_names(session)) {
    owners.insert(owner_of(name));
    if (owner_of(name) == owner) ports.insert(name.substr(owner.size() + 1));
  }
  if (ports.empty())
    throw Error(remote_messages::owner_unknown(owner, choices_text(owner, {owners.begin(), owners.end()})));
  const std::vector<std::string> choices(ports.begin(), ports.end());
  if (port.empty()) throw Error(remote_messages::port_name_expected(owner, owner, join(choices)));
  throw Error(remote_messages::port_unknown(owner, port, choices_text(port, choices)));
}

}  // namespace

std::string topic_of(const std::string& port) { return "/" + slashed(port); }

std::string port_of(const std::string& topic) {
  std::string port = topic.substr(topic.starts_with('/') ? 1 : 0);
  std::replace(port.begin(), port.end(), '/', '.');
  return port;
}

PortField find_port(Session& session, const std::string& name) {
  const std::string dotted = port_of(name);
  const std::size_t dot = dotted.find('.');
  const std::string owner = dotted.substr(0, dot);
  std::string rest = dot == std::string::npos ? "" : dotted.substr(dot + 1);
  const std::string port = rest.substr(0, rest.find('.'));
  const auto& channels = session.channels();

  PortField found;
  found.topic = "/" + owner + "/" + port;
  const auto has_probe = [&] {
    const std::string probes = "/" + owner + "/probes";
    return channels.contains(probes) && find_field(*session.type(probes), port) != nullptr;
  };
  if (port.empty()) unknown(session, owner, "");
  bool known = channels.contains(found.topic);
  if (!known && has_probe()) {
    found.topic = "/" + owner + "/probes";
    rest = "probes." + rest;
    known = true;
  }
  if (!known) {
    found.topic = topic_by_component(session.view(), owner, port);
    if (!channels.contains(found.topic)) unknown(session, owner, port);
  }
  found.type = session.type(found.topic);
  const std::size_t next = rest.find('.');
  found.label = port_of(found.topic);
  if (next == std::string::npos) return found;
  const Names names = check_field(*found.type, rest.substr(next + 1), found.label);
  found.field = names.own;
  found.label += "." + names.shown;
  return found;
}

std::vector<std::string> port_names(Session& session) {
  std::set<std::string> names;
  for (const auto& [topic, channel] : session.channels()) names.insert(port_of(topic));
  for (const json& c : session.view().value("components", json::array()))
    for (const json& p : c.value("outputs", json::array()))
      if (session.channels().contains(p.value("topic", "")))
        names.insert(c.value("name", "") + "." + p.value("name", ""));
  return {names.begin(), names.end()};
}

nlohmann::ordered_json part_of(const nlohmann::ordered_json& message, const std::string& field) {
  const nlohmann::ordered_json* at = &message;
  if (field.empty()) return message;
  for (const PathWord& word : path_words(field)) {
    if (!at->is_object()) return nullptr;
    const auto found = at->find(shown_name(word.name));
    if (found == at->end()) return nullptr;
    at = &*found;
    if (word.index.empty()) continue;
    if (!at->is_array() || word.index[0] >= at->size()) return nullptr;
    at = &(*at)[word.index[0]];
  }
  return *at;
}

}  // namespace fulmar::core
