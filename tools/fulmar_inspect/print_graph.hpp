// SPDX-License-Identifier: BSD-3-Clause
// A mission's graph as text and for drawing tools.
#pragma once
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Components, wires, order, phases. Formats: "text", "dot", "mermaid". Throws Error for any other.
std::string print_graph(const Graph& graph, const std::string& format);

}  // namespace fulmar::core
