// SPDX-License-Identifier: BSD-3-Clause
// `fulmar call | phase | swap | reset`: requests to a flight.
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/graph/catalogue.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/yaml.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

/// Converts YAML to JSON. A value other than a number, flag or null is text: the flight parses "80 m".
json to_json(const Node& node) {
  if (node.is(Node::Kind::map)) {
    json object = json::object();
    for (const Node::Entry& entry : node.entries) object[entry.key] = to_json(entry.value);
    return object;
  }
  if (node.is(Node::Kind::sequence)) {
    json list = json::array();
    for (const Node& item : node.items) list.push_back(to_json(item));
    return list;
  }
  if (!node.is(Node::Kind::scalar)) return nullptr;
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  const json number = json::parse(node.text, nullptr, false);
  return number.is_number() ? number : json(node.text);
}

json read_yaml(const std::string& text) {
  Report report;
  const Node node = parse_yaml(make_source(text, "'" + text + "'"), report);
  report.throw_if_any();
  return to_json(node);
}

json message_of(const std::vector<std::string>& words) {
  if (words.empty()) return json::object();
  if (words.size() == 1 && words[0].starts_with('{')) {
    json message = read_yaml(words[0]);
    if (!message.is_object()) throw WrongUsage(remote_messages::map_expected(words[0]));
    return message;
  }
  json message = json::object();
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw WrongUsage(remote_messages::field_form_invalid(word));
    const std::string field = word.substr(0, equals);
    if (message.contains(field)) throw WrongUsage(remote_messages::field_duplicate(field));
    message[field] = read_yaml(word.substr(equals + 1));
  }
  return message;
}

int report(const Session::Verdict& verdict, const std::string& what) {
  if (verdict.accepted) {
    std::printf("%s: accepted\n", what.c_str());
    return 0;
  }
  std::fprintf(stderr, "%s\n", remote_messages::request_rejected(what, verdict.reason).text.c_str());
  return 1;
}

/// "/plan/add_waypoints" of "plan.add_waypoints". Throws Error with the choices.
std::string request_service(const json& view, const std::string& name) {
  std::vector<std::string> names;
  for (const json& c : view.value("components", json::array()))
    for (const json& p : c.value("inputs", json::array()))
      if (p.value("request", false)) names.push_back(c.value("name", "") + "." + p.value("name", ""));
  for (const std::string& known : names)
    if (known == name) return "/" + name.substr(0, name.find('.')) + "/" + name.substr(name.find('.') + 1);
  throw Error(remote_messages::request_unknown(name, choices_text(name, names)));
}

/// Rejects a message with all fields 0, which is probably an error: a waypoint at 0, 0, 0, or not armed.
void require_no_fields(Session& session, const std::string& service, const std::string& name) {
  if (!session.channels().contains(service)) return;
  std::vector<std::string> fields;
  for (const Field& f : session.type(service)->fields) fields.push_back(f.name);
  if (!fields.empty()) throw WrongUsage(remote_messages::field_missing(name, fields.front(), join(fields)));
}

/// Absolute path of a plugin file, "my_law.so" or "my_law.so/Law", because the host has another current
/// directory. Other words are passed on: "control_slc/Outer".
std::string swap_file(const std::string& word) {
  const auto [file, part] = split_use(word);
  std::error_code fault;
  const bool plugin = word.ends_with(".so") || word.ends_with(".py");
  if (!plugin && word.find_first_of("./") != std::string::npos &&
      std::filesystem::is_regular_file(word, fault))
    throw Error(remote_messages::plugin_expected(word));  // not PLUGIN/COMPONENT
  if (!(file.ends_with(".so") || file.ends_with(".py")) || !std::filesystem::is_regular_file(file, fault))
    return word;
  return std::filesystem::absolute(file, fault).string() + (part.empty() ? "" : "/" + part);
}

}  // namespace

int call_command(const LiveAddress& target, const std::string& request,
                 const std::vector<std::string>& words) {
  const json message = message_of(words);
  Session session(target);
  std::string name = request;
  if (name.starts_with('/')) name.erase(0, 1);
  if (const std::size_t slash = name.find('/'); slash != std::string::npos) name[slash] = '.';
  const json view = session.view();
  const std::string service = request_service(view, name);
  if (message.empty()) require_no_fields(session, service, name);
  const bool paused = view.value("paused", false);
  if (paused) session.be_patient(std::chrono::milliseconds(1000));  // faults are reported at once
  try {
    return report(session.order(service, message), name);
  } catch (const Session::NoAnswer&) {
    if (!paused) throw;
    std::printf("%s: taken, and answered in the next tick: the flight is paused\n", name.c_str());
    return 0;
  }
}

int phase_command(const LiveAddress& target, const std::string& phase) {
  Session session(target);
  const json view = session.view();
  const std::vector<std::string> phases = view.value("phases", std::vector<std::string>());
  bool known = false;
  for (const std::string& name : phases) known = known || name == phase;
  if (!known) throw Error(remote_messages::phase_unknown(phase, choices_text(phase, phases)));
  return report(session.order("/fulmar/phase", {{"phase", phase}}), "phase " + phase);
}

int swap_command(const LiveAddress& target, const std::string& component, const std::string& file) {
  Session session(target);
  std::vector<std::string> names;
  const json view = session.view();
  for (const json& c : view.value("components", json::array())) names.push_back(c.value("name", ""));
  bool known = false;
  for (const std::string& name : names) known = known || name == component;
  if (!known) throw Error(remote_messages::component_unknown(component, choices_text(component, names)));
  const Session::Verdict verdict =
      session.order("/fulmar/swap", {{"component", component}, {"file", swap_file(file)}});
  const int code = report(verdict, "swap " + component);
  if (!verdict.accepted) return code;
  const json after = session.view();
  for (const json& c : after.value("components", json::array()))
    if (const std::string words = c.value("swapped", ""); c.value("name", "") == component && !words.empty())
      std::printf("%s\n", words.c_str());
  return code;
}

int reset_command(const LiveAddress& target) {
  Session session(target);
  return report(session.order("/fulmar/reset_guards", json::object()), "reset");
}

}  // namespace fulmar::core
