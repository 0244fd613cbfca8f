// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_contract.hpp"

#include <algorithm>

#include "core/types/named.hpp"
#include "tools/fulmar_new/messages.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

void read_inputs(const MissionView& mission, const RoleText& role, const ContractRole& filled,
                 Contract& contract) {
  const ComponentInfo& shipped = filled.shipped;
  for (const WireText& wire : role.in) {
    if (find_named(contract.roles, wire.from.owner)) continue;  // an output of the component itself
    if (const ContractInput* same = find_named(contract.inputs, wire.name)) {
      if (same->from.text() == wire.from.text()) continue;
      throw Error(located(wire.where, new_messages::role_inputs_conflict(
                                          role.name, wire.name, wire.from.text(), same->from.text())));
    }
    ContractInput input{wire.name, wire.from, sent_by(mission.graph, wire.from).type, FULMAR_IN_VALUE, false};
    if (const int i = shipped.input(wire.name); i >= 0) {
      const Port& port = shipped.inputs[static_cast<std::size_t>(i)];
      input.kind = port.kind;
      input.optional = port.optional;
      if (!input.type) input.type = port.type;
    }
    if (!input.type)
      throw Error(
          located(wire.where, new_messages::role_input_type_unknown(role.name, wire.name, wire.from.text())));
    contract.inputs.push_back(std::move(input));
  }
  if (!contract.vehicle()) return;
  for (const Port& port : shipped.inputs)  // requests of a vehicle, such as arm, come from the host
    if (port.kind == FULMAR_IN_REQUEST)
      contract.inputs.push_back({port.name, {}, port.type, port.kind, true});
}

void read_outputs(const Role& role, const RoleText& text, std::size_t index, Contract& contract) {
  const ComponentInfo& shipped = contract.roles[index].shipped;
  for (std::size_t i = 0; i < role.outputs.size(); ++i) {
    ContractOutput output;
    output.name = role.outputs[i].name;
    output.type = role.outputs[i].type;
    output.type_name = text.out[i].type;
    output.optional = role.outputs[i].optional;
    output.role = index;
    // Optional outputs such as notices are left to the author. The frame of a vehicle lists its optional
    // ones.
    if (output.optional && !contract.vehicle()) continue;
    if (const ContractOutput* same = find_named(contract.outputs, output.name))
      throw Error(
          new_messages::role_outputs_conflict(contract.roles[same->role].name, role.name, output.name));
    if (const int o = shipped.output(output.name); o >= 0) {
      const Port& port = shipped.outputs[static_cast<std::size_t>(o)];
      output.kind = port.kind;
      output.capacity = port.capacity;
    }
    contract.outputs.push_back(std::move(output));
  }
}

}  // namespace

MissionView view_mission(const fs::path& file) {
  Report report;
  MissionView view{fs::absolute(file).lexically_normal(), {}, parse_mission(file.string(), {}, report), {}};
  report.throw_if_any();
  view.root = parse_yaml(view.text.file, report);
  view.graph = load_mission(file.string());
  return view;
}

Sent sent_by(const Graph& graph, const PortName& from) {
  Sent sent;
  const int role = index_named(graph.roles, from.owner);
  if (role >= 0)
    if (const RolePort* port = find_named(graph.roles[static_cast<std::size_t>(role)].outputs, from.port))
      sent = {port->type, FULMAR_OUT_VALUE, true};
  for (const Component& component : graph.components) {
    // components that fill the role write it in this way
    const bool fills = sent.known && role >= 0 && component.fills(role);
    if (component.name != from.owner && !fills) continue;
    const int output = component.info().output(from.port);
    if (output < 0) continue;
    const Port& port = component.info().outputs[static_cast<std::size_t>(output)];
    sent = {port.type, port.kind, true};
  }
  return sent;
}

namespace {

std::size_t role_index(const MissionView& mission, const std::string& role) {
  std::vector<std::string> names;
  for (const Role& known : mission.graph.roles) names.push_back(known.name);
  const auto at = std::find(names.begin(), names.end(), role);
  if (at == names.end())
    throw Error(
        new_messages::role_unknown(role, mission.file.filename().string(), choices_text(role, names)));
  return static_cast<std::size_t>(at - names.begin());
}

void add_role(const MissionView& mission, std::size_t r, Contract& contract) {
  const Graph& graph = mission.graph;
  const std::string& name = graph.roles[r].name;
  const Phase& last = graph.phases.back();
  const int filler = contract.vehicle() ? graph.vehicle : last.roles[r].component;
  const Component& shipped = graph.components[static_cast<std::size_t>(filler)];
  ContractRole& role = *std::find_if(contract.roles.begin(), contract.roles.end(),
                                     [&](const ContractRole& known) { return known.name == name; });
  role.shipped = shipped.info();
  role.shipped_text = mission.text.component(shipped.name);
  role.shipped_use = role.shipped_text->use.text;
  contract.rate_hz = std::max(contract.rate_hz, role.shipped_text->rate_hz);
  for (const PhaseText& phase : mission.text.phases)
    for (const AssignmentText& assignment : phase.roles)
      if (phase.name == last.name && assignment.role == name) role.shipped_set = assignment.set;
  const RoleText& text = *mission.text.role(name);
  read_inputs(mission, text, role, contract);
  read_outputs(graph.roles[r], text, static_cast<std::size_t>(&role - contract.roles.data()), contract);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

}  // namespace

std::string Contract::role_words() const {
  std::vector<std::string> words;
  for (const ContractRole& role : roles) words.push_back(role.name);
  return joined(words);
}

std::string Contract::shipped_words() const {
  std::vector<std::string> words;
  for (const ContractRole& role : roles) words.push_back(role.shipped_text->name);
  return joined(words);
}

Contract read_contract(const MissionView& mission, const std::vector<std::string>& roles) {
  Contract contract;
  contract.mission = mission.graph.mission;
  std::vector<std::size_t> indices;
  for (const std::string& role : roles) {
    indices.push_back(role_index(mission, role));
    if (find_named(contract.roles, role)) throw Error(new_messages::role_duplicate(role));
    if (role == "vehicle" && roles.size() > 1) throw Error(new_messages::vehicle_with_roles());
    contract.roles.push_back({role, nullptr, {}, {}, {}});
  }
  if (!contract.vehicle()) contract.phase = mission.graph.phases.back().name;
  for (const std::size_t r : indices) add_role(mission, r, contract);
  return contract;
}

}  // namespace fulmar::core
