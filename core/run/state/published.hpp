// SPDX-License-Identifier: BSD-3-Clause
// What a flight publishes beside its components' messages, and under which names.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// All that the host itself publishes.
const std::vector<TypePtr>& host_types();
/// The message of a component's probes: fulmar_msgs/msg/ControlSlcOuterProbes. ROS tells messages apart by
/// name alone.
TypePtr probes_type(const PluginInfo& plugin, const ComponentInfo& component);

/// Under which name an output is logged: its role's, when it is one of the role's.
std::string topic_name(const Graph& graph, const Component& component, std::size_t output);

/// Seed of a component: a mix of the mission's seed and the component's name, so that adding a component
/// changes no other's noise.
std::uint64_t component_seed(std::uint64_t mission_seed, const std::string& name);

}  // namespace fulmar::core
