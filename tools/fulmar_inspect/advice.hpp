// SPDX-License-Identifier: BSD-3-Clause
// Advice of `fulmar check`: a valid mission that may not do what its author expects.
#pragma once
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/graph/mission.hpp"

namespace fulmar::core {

using Advice = std::vector<std::string>;  // sentences that begin with file and line

// bypassed.cpp: components that another one replaces but that other components still read
void add_bypassed(const Graph& graph, const MissionText& text, Advice& advice);
// unread.cpp: an output without a reader and an input without a source, of the same type
void add_unread(const Graph& graph, Advice& advice);

/// `text`: the mission of the graph.
inline Advice advice_on(const Graph& graph, const MissionText& text) {
  Advice advice;
  add_bypassed(graph, text, advice);
  add_unread(graph, advice);
  return advice;
}

}  // namespace fulmar::core
