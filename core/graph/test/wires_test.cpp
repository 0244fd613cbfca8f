// SPDX-License-Identifier: BSD-3-Clause
// Wires: valid connections, their settings, and the resulting order of steps.
#include <doctest/doctest.h>

#include "core/graph/test/shelf.hpp"

namespace wires_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("wires end at ports that exist and fit") {
  CHECK(
      changed("plan: plan.plan", "plan: plan.pln") ==
      "26: components.manage.in.plan: types.name_unknown_in(plan (path/Planner), output, pln,  [plan] plan)");
  CHECK(changed("plan: plan.plan", "plan: pln.plan") ==
        "26: components.manage.in.plan: types.name_unknown(role or component, pln,  [plan] vehicle, nav, "
        "guide, outer, inner, sim, ekf, truth, plan, manage, follow, slc, tecs, attitude, mine, score)");
  CHECK(changed("plan: plan.plan", "plan: nav.stat") ==
        "26: components.manage.in.plan: types.name_unknown_in(the role nav, output, stat,  [state] state)");
  CHECK(changed("plan: plan.plan", "plan: plan") ==
        "26: components.manage.in.plan: graph.port_expected(plan)");
  CHECK(changed("plan: plan.plan", "plan: manage.progress") ==
        "26: components.manage.in.plan: graph.message_types_mismatch(manage, plan, Plan, manage.progress, "
        "Progress)");
  CHECK(
      changed(", plan: plan.plan", "") ==
      "26: graph.input_not_connected(components.manage: the input 'plan' , outputs of type Plan: plan.plan)");
  CHECK(changed("path: manage.path}, out: {comm", "path: attitude.roll_error_rad}, out: {comm") ==
        "16: roles.guide.in.path: graph.probe_not_connectable(attitude.roll_error_rad)");
  CHECK(changed("{state: nav.state, path: manage.path}, out: {comm",
                "{state: nav.state, pth: manage.path}, out: {comm") ==
        "16: roles.guide.in.pth: graph.role_input_unknown(guide, path)\n27: "
        "graph.input_not_connected(components.follow: the input 'path' , outputs of type Path: manage.path)");
  CHECK(changed("plan: plan.plan}", "plan: plan.plan, stat: nav.state}") ==
        "26: components.manage.in.stat: graph.imported_input_unknown(path/Manager,  [state] state, plan)");
  const std::string two_faults = "plan: {from: plan.plan, max_age: 3 m, dely: true}}";
  CHECK(changed("plan: plan.plan}", two_faults) ==
        "26: graph.key_unknown(components.manage.in.plan: , dely,  [] from, max_age, delayed)\n26: "
        "components.manage.in.plan.max_age: graph.dimension_differs(3 m, a length, , a time)");
  CHECK(changed("plan: plan.plan}", "plan: {max_age: 3 s}}") ==
        "26: components.manage.in.plan: graph.source_missing");
  CHECK(changed("{state: nav.state, plan:", "{state: fcu.imu, plan:") ==
        "26: components.manage.in.state: graph.component_of_other_io(fcu, fcu)");
  const std::string planner = "use: path/Planner,";
  CHECK(changed(planner, planner + " in: {edit: plan.plan},") ==
        "25: components.plan.in.edit: graph.message_types_mismatch(plan, edit, PlanEdit, plan.plan, Plan)");
}

TEST_CASE("a request is not fed by an output that is sent in every step") {
  Mission mission;
  mission.shelf.plugins["path"]->components[1].outputs.push_back(
      mission.shelf.plugins["path"]->components[0].inputs[2]);
  Port& port = mission.shelf.plugins["path"]->components[1].outputs.back();
  port.name = "wish";
  port.kind = FULMAR_OUT_VALUE;
  mission.replace("use: path/Planner,", "use: path/Planner, in: {edit: {from: manage.wish, delayed: true}},");
  CHECK(mission.faults() ==
        "hourglass.yaml:25: components.plan.in.edit: graph.request_source_invalid(plan, edit, manage.wish)");
  port.kind = FULMAR_OUT_EVENT;
  CHECK(mission.faults() == "");
}

TEST_CASE("messages of one name with different tables are distinguished by their first difference") {
  Mission mission;
  auto other = std::make_shared<Type>(*mission.shelf.plugins["path"]->components[1].inputs[1].type);
  other->fields[0].unit = "m";
  ++other->hash;
  mission.shelf.plugins["path"]->components[1].inputs[1].type = other;
  CHECK(mission.faults() ==
        "hourglass.yaml:26: components.manage.in.plan: graph.message_types_differ(plan.plan, Plan, manage, "
        "plan, revision: types.reader_differs(unit , m, none))");
}

TEST_CASE("a cycle is printed as a path, with a remedy") {
  const std::string inputs = "in: {state: nav.state, path: manage.path", outputs = "}, out: {command";
  CHECK(changed(inputs + outputs, inputs + ", back: inner.actuators" + outputs) == "");
  Mission mission;
  auto& follow = mission.shelf.plugins["path"]->components[2];
  follow.inputs.push_back(mission.shelf.plugins["sim_aero"]->components[0].inputs[0]);
  follow.inputs.back().name = "back";
  follow.inputs.back().optional = true;
  mission.replace("fills: guide,", "fills: guide, in: {back: inner.actuators},");
  CHECK(mission.faults() ==
        "hourglass.yaml:27: graph.connection_cycle(follow -> slc -> attitude -> , follow)");
  mission.replace("back: inner.actuators", "back: {from: inner.actuators, delayed: true}");
  CHECK(mission.faults() == "");
}

TEST_CASE("wires carry their age limit, their own or their component's") {
  Mission mission;
  mission.replace(
      "use: path/Manager, in: {state: nav.state, plan: plan.plan}",
      "use: path/Manager, max_age: 3 s, in: {state: {from: nav.state, max_age: 200 ms}, plan: plan.plan}");
  const Graph graph = mission.load();
  CHECK(wire(graph, "manage", "state").max_age_ns == 200'000'000);
  CHECK(wire(graph, "manage", "plan").max_age_ns == 3'000'000'000);
  CHECK(wire(graph, "score", "state").max_age_ns == 0);
}

TEST_CASE("a component's own wire wins over that of its role") {
  Mission mission;
  mission.replace("{fills: guide, use", "{fills: guide, in: {state: vehicle.truth}, use");
  const Graph graph = mission.load();
  CHECK(graph.roles[0].outputs[static_cast<std::size_t>(wire(graph, "follow", "state").from.output)].name ==
        "truth");
  CHECK(graph.roles[1].outputs[static_cast<std::size_t>(wire(graph, "slc", "state").from.output)].name ==
        "state");
}

TEST_CASE("ties of the order follow the file, wires follow their sources") {
  Mission mission;
  const auto at = mission.text.find("  score:  {use"), end = mission.text.find('\n', at) + 1;
  const std::string line = mission.text.substr(at, end - at);
  mission.text.erase(at, end - at);
  mission.replace(
      "\ncomponents:\n",
      "\ncomponents:\n" + line);  // first in the file, but it needs the attitude command of all three
  const Graph graph = mission.load();
  CHECK(graph.components.front().name == "score");
  CHECK(names(graph, graph.order) ==
        join({"ekf", "plan", "manage", "follow", "slc", "tecs", "mine", "score", "attitude"}));
}

TEST_CASE("a component that is only wired by name exists, and so does its source") {
  Mission mission;
  mission.replace("score, in: {state: nav.state, truth: vehicle.truth",
                  "score, in: {state: nav.state, truth: truth.state");
  mission.replace("in: {truth: vehicle.truth}, only: sim}",
                  "in: {truth: second.state}, only: sim}\n  second: {fills: nav, use: estimator_ekf}");
  const Graph graph = mission.load();
  REQUIRE(index_of(graph, "second") >= 0);
  CHECK(wire(graph, "truth", "truth").from.index == index_of(graph, "second"));
}

TEST_CASE("a component that fills nothing now but is wired by name exists and steps in every phase") {
  Mission mission;
  mission.replace("score, in: {state: nav.state, truth: vehicle.truth",
                  "score, in: {state: nav.state, truth: truth.state");
  const Graph graph = mission.load();
  REQUIRE(index_of(graph, "truth") >= 0);
  CHECK(component(graph, "truth").roles.empty());
  CHECK(wire(graph, "score", "truth").from.kind == Source::Kind::component);
  CHECK(wire(graph, "truth", "truth").from.kind == Source::Kind::role);
}

}  // namespace wires_test
