// SPDX-License-Identifier: BSD-3-Clause
// Reads a plugin's entry symbol: the ABI version first, then every component, port and parameter, each
// checked.
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/loader/library.hpp"
#include "core/loader/messages.hpp"
#include "core/loader/table.hpp"

namespace fulmar::core {
namespace {

constexpr std::uint32_t max_components = 256, max_ports = 256, max_params = 1024, max_choices = 1024;
constexpr std::uint32_t max_items = 1u << 16;   // of a queue, per step
constexpr std::uint32_t max_string = 1u << 16;  // bytes of a string parameter

std::string version_text(std::uint32_t major, std::uint32_t minor) {
  return std::to_string(major) + "." + std::to_string(minor);
}

std::string names(TableReader& tables, const char* at, const std::string& what) {
  std::string name = tables.text(at, what);
  if (!is_identifier(name)) throw Error(loader_messages::name_invalid(what, name));
  return name;
}

bool is_input(std::uint32_t kind) { return kind >= FULMAR_IN_VALUE && kind <= FULMAR_IN_REQUEST; }
bool is_output(std::uint32_t kind) { return kind >= FULMAR_OUT_VALUE && kind <= FULMAR_OUT_PROBE; }

Port read_port(TableReader& tables, const fulmar_port& from, const std::string& owner, bool input) {
  Port port;
  port.name = names(tables, from.name, "the name of a port of " + owner);
  const std::string what = "port '" + port.name + "' of " + owner;
  if (!is_input(from.kind) && !is_output(from.kind))
    throw Error(loader_messages::port_kind_unknown(what, from.kind));
  if (is_input(from.kind) != input)
    throw Error(input ? loader_messages::port_is_output(what) : loader_messages::port_is_input(what));
  port.kind = static_cast<fulmar_port_kind>(from.kind);
  port.optional = (from.flags & FULMAR_PORT_OPTIONAL) != 0;
  const bool queue =
      port.kind == FULMAR_IN_QUEUE || port.kind == FULMAR_IN_REQUEST || port.kind == FULMAR_OUT_QUEUE;
  if (queue && (from.capacity == 0 || from.capacity > max_items))
    throw Error(loader_messages::queue_size_invalid(what, from.capacity));
  port.capacity = queue ? from.capacity : 1;
  if (port.kind != FULMAR_OUT_PROBE) port.type = tables.type(from.type, what);
  return port;
}

std::vector<Port> read_ports(TableReader& tables, const fulmar_port* from, std::uint32_t count,
                             std::uint32_t stride, const std::string& owner, bool input) {
  const std::string what = std::string(input ? "the inputs" : "the outputs") + " of " + owner;
  if (count > max_ports) throw Error(loader_messages::too_many_ports(what, count, max_ports));
  std::vector<Port> ports;
  for (std::uint32_t i = 0; i < count; ++i) {
    Port port = read_port(tables, tables.element(from, stride, i, what), owner, input);
    for (const Port& other : ports)
      if (other.name == port.name)
        throw Error(loader_messages::port_repeated(owner, input ? "inputs '" : "outputs '", port.name));
    ports.push_back(std::move(port));
  }
  return ports;
}

// The default of a number must lie in its range.
void check_numbers(const ParamInfo& param, const std::string& what) {
  const int count = param.kind == FULMAR_VECTOR ? 3 : 1;
  if (!(param.min <= param.max)) throw Error(loader_messages::range_empty(what));
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(param.initial[i]) || param.initial[i] < param.min || param.initial[i] > param.max)
      throw Error(loader_messages::default_out_of_range(what, param.initial[i], param.min, param.max));
}

void read_kind(TableReader& tables, const fulmar_param& from, ParamInfo& param, const std::string& what) {
  switch (param.kind) {
    case FULMAR_VECTOR: param.type = tables.type(from.type, what); [[fallthrough]];
    case FULMAR_NUMBER:
    case FULMAR_COUNT: return check_numbers(param, what);
    case FULMAR_FLAG:
      if (param.initial[0] != 0 && param.initial[0] != 1)
        throw Error(loader_messages::default_not_flag(what));
      return;
    case FULMAR_CHOICE:
      if (from.choice_count == 0 || from.choice_count > max_choices)
        throw Error(loader_messages::choice_count_invalid(what, from.choice_count));
      param.choices = tables.texts(from.choices, from.choice_count, what + ": the choices");
      if (!(param.initial[0] >= 0 && param.initial[0] < from.choice_count))
        throw Error(loader_messages::default_not_choice(what));
      return;
    case FULMAR_STRING:
      param.initial_text = tables.text(from.initial_text, what + ": the default");
      if (param.capacity > max_string || param.initial_text.size() >= param.capacity)
        throw Error(loader_messages::default_too_long(what, param.capacity));
      return;
    case FULMAR_RECORD:
      param.type = tables.type(from.type, what);
      param.initial_data.resize(param.type->size);
      if (from.initial_data == nullptr) return;
      if (!tables.memory().readable(from.initial_data, param.type->size))
        throw Error(located(what, loader_messages::default_outside_memory()));
      std::memcpy(param.initial_data.data(), from.initial_data, param.type->size);
      return;
    case FULMAR_BLOB: return;
  }
}

ParamInfo read_param(TableReader& tables, const fulmar_param& from, const std::string& owner) {
  ParamInfo param;
  param.name = names(tables, from.name, "the name of a parameter of " + owner);
  const std::string what = "parameter '" + param.name + "' of " + owner;
  if (from.kind < FULMAR_NUMBER || from.kind > FULMAR_BLOB)
    throw Error(loader_messages::port_kind_unknown(what, from.kind));
  param.kind = static_cast<fulmar_param_kind>(from.kind);
  param.unit = tables.text(from.unit, what + ": the unit");
  param.doc = tables.text(from.doc, what + ": the description");
  param.live = (from.flags & FULMAR_LIVE) != 0;
  param.required = (from.flags & FULMAR_REQUIRED) != 0;
  param.capacity = from.capacity;
  std::copy(std::begin(from.initial), std::end(from.initial), param.initial);
  param.min = from.min;
  param.max = from.max;
  read_kind(tables, from, param, what);
  return param;
}

template <class Function>
void check_function(const TableReader& tables, Function* function, bool needed, const char* name,
                    const std::string& owner) {
  if (function == nullptr) {
    if (needed) throw Error(loader_messages::function_missing(owner, name));
    return;
  }
  if (!tables.memory().executable(reinterpret_cast<const void*>(function)))
    throw Error(loader_messages::function_outside_code(name, owner));
}

void check_functions(const TableReader& tables, const fulmar_component& from, const ComponentInfo& info,
                     const std::string& owner) {
  check_function(tables, from.create, true, "create", owner);
  check_function(tables, from.destroy, true, "destroy", owner);
  check_function(tables, from.configure, true, "configure", owner);
  check_function(tables, from.retune, false, "retune", owner);
  check_function(tables, from.activate, false, "activate", owner);
  check_function(tables, from.deactivate, false, "deactivate", owner);
  check_function(tables, from.get_extension, false, "get_extension", owner);
  check_function(tables, from.step, !info.vehicle, "step", owner);
  check_function(tables, from.read, info.vehicle, "read", owner);
  check_function(tables, from.write, info.vehicle, "write", owner);
}

ComponentInfo read_component(TableReader& tables, const fulmar_component& from) {
  ComponentInfo info;
  info.name = names(tables, from.name, "the name of a component");
  const std::string owner = "component '" + info.name + "'";
  info.doc = tables.text(from.doc, owner + ": the description");
  info.vehicle = (from.flags & FULMAR_VEHICLE) != 0;
  info.resident = (from.flags & FULMAR_RESIDENT) != 0;
  info.retunes = from.retune != nullptr;
  info.activates = from.activate != nullptr;
  info.inputs = read_ports(tables, from.inputs, from.input_count, from.port_stride, owner, true);
  info.outputs = read_ports(tables, from.outputs, from.output_count, from.port_stride, owner, false);
  if (from.param_count > max_params)
    throw Error(loader_messages::too_many_parameters(owner, from.param_count, max_params));
  for (std::uint32_t i = 0; i < from.param_count; ++i) {
    ParamInfo param = read_param(
        tables, tables.element(from.params, from.param_stride, i, "the parameters of " + owner), owner);
    if (info.param(param.name) >= 0) throw Error(loader_messages::parameter_repeated(owner, param.name));
    info.params.push_back(std::move(param));
  }
  check_functions(tables, from, info, owner);
  return info;
}

void read_plugin(TableReader& tables, const fulmar_plugin& entry, PluginInfo& info) {
  info.version = tables.text(entry.version, "the version");
  info.toolchain = tables.text(entry.toolchain, "the toolchain");
  info.flags = tables.text(entry.flags, "the build flags");
  const bool hosts_scripts = entry.open_script != nullptr;
  if ((entry.component_count == 0 && !hosts_scripts) || entry.component_count > max_components)
    throw Error(loader_messages::component_count_invalid(entry.component_count));
  check_function(tables, entry.open_script, false, "open_script", "the plugin");
  check_function(tables, entry.close_script, hosts_scripts, "close_script", "the plugin");
  for (std::uint32_t i = 0; i < entry.component_count; ++i) {
    ComponentInfo component =
        read_component(tables, tables.element(entry.components, entry.component_stride, i, "the components"));
    for (const ComponentInfo& other : info.components)
      if (other.name == component.name) throw Error(loader_messages::component_repeated(component.name));
    info.components.push_back(std::move(component));
  }
}

}  // namespace

PluginInfo read_entry(const fulmar_plugin& entry, const std::string& file_name) {
  PluginInfo info;
  info.file = file_name;
  TableReader tables;
  if (!tables.memory().readable(&entry, 2 * sizeof(std::uint32_t)))
    throw Error(located(file_name, loader_messages::entry_outside_memory()));
  info.abi_major = entry.abi_major;
  info.abi_minor = entry.abi_minor;
  if (info.abi_major != FULMAR_ABI_MAJOR)
    throw Error(loader_messages::plugin_abi_differs(file_name, version_text(info.abi_major, info.abi_minor),
                                                    version_text(FULMAR_ABI_MAJOR, FULMAR_ABI_MINOR)));
  const std::size_t size = info.abi_minor >= 1 ? sizeof entry : offsetof(fulmar_plugin, open_script);
  if (!tables.memory().readable(&entry, size))
    throw Error(located(file_name, loader_messages::entry_outside_memory()));
  fulmar_plugin copy{};  // a compiler may read the whole referenced object, but an older entry is shorter
  std::memcpy(&copy, &entry, size);
  try {
    read_plugin(tables, copy, info);
  } catch (const Error& fault) {
    throw Error(located(file_name, fault.diagnostic));
  }
  return info;
}

}  // namespace fulmar::core
