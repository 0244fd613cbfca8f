// SPDX-License-Identifier: BSD-3-Clause
// `fulmar check`.
#pragma once
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Prints advice about a mission and returns 0. Throws Error with every fault, one a line.
int check_mission(const std::string& mission, const Overrides& overrides);

}  // namespace fulmar::core
