// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_contract.hpp"

#include <algorithm>

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

/// What a port carries, as its writer has it.
TypePtr sent_type(const Graph& graph, const PortName& from) {
  for (const Role& role : graph.roles)
    if (role.name == from.owner)
      for (const RolePort& port : role.outputs)
        if (port.name == from.port) return port.type;
  for (const Component& component : graph.components)
    if (component.name == from.owner) {
      const int output = component.info().output(from.port);
      if (output >= 0) return component.info().outputs[static_cast<std::size_t>(output)].type;
    }
  return nullptr;
}

void read_inputs(const MissionView& mission, const RoleText& role, Contract& contract) {
  for (const WireText& wire : role.in) {
    ContractInput input{wire.name, wire.from, sent_type(mission.graph, wire.from), FULMAR_IN_VALUE, false};
    if (const int i = contract.shipped.input(wire.name); i >= 0) {
      const Port& port = contract.shipped.inputs[static_cast<std::size_t>(i)];
      input.kind = port.kind;
      input.optional = port.optional;
      if (!input.type) input.type = port.type;
    }
    if (!input.type)
      throw Error(wire.where.text() + ": roles." + role.name + ".in." + wire.name +
                  ": no component says what " + wire.from.text() + " carries");
    contract.inputs.push_back(std::move(input));
  }
  if (!contract.vehicle()) return;
  for (const Port& port : contract.shipped.inputs)  // requests of a vehicle, such as arm, come from the host
    if (port.kind == FULMAR_IN_REQUEST)
      contract.inputs.push_back({port.name, {}, port.type, port.kind, true});
}

void read_outputs(const Role& role, const RoleText& text, Contract& contract) {
  for (std::size_t i = 0; i < role.outputs.size(); ++i) {
    ContractOutput output;
    output.name = role.outputs[i].name;
    output.type = role.outputs[i].type;
    output.type_name = text.out[i].type;
    output.optional = role.outputs[i].optional;
    if (const int o = contract.shipped.output(output.name); o >= 0) {
      const Port& port = contract.shipped.outputs[static_cast<std::size_t>(o)];
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

Contract read_contract(const MissionView& mission, const std::string& role_name) {
  const Graph& graph = mission.graph;
  std::vector<std::string> names;
  for (const Role& role : graph.roles) names.push_back(role.name);
  const auto at = std::find(names.begin(), names.end(), role_name);
  if (at == names.end())
    throw Error("--role " + role_name + ": " + mission.file.filename().string() + " has no such role." +
                choices_text(role_name, names));
  const auto r = static_cast<std::size_t>(at - names.begin());

  Contract contract;
  contract.role = role_name;
  contract.mission = graph.mission;
  const Phase& last = graph.phases.back();
  if (!contract.vehicle()) contract.phase = last.name;
  const int filler = contract.vehicle() ? graph.vehicle : last.roles[r].component;
  const Component& shipped = graph.components[static_cast<std::size_t>(filler)];
  contract.shipped = shipped.info();
  contract.shipped_text = mission.text.component(shipped.name);
  contract.shipped_use = contract.shipped_text->use.text;
  for (const PhaseText& phase : mission.text.phases)
    for (const AssignmentText& assignment : phase.roles)
      if (phase.name == last.name && assignment.role == role_name) contract.shipped_set = assignment.set;
  const RoleText& text = *mission.text.role(role_name);
  read_inputs(mission, text, contract);
  read_outputs(graph.roles[r], text, contract);
  return contract;
}

}  // namespace fulmar::core
