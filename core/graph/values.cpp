// SPDX-License-Identifier: BSD-3-Clause
// Parameters of every component, later sources win: declared value <- airframe file <- mission-wide keys <-
// `params:` <- --set. And the failsafe values.
#include <algorithm>
#include <cmath>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/record.hpp"

namespace fulmar::core {
namespace {

/// The mission's airframe as a tree: a file, or a map in the mission itself.
struct AirframeSource {
  const Node* tree = nullptr;
  std::string name, path;  // path of the parameter, in faults
};

AirframeSource airframe_source(Draft& draft) {
  const Node& node = draft.text.node.airframe;
  if (node.is(Node::Kind::missing)) return {};
  if (node.is(Node::Kind::map)) return {&node, node.file->name, "airframe"};
  if (!scalar_text(node, "airframe", "the name of an airframe file, or a map", draft.report)) return {};
  const FilePtr file = draft.files.read(node, "airframe");
  if (!file) return {};
  const Node& tree = draft.files.tree(file);
  if (tree.is(Node::Kind::map)) return {&tree, file->path.filename().string(), ""};
  if (!tree.is(Node::Kind::missing))
    draft.report.add(tree.where(), graph_messages::airframe_map_expected(found_words(tree)));
  return {};
}

/// Suggests the path when the key is a field of one of the records.
Diagnostic no_parameter(const Candidate& candidate, const std::string& key, const std::string& path) {
  const ComponentInfo& info = candidate.info();
  const std::string first = key.substr(0, key.find_first_of(".["));
  for (const ParamInfo& param : info.params)
    if (param.kind == FULMAR_RECORD && field_of_key(*param.type, first)) {
      const std::string owner = path == candidate.name ? candidate.name + "." : "";  // the form of --set
      return located(path, graph_messages::parameter_in_record(candidate.use, key,
                                                               owner + param.name + "." + key, param.name));
    }
  return located(path, has_no(candidate.use, "parameter", key, info.params));
}

/// Fields of a record are set after all records: a whole record would overwrite them.
void set_params(Draft& draft, Candidate& candidate, const Node& map, const std::string& path) {
  const ComponentInfo& info = candidate.info();
  std::vector<std::pair<const Node::Entry*, ParamPath>> fields;
  for (const Node::Entry& entry : map.entries) {
    if (draft.report.full()) break;  // each further fault costs a hint
    const ParamPath at = param_path(info, entry.key);
    if (at.param < 0)
      draft.report.add(entry.where(), no_parameter(candidate, entry.key, path));
    else if (info.vehicle && (entry.key == "rate" || entry.key == "epoch"))
      draft.report.add(entry.where(),
                       graph_messages::mission_parameter_misplaced(path, entry.key, entry.key));
    else if (!at.field.empty())
      fields.emplace_back(&entry, at);
    else
      read_param(nth(info.params, at.param), entry.value, path + "." + entry.key,
                 nth(candidate.params, at.param), draft.files, draft.report);
  }
  for (const auto& [entry, at] : fields) {
    const ParamInfo& param = nth(info.params, at.param);
    read_param_field(param, at.field, entry->value, path + "." + param.name, nth(candidate.params, at.param),
                     draft.report);
  }
}

/// Section `params` of the airframe file: gains belong to the aircraft. Skips components that this mission
/// does not use.
void set_from_airframe(Draft& draft, Candidate& candidate, const AirframeSource& airframe) {
  const Node* sections = airframe.tree ? airframe.tree->find("params") : nullptr;
  const std::string prefix = airframe.path.empty() ? "params" : airframe.path + ".params";
  if (!sections ||
      !is_a(Node::Kind::map, *sections, prefix, "a map {plugin/Component: {parameter: value}}", draft.report))
    return;
  const auto [plugin, component] = split_use(candidate.use);
  for (const Node::Entry& entry : sections->entries) {
    const auto [for_plugin, for_component] = split_use(entry.key);
    const bool same_plugin = for_plugin == plugin || for_plugin == plugin + ".so";
    if (!same_plugin) continue;
    const auto& components = candidate.plugin->components;
    if (!for_component.empty() && !find_named(components, for_component))
      draft.report.add(entry.where(), located(prefix, has_no("the plugin " + plugin, "component",
                                                             for_component, components)));
    if (for_component.empty() ? candidate.index_in_plugin != 0 : for_component != component) continue;
    is_a(Node::Kind::map, entry.value, prefix + "." + entry.key, "a map {parameter: value}", draft.report);
    set_params(draft, candidate, entry.value, prefix + "." + entry.key);
  }
}

/// Values that the mission sets once for all components: airframe, origin, epoch, and the vehicle's rate.
void set_from_mission(Draft& draft, Candidate& candidate, const AirframeSource& airframe) {
  const ComponentInfo& info = candidate.info();
  for (std::size_t i = 0; i < info.params.size(); ++i) {
    const ParamInfo& param = info.params[i];
    ParamValue& value = candidate.params[i];
    if (param.kind == FULMAR_RECORD && param.name == "airframe" && airframe.tree)
      read_record(param, *airframe.tree, airframe.path, airframe.name, value, draft.report,
                  keys_beside_fields(param));
    if (param.kind == FULMAR_RECORD && param.name == "origin" && draft.text.node.origin.is(Node::Kind::map))
      read_record(param, draft.text.node.origin, "origin", draft.text.node.origin.file->name, value,
                  draft.report);
    // message stamps must have the epoch of the log
    if (param.kind == FULMAR_COUNT && param.name == "epoch")
      value.integer = std::clamp(draft.text.epoch_ns / 1'000'000'000, static_cast<std::int64_t>(param.min),
                                 static_cast<std::int64_t>(param.max));
    if (param.kind != FULMAR_NUMBER || !info.vehicle) continue;
    if (param.name == "rate") {
      value.number[0] = draft.text.rate_hz;
      if (value.number[0] < param.min || value.number[0] > param.max)
        draft.report.add(draft.text.rate_where.file.empty() ? candidate.where : draft.text.rate_where,
                         graph_messages::mission_rate_invalid(candidate.name, number_text(draft.text.rate_hz),
                                                              number_text(param.min), number_text(param.max),
                                                              candidate.use));
    }
    if (param.name == "epoch") value.number[0] = static_cast<double>(draft.text.epoch_ns) * 1e-9;
  }
}

void set_from_command(Draft& draft) {
  for (const auto& [name, text] : draft.overrides.set) {
    const Where where{"--set " + name + "=" + text, 0};
    const auto dot = name.find('.');
    const int i = draft.candidate(name.substr(0, dot));
    if (dot == std::string::npos) {
      draft.report.add(where, graph_messages::assignment_expected());
    } else if (i < 0) {
      if (!taken_away(draft, name.substr(0, dot), where, "--set"))
        draft.report.add(where, not_there(draft, name.substr(0, dot)));
    } else if (Candidate& candidate = nth(draft.candidates, i); candidate.loaded) {
      Node map;
      map.kind = Node::Kind::map;
      map.file = make_source(text, where.file);
      map.entries.push_back({name.substr(dot + 1), 0, parse_yaml(map.file, draft.report)});
      if (!map.entries[0].value.is(Node::Kind::missing)) set_params(draft, candidate, map, candidate.name);
    }
  }
}

void check_required(Draft& draft, const Candidate& candidate) {
  const ComponentInfo& info = candidate.info();
  for (std::size_t i = 0; i < info.params.size(); ++i) {
    const ParamInfo& param = info.params[i];
    if (!param.required || candidate.params[i].integer != 0 || candidate.text->params.find(param.name))
      continue;
    const Node* const whole = param.name == "airframe" ? &draft.text.node.airframe
                              : param.name == "origin" ? &draft.text.node.origin
                                                       : nullptr;
    if (whole && !whole->is(Node::Kind::missing)) continue;  // it was rejected: that is reported already
    draft.report.add(candidate.where,
                     graph_messages::parameter_missing(
                         candidate.name, param.name, param.doc.empty() ? "" : " (" + param.doc + ")",
                         whole ? "; give the mission's '" + param.name + "'" : "; give it under params"));
  }
}

}  // namespace

void read_values(Draft& draft) {
  const AirframeSource airframe = airframe_source(draft);
  const Node& origin = draft.text.node.origin;
  if (!origin.is(Node::Kind::missing))
    is_a(Node::Kind::map, origin, "origin", "a map such as {lat: 40.25, lon: -111.65, alt_msl: 1387 m}",
         draft.report);
  for (Candidate& candidate : draft.candidates) {
    if (!candidate.loaded) continue;
    for (const ParamInfo& param : candidate.info().params) candidate.params.push_back(initial_value(param));
    set_from_airframe(draft, candidate, airframe);
    set_from_mission(draft, candidate, airframe);
    set_params(draft, candidate, candidate.text->params, "components." + candidate.name + ".params");
  }
  set_from_command(draft);
  for (const Candidate& candidate : draft.candidates)
    if (candidate.loaded) check_required(draft, candidate);
}

// ---- failsafe

void read_failsafe(Draft& draft) {
  Graph& graph = draft.graph;
  if (graph.vehicle < 0) return;
  const ComponentInfo& info = draft.vehicle().info();
  const Node& node = draft.text.node.failsafe;
  if (node.is(Node::Kind::missing) ||
      !is_a(Node::Kind::map, node, "failsafe", "a map such as {throttle_frac: 0, for: 2 s}", draft.report))
    return;
  graph.failsafe.resize(info.inputs.size());
  std::vector<Node> parts(info.inputs.size());
  std::vector<std::string> names{"for"};
  for (const Port& port : info.inputs)
    for (std::size_t f = 0; port.kind == FULMAR_IN_VALUE && f < port.type->fields.size(); ++f)
      names.push_back(port.type->fields[f].name);
  for (const Node::Entry& entry : node.entries) {
    bool known = entry.key == "for";
    for (std::size_t i = 0; i < info.inputs.size() && !known; ++i) {
      if (info.inputs[i].kind != FULMAR_IN_VALUE || !field_of_key(*info.inputs[i].type, entry.key)) continue;
      known = true;
      parts[i].kind = Node::Kind::map;
      parts[i].entries.push_back(entry);
    }
    if (!known && !draft.report.full())
      draft.report.add(entry.where(),
                       graph_messages::failsafe_input_unknown(entry.key, choices_text(entry.key, names)));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].is(Node::Kind::missing)) continue;
    graph.failsafe[i].resize(info.inputs[i].type->size);
    fill_record(*info.inputs[i].type, parts[i], graph.failsafe[i].data(), "failsafe", draft.report);
  }
}

}  // namespace fulmar::core
