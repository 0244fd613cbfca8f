// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/state/published.hpp"

#include <cctype>
#include <filesystem>
#include <limits>

#include "core/log/events.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

std::uint64_t component_seed(std::uint64_t mission_seed, const std::string& name) {
  std::uint64_t h = mission_seed ^ 0x9e3779b97f4a7c15ull;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  h ^= h >> 30;
  h *= 0xbf58476d1ce4e5b9ull;
  h ^= h >> 27;
  h *= 0x94d049bb133111ebull;  // splitmix64's finaliser
  return h ^ (h >> 31);
}

namespace {

/// "control_slc.so" -> "ControlSlc".
std::string camel_case(const std::string& file) {
  std::string name;
  bool first = true;
  for (const char c : std::filesystem::path(file).stem().string()) {
    const bool word = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (word) name += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    first = !word;
  }
  return name;
}

}  // namespace

TypePtr probes_type(const PluginInfo& plugin, const ComponentInfo& component) {
  Type probes;
  probes.name = camel_case(plugin.file) + component.name + "Probes";
  probes.align = 8;
  for (const Port& port : component.outputs) {
    if (port.type) continue;
    Field f;
    f.name = port.name;
    f.offset = probes.size;
    f.stride = 8;
    f.min = -std::numeric_limits<double>::infinity();
    f.max = -f.min;
    probes.fields.push_back(f);
    probes.size += 8;
  }
  return std::make_shared<const Type>(probes);
}

const std::vector<TypePtr>& host_types() {
  static const std::vector<TypePtr> list = {host_type<Event>(), host_type<Ticks>(), host_type<CommandNote>()};
  return list;
}

std::string topic_name(const Graph& graph, const Component& c, std::size_t output) {
  for (const int r : c.roles) {
    const Role& role = nth(graph.roles, r);
    for (std::size_t f = 0; f < role.fillers.size(); ++f)
      for (std::size_t k = 0; k < role.outputs.size(); ++k)
        if (&nth(graph.components, role.fillers[f]) == &c && role.provides[f][k] == static_cast<int>(output))
          return role.name + "." + role.outputs[k].name;
  }
  return c.name + "." + c.info().outputs[output].name;
}

}  // namespace fulmar::core
