// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/command/trial.hpp"

#include "core/error.hpp"
#include "core/run/component/unit.hpp"
#include "core/run/state/published.hpp"

namespace fulmar::core {

std::vector<std::string> refused_set_ups(const Graph& graph) {
  std::vector<std::string> refused;
  for (const Component& named : graph.components) {
    Component component = named;
    const bool vehicle = component.info().vehicle;
    if (component.run == RunMode::driver || (vehicle && graph.io == Io::fcu)) continue;
    if (!vehicle) component.run = RunMode::process;
    UnitOptions options;
    options.tick_ns = graph.tick_ns;
    options.seed = component_seed(graph.seed, component.name);
    try {
      Unit(component, std::move(options)).configure();
    } catch (const Error& fault) {
      refused.emplace_back(fault.what());
    }
  }
  return refused;
}

}  // namespace fulmar::core
