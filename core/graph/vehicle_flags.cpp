// SPDX-License-Identifier: BSD-3-Clause
// Flags for the protection of an aircraft: the fields of its vehicle that mean armed, on the ground, and
// under the host's control. The host does not depend on a message, so the mission names them. By default they
// are searched in the output 'status'.
#include <array>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

constexpr const char* usual_port = "status";

struct Wanted {
  const char* name;
  VehicleFlag VehicleFlags::*flag;
};
constexpr std::array<Wanted, 3> all_flags = {Wanted{"armed", &VehicleFlags::armed},
                                             {"on_ground", &VehicleFlags::on_ground},
                                             {"in_control", &VehicleFlags::in_control}};

/// All possible flags: "status.armed, status.in_control".
std::vector<std::string> flag_names(const ComponentInfo& vehicle) {
  std::vector<std::string> names;
  for (const Port& port : vehicle.outputs)
    for (std::size_t i = 0; port.type && i < port.type->fields.size(); ++i)
      if (const Field& field = port.type->fields[i];
          field.kind == FULMAR_BOOL && field.shape == FULMAR_SCALAR)
        names.push_back(port.name + "." + field.name);
  return names;
}

std::string flags_text(const ComponentInfo& vehicle) {
  const std::vector<std::string> names = flag_names(vehicle);
  return names.empty() ? graph_messages::vehicle_without_flags().line() : " Its flags: " + join(names) + ".";
}

/// "status.armed", found in the vehicle's outputs. Throws Error with the valid choices.
VehicleFlag named_flag(const Graph& graph, const std::string& text) {
  const Component& vehicle = nth(graph.components, graph.vehicle);
  const ComponentInfo& info = vehicle.info();
  const auto dot = text.find('.');
  if (dot == std::string::npos) throw Error(graph_messages::flag_name_expected(text, flags_text(info)));
  const std::string port = text.substr(0, dot);
  const int output = info.output(port);
  std::vector<std::string> ports;
  for (const Port& each : info.outputs)
    if (each.type) ports.push_back(each.name);
  if (output < 0 || !nth(info.outputs, output).type)
    throw Error(
        graph_messages::flag_output_unknown(vehicle.name, vehicle.use, port, choices_text(port, ports)));
  const FieldRef field =
      resolve_field(*nth(info.outputs, output).type, std::string_view(text).substr(dot + 1));
  if (field.field->kind != FULMAR_BOOL)
    throw Error(graph_messages::field_not_flag(text, vehicle.use, flags_text(info)));
  return {{Source::Kind::component, graph.vehicle, output}, field.offset};
}

/// The flag of that name in the output 'status', or none.
VehicleFlag usual_flag(const Graph& graph, const char* name) {
  const ComponentInfo& info = nth(graph.components, graph.vehicle).info();
  const int output = info.output(usual_port);
  const TypePtr type = output < 0 ? nullptr : nth(info.outputs, output).type;
  const Field* const field = type ? type->find(name) : nullptr;
  if (!field || field->kind != FULMAR_BOOL || field->shape != FULMAR_SCALAR) return {};
  return {{Source::Kind::component, graph.vehicle, output}, field->offset};
}

/// An optional output that this vehicle lacks may exist with the other io, so it cannot be checked.
bool not_in_this_run(const Draft& draft, const RoleText& role, const std::string& text) {
  const std::string port = text.substr(0, text.find('.'));
  const RoleOutText* const out = find_named(role.out, port);
  return draft.vehicle().info().output(port) < 0 && out && out->optional;
}

/// Without the flag `armed`, a Ctrl-C would abandon an aircraft in the air.
void check_complete(Draft& draft, const std::vector<std::string>& missing) {
  const Component& vehicle = draft.vehicle();
  const RoleText* const role = draft.text.role("vehicle");
  std::string example;
  for (const std::string& name : missing) example += (example.empty() ? "" : ", ") + name + ": PORT.FIELD";
  draft.report.add(
      role ? role->where : vehicle.where,
      located(std::string(role ? "roles.vehicle" : "components." + vehicle.name),
              graph_messages::vehicle_flags_missing(vehicle.name, vehicle.use, join(missing), usual_port,
                                                    example, flags_text(vehicle.info()))));
}

}  // namespace

void read_vehicle_flags(Draft& draft) {
  Graph& graph = draft.graph;
  if (graph.vehicle < 0) return;
  const RoleText* const role = draft.text.role("vehicle");
  std::vector<std::string> missing;
  for (const Wanted& each : all_flags) {
    VehicleFlag& flag = graph.flags.*each.flag;
    flag = usual_flag(graph, each.name);
    bool refused = false;
    for (std::size_t i = 0; role && i < role->flags.size(); ++i) {
      const auto& [name, word] = role->flags[i];
      if (name != each.name) continue;
      flag = {};
      if (not_in_this_run(draft, *role, word.text)) continue;
      try {
        flag = named_flag(graph, word.text);
      } catch (const Error& fault) {
        refused = true;
        draft.report.add(word.where, graph_messages::vehicle_flag_invalid(name, fault.what()));
      }
    }
    if (flag.from.kind == Source::Kind::none && !refused) missing.emplace_back(each.name);
  }
  if (graph.io == Io::fcu && !missing.empty()) check_complete(draft, missing);
}

}  // namespace fulmar::core
