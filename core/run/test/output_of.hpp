// SPDX-License-Identifier: BSD-3-Clause
// Output with a component's messages, in a flight that is stepped by the test.
#pragma once
#include <stdexcept>
#include <string>

#include "core/run/flight.hpp"

namespace fulmar::core {

/// For Flight::sample; throws when there is no such component.
inline Source output_of(const Graph& graph, const std::string& component, const std::string& output) {
  for (std::size_t i = 0; i < graph.components.size(); ++i)
    if (graph.components[i].name == component)
      return {Source::Kind::component, static_cast<int>(i), graph.components[i].info().output(output)};
  throw std::runtime_error("no component " + component);
}

}  // namespace fulmar::core
