// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_inspect/check.hpp"

#include <cstdio>

#include "core/error.hpp"
#include "core/run/component/unit.hpp"
#include "core/run/state/published.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_inspect/advice.hpp"

namespace fulmar::core {
namespace {

/// Faults that components report in their configuration, one sentence each. Each component is configured
/// alone and in a separate process. Components that would open a device are left out: drivers, and the
/// vehicle on hardware.
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

}  // namespace

int check_mission(const std::string& mission, const Overrides& overrides) {
  const Graph graph = load_mission(mission, overrides);
  for (const std::string& warning : graph.source.warnings) warn(warning);
  Report unused;  // the mission is valid
  for (const std::string& sentence : advice_on(graph, parse_mission(mission, overrides, unused)))
    warn(sentence);
  std::string refused;
  for (const std::string& fault : refused_set_ups(graph)) refused += (refused.empty() ? "" : "\n") + fault;
  if (!refused.empty()) throw Error(refused);
  std::printf("%s is in order: %zu components, %zu roles, %zu phases.\n", for_terminal(mission).c_str(),
              graph.components.size(), graph.roles.size(), graph.phases.size());
  return 0;
}

}  // namespace fulmar::core
