// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_mission.hpp"

#include <algorithm>

#include "core/graph/catalogue.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/shipped.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

Node scalar(const std::string& text) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = text;
  return node;
}

Node map_of(const std::vector<std::pair<std::string, Node>>& entries) {
  Node node;
  node.kind = Node::Kind::map;
  for (const auto& [key, value] : entries) node.entries.push_back({key, 0, value});
  return node;
}

/// A file name that is valid in any folder.
std::string file_name(const fs::path& file) {
  const std::string shipped = shipped_name(file);
  return shipped.empty() ? file.string() : shipped;
}

/// Converts a file name in `node`, relative to the folder of its file, to one that is valid in any folder.
std::string file_word(const Node& node) {
  if (!node.file || node.file->path.empty() || node.text.empty()) return node.text;
  std::error_code code;
  const fs::path file = fs::absolute(node.file->path.parent_path() / node.text, code).lexically_normal();
  return fs::is_regular_file(file, code) ? file_name(file) : node.text;
}

std::string flow(const Node& node) {
  std::string text;
  const auto add = [&](const std::string& item) { text += (text.empty() ? "" : ", ") + item; };
  switch (node.kind) {
    case Node::Kind::scalar: break;
    case Node::Kind::sequence:
      for (const Node& item : node.items) add(flow(item));
      return "[" + text + "]";
    case Node::Kind::map:
      for (const Node::Entry& entry : node.entries) add(entry.key + ": " + flow(entry.value));
      return "{" + text + "}";
    default: return "~";
  }
  const std::string word = file_word(node);
  const bool special = word.empty() || word.find_first_of(",[]{}\"'\\#\n") != std::string::npos ||
                       word.find(": ") != std::string::npos;
  if (!node.quoted && !special) return word;
  for (const char c : word)
    text += c == '"' || c == '\\' ? std::string{'\\', c} : c == '\n' ? std::string("\\n") : std::string(1, c);
  return "\"" + text + "\"";
}

/// One line per key; sections of names have one line per name.
std::string block(const Node& root) {
  std::string text;
  for (const Node::Entry& entry : root.entries) {
    const bool section = entry.key == "components" || entry.key == "phases" || entry.key == "roles";
    if (!section || !entry.value.is(Node::Kind::map)) {
      text += entry.key + ": " + flow(entry.value) + "\n";
      continue;
    }
    text += entry.key + ":\n";
    for (const Node::Entry& item : entry.value.entries)
      text += "  " + item.key + ": " + flow(item.value) + "\n";
  }
  return text;
}

Node wire(const WireText& from) {
  if (!from.max_age_ns && !from.delayed) return scalar(from.from.text());
  std::vector<std::pair<std::string, Node>> keys{{"from", scalar(from.from.text())}};
  if (from.max_age_ns) keys.emplace_back("max_age", scalar(std::to_string(*from.max_age_ns) + " ns"));
  if (from.delayed) keys.emplace_back("delayed", scalar("true"));
  return map_of(keys);
}

std::string rate_text(double rate_hz) { return number_text(rate_hz) + " Hz"; }

/// A plugin next to the given mission is not next to the new one: returns its absolute name, or "" when it is
/// found by its name.
std::string plugin_beside(const MissionView& mission, const std::string& use) {
  auto [plugin, component] = split_use(use);
  std::error_code code;
  fs::path file = mission.file.parent_path() / (plugin.ends_with(".so") ? plugin : plugin + ".so");
  if (fs::path(plugin).is_absolute() || !fs::is_regular_file(file, code)) return "";
  return file.lexically_normal().string() + (component.empty() ? "" : "/" + component);
}

/// A second instance of the shipped component, without a role: its wires are those of the role and its own.
/// It supplies outputs for which another new role is the source.
Node reference(const MissionView& mission, const Contract& contract, const NewComponent& component,
               const ContractRole& role) {
  const ComponentText& shipped = *role.shipped_text;
  const std::string beside = plugin_beside(mission, shipped.use.text);
  std::vector<std::pair<std::string, Node>> keys{{"use", scalar(beside.empty() ? shipped.use.text : beside)}};
  if (shipped.rate_hz > 0) keys.emplace_back("rate", scalar(rate_text(shipped.rate_hz)));
  Node wires = map_of({});
  for (const WireText& own : shipped.in) wires.entries.push_back({own.name, 0, wire(own)});
  for (const WireText& common : mission.text.role(role.name)->in) {
    if (role.shipped.input(common.name) < 0 || wires.find(common.name)) continue;
    WireText from = common;
    for (std::size_t r = 0; r < contract.roles.size(); ++r)
      if (contract.roles[r].name == from.from.owner)
        from.from.owner = reference_name(mission, contract, component.name, r);
    wires.entries.push_back({common.name, 0, wire(from)});
  }
  if (!wires.entries.empty()) keys.emplace_back("in", std::move(wires));
  Node params = shipped.params;
  if (role.shipped_set.is(Node::Kind::map))
    params = params.is(Node::Kind::map) ? merged(params, role.shipped_set, 1) : role.shipped_set;
  if (params.is(Node::Kind::map)) keys.emplace_back("params", params);
  return map_of(keys);
}

Node fills(const Contract& contract) {
  if (contract.roles.size() == 1) return scalar(contract.roles[0].name);
  Node list;
  list.kind = Node::Kind::sequence;
  for (const ContractRole& role : contract.roles) list.items.push_back(scalar(role.name));
  return list;
}

Node new_component(const MissionView& mission, const Contract& contract, const NewComponent& component) {
  std::vector<std::pair<std::string, Node>> keys;
  if (!contract.roles.empty()) keys.emplace_back("fills", fills(contract));
  keys.emplace_back("use", scalar("build/lib/fulmar/" + component.name + ".so"));
  if (contract.rate_hz > 0) keys.emplace_back("rate", scalar(rate_text(contract.rate_hz)));
  Node wires = map_of({});
  if (contract.roles.empty())
    for (const ContractInput& input : contract.inputs)
      wires.entries.push_back({input.name, 0, scalar(input.from.text())});
  for (const ContractOutput& output : contract.outputs)
    if (std::count(component.references.begin(), component.references.end(), output.name) > 0)
      wires.entries.push_back(
          {"reference_" + output.name, 0,
           scalar(reference_name(mission, contract, component.name, output.role) + "." + output.name)});
  if (!wires.entries.empty()) keys.emplace_back("in", std::move(wires));
  return map_of(keys);
}

/// Changes of a component of the given mission: its plugin is found from the new folder, it is replaced, or
/// it gets a wire.
Node changed(const MissionView& mission, const Contract& contract, const NewComponent& component,
             const ComponentText& text) {
  const std::string beside = plugin_beside(mission, text.use.text);
  std::vector<std::pair<std::string, Node>> keys;
  if (!beside.empty()) keys.emplace_back("use", scalar(beside));
  const bool named_so = text.only && text.name == io_word(*text.only);
  const bool sits_there = contract.vehicle() && text.fills_role("vehicle") &&
                          (!text.only || (named_so && *text.only == mission.text.io));
  if (sits_there)  // replaced: there is one vehicle
    keys.emplace_back("only", scalar(io_word(mission.text.io == Io::sim ? Io::fcu : Io::sim)));
  for (const ContractFeed& feed : contract.feeds)
    if (feed.to.owner == text.name)  // delayed: usually the wire closes a loop through the new component
      keys.emplace_back("in",
                        map_of({{feed.to.port, map_of({{"from", scalar(component.name + "." + feed.output)},
                                                       {"delayed", scalar("true")}})}}));
  return map_of(keys);
}

/// Components and phases of the new mission that are merged into the given one.
Node additions(const MissionView& mission, const Contract& contract, const NewComponent& component) {
  Node components = map_of({});
  for (const ComponentText& text : mission.text.components) {
    Node keys = changed(mission, contract, component, text);
    if (!keys.entries.empty()) components.entries.push_back({text.name, 0, std::move(keys)});
  }
  if (!component.references.empty())
    for (std::size_t r = 0; r < contract.roles.size(); ++r)
      components.entries.push_back({reference_name(mission, contract, component.name, r), 0,
                                    reference(mission, contract, component, contract.roles[r])});
  components.entries.push_back({component.name, 0, new_component(mission, contract, component)});
  Node root = map_of({{"components", std::move(components)}});
  if (contract.vehicle() || contract.roles.empty()) return root;
  Node assigned = map_of({});
  for (const ContractRole& role : contract.roles)
    assigned.entries.push_back(
        {role.name, 0,
         map_of({{"use", scalar(component.name)}, {"fallback", scalar(role.shipped_text->name)}})});
  root.entries.push_back({"phases", 0, map_of({{contract.phase, std::move(assigned)}})});
  return root;
}

std::string head_of(const MissionView& mission, const Contract& contract, const NewComponent& component) {
  const std::string& name = component.name;
  std::string head = "# The mission " + contract.mission + " with " + name;
  if (contract.roles.empty()) return head + " beside it.\n";
  head +=
      std::string(" in the role") + (contract.roles.size() > 1 ? "s " : " ") + contract.role_words() + ". ";
  if (contract.vehicle()) return head + "The vehicle that was there steps aside.\n";
  head += "It flies in the phase " + contract.phase + "; " + contract.shipped_words() +
          ", which flew there, " + (contract.roles.size() > 1 ? "take" : "takes") + " over if it fails.\n";
  if (component.references.empty()) return head;
  for (std::size_t r = 0; r < contract.roles.size(); ++r)
    head += "# " + reference_name(mission, contract, name, r) + " is " + contract.roles[r].shipped_use +
            " once more: what " + name + " passes on until it has a law of its own.\n";
  return head;
}

}  // namespace

std::string reference_name(const MissionView& mission, const Contract& contract, const std::string& name,
                           std::size_t role) {
  const std::string plain =
      contract.roles.size() > 1 ? "reference_" + contract.roles[role].name : "reference";
  const bool taken = name == plain || mission.text.component(plain) || mission.text.role(plain);
  return taken ? name + "_" + plain : plain;
}

std::string write_mission(const MissionView& mission, const Contract& contract,
                          const NewComponent& component) {
  const Node* extends = mission.root.find("extends");
  std::error_code code;
  Node root = map_of({{"mission", scalar(component.name)}});
  if (extends) {
    root.entries.push_back({"extends", 0, *extends});
    for (const Node::Entry& entry : mission.root.entries)
      if (entry.key != "mission" && entry.key != "extends") root.entries.push_back(entry);
  } else {
    root.entries.push_back({"extends", 0, scalar(file_name(mission.file))});
  }
  const Node top = additions(mission, contract, component);
  for (const Node::Entry& entry : top.entries) {
    const auto same = std::find_if(root.entries.begin(), root.entries.end(),
                                   [&](const Node::Entry& e) { return e.key == entry.key; });
    if (same == root.entries.end())
      root.entries.push_back(entry);
    else
      same->value = merged(same->value, entry.value, entry.key == "components" ? 3 : 2);
  }
  return head_of(mission, contract, component) + block(root);
}

}  // namespace fulmar::core
