// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// [setup] What components say against their parameters and records when they are configured, a sentence
/// each. Each one alone and in a process of its own, where it harms nobody; left out are those that would
/// open a device: drivers, and the vehicle on hardware.
std::vector<std::string> refused_set_ups(const Graph& graph);

}  // namespace fulmar::core
