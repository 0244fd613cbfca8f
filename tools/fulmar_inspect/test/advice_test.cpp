// SPDX-License-Identifier: BSD-3-Clause
// Advice on valid missions: readers of a replaced component, ports of the same type without a connection.
#include "tools/fulmar_inspect/advice.hpp"

#include <doctest/doctest.h>

#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace advice_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

Advice advised(Mission& mission) {
  const Graph graph = mission.load();
  CHECK(graph.source.warnings.empty());
  Report report;
  return advice_on(graph, parse_mission(graph.source.file, {}, report));
}

}  // namespace

TEST_CASE("who goes on listening to a manager that was replaced is warned of") {
  Layered mission(
      "extends: ground.yaml\nroles: {guide: {in: {path: mine_too.path}}}\ncomponents:\n"
      "  mine_too: {use: path/Manager, in: {state: nav.state, plan: plan.plan}}\n");
  const std::string why = ", manage, ground.yaml, mine_too)";
  CHECK(advised(mission) ==
        std::vector<std::string>{"ground.yaml:32: inspect.replaced_component_read(score.path" + why,
                                 "ground.yaml:8: inspect.replaced_component_read(done" + why,
                                 "ground.yaml:9: inspect.replaced_component_read(progress" + why});
  mission.text +=
      "  score: {in: {path: mine_too.path}}\ndone: \"mine_too.progress.circuits >= 2\"\nprogress: null\n";
  CHECK(advised(mission).empty());  // the former one flies along without a reader
  Mission usual;
  CHECK(advised(usual).empty());
}

TEST_CASE("also of a manager with messages of its own, by whatever looks at the former one, each once") {
  Layered mission(
      "extends: ground.yaml\ncomponents:\n  knots: {use: spline/Manager, in: {state: nav.state, plan: "
      "plan.plan}}\n  follow: {use: spline/Follower, in: {way: knots.way}}\n"
      "resume: {attitude.roll_kp: manage.progress.item}\nsummary: {progress: manage.progress}\n"
      "progress: [manage.progress.item, manage.progress.circuits]\n"
      "phases: {any: {next: [{to: hold, when: \"manage.progress.circuits > 9\"}]}}\n");
  mission.shelf.add("spline", "Manager", {in<VehicleState>("state"), in<Plan>("plan")},
                    {out<Progress>("way")});
  mission.shelf.add("spline", "Follower", {in<VehicleState>("state"), in<Progress>("way")},
                    {out<GuidanceCommand>("command")});
  const std::string why = ", manage, ground.yaml, knots)";
  CHECK(advised(mission) ==
        std::vector<std::string>{
            "ground.yaml:32: inspect.replaced_component_read(score.path" + why,
            "ground.yaml:8: inspect.replaced_component_read(done" + why,
            "hourglass.yaml:7: inspect.replaced_component_read(progress" + why,
            "hourglass.yaml:6: inspect.replaced_component_read(summary.progress" + why,
            "hourglass.yaml:5: inspect.replaced_component_read(resume.attitude.roll_kp" + why,
            "hourglass.yaml:8: inspect.replaced_component_read(phases.any.next" + why});
}

TEST_CASE("a list under tell that replaces another one is reported with the ports that it leaves out") {
  Layered mission("extends: middle.yaml\ntell: [plan.notices]\n");
  mission.folder.write("middle.yaml", "extends: ground.yaml\ntell: [manage.notices, plan.notices]\n");
  for (ComponentInfo& c : mission.shelf.plugins["path"]->components)
    c.outputs.push_back(out<Notice>("notices", FULMAR_OUT_QUEUE));
  CHECK(advised(mission) ==
        std::vector<std::string>{
            "hourglass.yaml:2: tell: inspect.report_list_incomplete(manage.notices, middle.yaml:2)"});
  mission.text = "extends: middle.yaml\ntell: null\n";
  CHECK(advised(mission).empty());
}

TEST_CASE("an output without a reader and an input of its type without a source are proposed to be wired") {
  Layered mission("extends: ground.yaml\ncomponents: {detour: {use: detour}}\n");
  mission.shelf.add("detour", "Detour", {port<Notice>("results", FULMAR_IN_QUEUE)},
                    {out<PlanEdit>("edits", FULMAR_OUT_QUEUE)});
  CHECK(advised(mission) ==
        std::vector<std::string>{"hourglass.yaml:2: inspect.output_without_reader(detour.edits, plan.edits, "
                                 "PlanEdit, plan: {in: {edits: detour.edits}})"});
  mission.text =
      "extends: ground.yaml\ncomponents: {detour: {use: detour}, plan: {in: {edits: detour.edits}}, "
      "log: {use: log, in: {notes: plan.results}}}\n";
  for (ComponentInfo& c : mission.shelf.plugins["path"]->components)
    if (c.name == "Planner") c.outputs.push_back(out<Notice>("results", FULMAR_OUT_QUEUE));
  mission.shelf.add("log", "Log", {port<Notice>("notes", FULMAR_IN_QUEUE)}, {});
  CHECK(advised(mission) ==
        std::vector<std::string>{"hourglass.yaml:2: inspect.input_without_source(detour.results, "
                                 "plan.results, Notice, detour: {in: {results: plan.results}})"});
}

}  // namespace advice_test
