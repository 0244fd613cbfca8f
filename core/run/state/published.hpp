// SPDX-License-Identifier: BSD-3-Clause
// Types and topic names of a flight's messages besides those of its components.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Types of all messages of the host itself.
const std::vector<TypePtr>& host_types();
/// The message of a component's probes: fulmar_msgs/msg/ControlSlcOuterProbes. ROS distinguishes messages by
/// name alone.
TypePtr probes_type(const PluginInfo& plugin, const ComponentInfo& component);

/// Topic of an output: under its role's name, when it is an output of the role.
std::string topic_name(const Graph& graph, const Component& component, std::size_t output);

/// Seed of a component: a mix of the mission's seed and the component's name, so that a new component does
/// not change the noise of others.
std::uint64_t component_seed(std::uint64_t mission_seed, const std::string& name);

}  // namespace fulmar::core
