// SPDX-License-Identifier: BSD-3-Clause
// The components of a built graph that can move the aircraft.
#pragma once
#include <vector>

#include "core/graph/graph.hpp"
#include "core/graph/mission.hpp"

namespace fulmar::core {

/// Components of the graph whose outputs lead to an input of the role `vehicle`. Without the vehicle.
std::vector<int> steering_components(const Graph& graph, const MissionText& text);

/// These, and the components whose outputs lead to a condition of a phase.
std::vector<int> deciding_components(const Graph& graph, const MissionText& text);

}  // namespace fulmar::core
