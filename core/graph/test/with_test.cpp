// SPDX-License-Identifier: BSD-3-Clause
// --with names a component, or a role in place of the component that fills it.
#include <doctest/doctest.h>

#include "core/graph/test/shelf.hpp"

namespace with_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Overrides with(const Pairs& pairs) {
  Overrides o;
  o.with = pairs;
  return o;
}
std::string use_of(const Graph& graph, const std::string& name) {
  for (const Component& c : graph.components)
    if (c.name == name) return c.use;
  return "none";
}

}  // namespace

TEST_CASE("a role in --with means the component that fills it in this run") {
  Mission mission;
  const Graph usual = mission.load(with({{"nav", "estimator_ekf"}}));
  CHECK(usual.source.overrides.with == Pairs{{"ekf", "estimator_ekf"}});  // form for a swap
  Overrides chosen = with({{"nav", "sim_aero"}});
  chosen.roles = {{"nav", "truth"}};
  CHECK(mission.load(chosen).source.overrides.with == Pairs{{"truth", "sim_aero"}});
  Mission other;  // the first that exists: the one before it is of hardware alone
  other.replace("ekf:    {fills",
                "real:   {fills: nav, use: sim_aero/TruthState, in: {truth: vehicle.truth}, "
                "only: fcu}\n  ekf:    {fills");
  CHECK(other.load(with({{"nav", "estimator_ekf"}})).source.overrides.with ==
        Pairs{{"ekf", "estimator_ekf"}});
}

TEST_CASE("a role with several fillers is rejected, with their names; so is an unknown name") {
  Mission mission;
  CHECK(mission.faults(with({{"outer", "control_tecs"}})) ==
        "--with outer=control_tecs: graph.role_ambiguous(outer, slc, tecs, mine)");
  Overrides one = with({{"outer", "control_slc/Outer"}});
  one.roles = {{"outer", "tecs"}};
  const Graph graph = mission.load(one);
  CHECK(graph.source.overrides.with == Pairs{{"tecs", "control_slc/Outer"}});
  CHECK(use_of(graph, "tecs") == "control_slc/Outer");
  CHECK(mission.faults(with({{"navi", "x"}}))
            .starts_with("--with navi=x: types.name_unknown(component, navi, "));
  CHECK(mission.faults(with({{"vehicle", "nothing"}})).starts_with("--with sim=nothing: components.sim: "));
}

TEST_CASE("a user's filter replaces the shipped one with the inputs that it has") {
  Mission mission;
  mission.replace("use: estimator_ekf", "use: estimator_ekf/Ekf");
  const ComponentInfo& ekf = mission.shelf.plugins["estimator_ekf"]->components[0];
  std::vector<Port> inputs = ekf.inputs;
  std::erase_if(inputs, [](const Port& p) { return p.name == "status"; });
  mission.shelf.add("my_filter", "MyFilter", inputs, ekf.outputs);
  const Graph graph = mission.load(with({{"nav", "my_filter"}}));
  CHECK(use_of(graph, "ekf") == "my_filter/MyFilter");
  REQUIRE(graph.source.warnings.size() == 1);
  CHECK(graph.source.warnings[0].find(
            "graph.connection_left_out(components.ekf.in.status, my_filter/MyFilter)") != std::string::npos);
  mission.shelf.add("my_filter", "Other", inputs, ekf.outputs);
  CHECK(mission.faults(with({{"nav", "my_filter"}})).find(", ekf, my_filter, MyFilter)") !=
        std::string::npos);
  CHECK(mission.faults(with({{"nav", "my_filter/Other"}})) == "");
}

}  // namespace with_test
