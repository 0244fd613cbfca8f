// SPDX-License-Identifier: BSD-3-Clause
// The graph of a correct mission.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/graph/condition.hpp"
#include "core/graph/test/shelf.hpp"
#include "core/types/named.hpp"
#include "fulmar/msg/origin.hpp"
#include "tools/fulmar_inspect/print_graph.hpp"

namespace resolve_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// phase -> filler of `role`
std::string filler(const Graph& graph, const std::string& phase, const std::string& role) {
  for (const Phase& p : graph.phases)
    for (std::size_t r = 0; r < graph.roles.size(); ++r)
      if (p.name == phase && graph.roles[r].name == role) return names(graph, {p.roles[r].component});
  return "?";
}
}  // namespace

TEST_CASE("the hourglass mission resolves into components, order, roles and phases") {
  Mission mission;
  const Graph graph = mission.load();
  CHECK(graph.mission == "hourglass");
  CHECK(graph.tick_ns == 2'500'000);
  CHECK(graph.seed == 7);
  CHECK(graph.arm);
  CHECK(graph.timeout_ns == 3600'000'000'000);
  CHECK(graph.epoch_ns == 1767225600'000000000);
  CHECK(graph.components[static_cast<std::size_t>(graph.vehicle)].name == "sim");
  CHECK(names(graph, graph.order) ==
        join({"ekf", "plan", "manage", "follow", "slc", "tecs", "mine", "attitude", "score"}));
  CHECK(index_of(graph, "fcu") == -1);
  CHECK(index_of(graph, "truth") == -1);  // fills a role, but no phase uses it
  CHECK(component(graph, "slc").use == "control_slc/Outer");
  CHECK(component(graph, "mine").use == "my_law/Outer");
  CHECK(component(graph, "slc").period_ns == 10'000'000);
  CHECK(component(graph, "ekf").period_ns == 0);
  CHECK(component(graph, "plan").roles.empty());
  CHECK(wire(graph, "slc", "command").from.kind == Source::Kind::role);
  CHECK(wire(graph, "manage", "plan").from == Source{Source::Kind::component, index_of(graph, "plan"), 0});
  CHECK(wire(graph, "plan", "state").from.kind == Source::Kind::none);
  REQUIRE(graph.roles.size() == 5);
  CHECK(names(graph, graph.roles[3].fillers) == "slc, tecs, mine");
  CHECK(graph.roles[0].provides[0].back() == component(graph, "sim").info().output("truth"));
  REQUIRE(graph.phases.size() == 4);
  CHECK(filler(graph, "hold", "outer") == "slc");
  CHECK(filler(graph, "cruise", "outer") == "tecs");
  CHECK(filler(graph, "cruise", "guide") == "follow");
  CHECK(graph.phases[1].next[0].for_ns == 500'000'000);
  CHECK(graph.phases[1].next[0].to == 2);
  CHECK(graph.any.size() == 1);
  CHECK(names(graph, {graph.phases[3].roles[3].fallback}) == "tecs");
  CHECK(graph.judge.done->text() == "manage.progress.circuits >= 2");
  REQUIRE(graph.judge.progress.size() == 4);
  CHECK(graph.judge.progress[1].field.unit == "m/s");
  CHECK(graph.judge.progress[3].field.unit == "rad");
  CHECK(graph.judge.summary.size() == 2);
}

TEST_CASE("one option flies the mission on hardware: only the chosen vehicle exists") {
  Mission mission;
  Overrides overrides;
  overrides.io = "fcu";
  const Graph graph = mission.load(overrides);
  CHECK(graph.io == Io::fcu);
  CHECK_FALSE(graph.arm);  // on hardware the pilot arms
  CHECK(index_of(graph, "sim") == -1);
  CHECK(graph.components[static_cast<std::size_t>(graph.vehicle)].name == "fcu");
  CHECK(wire(graph, "score", "truth").from.kind == Source::Kind::none);  // there is no truth on hardware
  CHECK(graph.roles[0].provides[0].back() == -1);
}

TEST_CASE("the flags of the aircraft are in the vehicle's status, unless the mission names them") {
  Mission mission;
  Overrides overrides;
  overrides.io = "fcu";
  const auto field = [](const Graph& graph, const VehicleFlag& flag) {
    const Component& vehicle = graph.components[static_cast<std::size_t>(flag.from.index)];
    const Port& port = vehicle.info().outputs[static_cast<std::size_t>(flag.from.output)];
    for (const Field& f : port.type->fields)
      if (f.offset == flag.offset) return vehicle.name + "." + port.name + "." + f.name;
    return std::string();
  };
  const Graph usual = mission.load(overrides);
  CHECK(field(usual, usual.flags.armed) == "fcu.status.armed");
  CHECK(field(usual, usual.flags.on_ground) == "fcu.status.on_ground");
  CHECK(field(usual, usual.flags.in_control) == "fcu.status.in_control");
  mission.replace("truth?: VehicleState}}", "truth?: VehicleState}, flags: {in_control: status.override}}");
  const Graph named = mission.load(overrides);
  CHECK(field(named, named.flags.in_control) == "fcu.status.override");
  CHECK(field(named, named.flags.armed) == "fcu.status.armed");  // other flags keep their default
}

TEST_CASE("only a vehicle called sim or fcu exists with that io alone by default") {
  Mission mission;
  mission.replace("  truth:  {fills: nav, use: sim_aero/TruthState, in: {truth: vehicle.truth}, only: sim}",
                  "  truth:  {fills: nav, use: sim_aero/TruthState, in: {truth: vehicle.truth}, only: sim}\n"
                  "  other:  {fills: vehicle, use: fcu_serial, only: fcu}");
  CHECK(index_of(mission.load(), "other") == -1);
  mission.replace("  fcu:    {fills: vehicle,", "  fcu:    {only: sim, fills: vehicle,");
  CHECK(mission.faults().find("graph.vehicles_repeated(") ==
        std::string::npos);  // the first that fills the role
  Overrides overrides;
  overrides.io = "fcu";
  const Graph graph = mission.load(overrides);  // `only:` takes precedence
  CHECK(graph.components[static_cast<std::size_t>(graph.vehicle)].name == "other");
}

TEST_CASE("a required input without a source on hardware is reported") {
  Mission mission;
  mission.shelf.plugins["score"]->components[0].inputs[1].optional = false;
  CHECK(mission.faults() == "");
  Overrides overrides;
  overrides.io = "fcu";
  CHECK(mission.faults(overrides) ==
        "hourglass.yaml:32: graph.output_not_provided(components.score: the input 'truth' , vehicle, truth)");
}

TEST_CASE(
    "a value that a phase hides is warned of, and so is a component in a phase that sets what it lacks") {
  Mission mission;
  Overrides hidden;
  hidden.set = {{"slc.law", "takeoff"}};
  const auto warned = [](const Graph& graph, const std::string& words) {
    return std::count_if(graph.source.warnings.begin(), graph.source.warnings.end(),
                         [&](const std::string& w) { return w.find(words) != std::string::npos; });
  };
  CHECK(warned(mission.load(hidden), "graph.setting_hidden(slc.law, takeoff, takeoff)") == 1);
  Overrides open;
  open.set = {{"slc.course_kp", "1.3"}, {"attitude.roll_limit", "30 deg"}};
  CHECK(warned(mission.load(open), "graph.setting_hidden(") == 0);
  std::erase_if(mission.shelf.plugins["my_law"]->components[0].params,
                [](const ParamInfo& param) { return param.name == "law"; });
  Overrides other;
  other.roles = {{"outer", "mine"}};
  CHECK(warned(mission.load(other), "graph.phase_settings_lost(outer, mine, takeoff, law)") == 1);
  other.roles = {{"outer", "tecs"}};
  CHECK(warned(mission.load(other), "graph.phase_settings_lost(") == 0);  // it has that parameter
}

TEST_CASE("the command line changes the fillers of roles, seed and parameters") {
  Mission mission;
  Overrides overrides;
  overrides.roles = {{"nav", "truth"}, {"outer", "tecs"}};
  overrides.seed = 12;
  overrides.set = {{"sim.turbulence", "moderate"}, {"attitude.roll_limit", "30 deg"}};
  const Graph graph = mission.load(overrides);
  CHECK(graph.seed == 12);
  for (const char* phase : {"hold", "takeoff", "cruise", "research"}) {
    CHECK(filler(graph, phase, "nav") == "truth");
    CHECK(filler(graph, phase, "outer") == "tecs");
  }
  REQUIRE(graph.phases[1].roles[3].set.size() ==
          1);  // the phase's overlay applies to the parameters that the component has
  CHECK(graph.phases[1].roles[3].set[0].param == component(graph, "tecs").info().param("law"));
  CHECK(graph.phases[3].roles[3].fallback == -1);
  CHECK(index_of(graph, "ekf") == -1);
  CHECK(param(graph, "sim", "turbulence").integer == 2);
  CHECK(param(graph, "attitude", "roll_limit").number[0] == doctest::Approx(0.523598775598));
}

TEST_CASE(
    "a mission extends a base: named things merge, anything else is replaced, faults name the real file") {
  Mission mission;
  mission.folder.write("base/common.yaml", mission.text.replace(mission.text.find("airframe: anaconda.yaml"),
                                                                23, "airframe: ../anaconda.yaml"));
  mission.text =
      "mission: calm\nextends: base/common.yaml\nseed: 3\norigin: {lat: 1, lon: 2, alt_msl: 0 "
      "m}\ncomponents:\n  sim: {params: {turbulence: none}}\n  "
      "plan: {params: {plan: plans/hourglass.yaml}}\n"
      "phases:\n  takeoff: {outer: tecs}\n";
  const Graph graph = mission.load();
  CHECK(graph.mission == "calm");
  CHECK(graph.seed == 3);
  CHECK(param(graph, "sim", "turbulence").integer == 0);
  CHECK(param(graph, "sim", "wind_ned").number[0] == 3);               // of the base
  CHECK(value<Origin>(param(graph, "sim", "origin")).alt_msl_m == 0);  // replaced as a whole
  CHECK(graph.phases[0].name == "hold");                               // order of the base
  CHECK(filler(graph, "takeoff", "outer") == "tecs");
  CHECK(graph.phases[1].roles[3].set.empty());  // a phase's entry of a role is replaced
  CHECK(graph.phases[1].next.size() == 1);      // its transitions stay
  std::vector<std::string> files;
  for (const auto& [name, text] : graph.source.attachments) files.push_back(name);
  CHECK(join(files) == "hourglass.yaml, common.yaml, anaconda.yaml, plans/hourglass.yaml");

  mission.replace("turbulence: none", "turbulence: nne").replace("seed: 3", "sed: 3");
  std::string base = hourglass;
  base.replace(base.find("airframe: anaconda.yaml"), 23, "airframe: ../anaconda.yaml");
  base.replace(base.find("[3, -4, 0]"), 10, "[3, -4, m]");
  mission.folder.write("base/common.yaml", base);
  CHECK(mission.faults() ==
        "hourglass.yaml:3: graph.key_unknown(, sed,  [seed] mission, extends, io, airframe, origin, rate, "
        "seed, arm, done, failed, flown, verdict, timeout, epoch, progress, summary, failsafe, roles, "
        "components, phases, record, control, tell, resume, live, dds, hardware)\nhourglass.yaml:6: "
        "components.sim.params.turbulence: graph.choice_unknown(nne,  [none] none, light, "
        "moderate)\nbase/common.yaml:21: components.sim.params.wind_ned.down: graph.number_invalid(m)");
}

TEST_CASE("two files of one name are both kept, and equal files once") {
  Mission mission;
  const Graph graph = mission.load();
  REQUIRE(graph.source.attachments.size() == 3);
  CHECK(graph.source.attachments[0].first == "hourglass.yaml");
  CHECK(graph.source.attachments[0].second == mission.text);
  CHECK(graph.source.attachments[1].first == "anaconda.yaml");
  CHECK(graph.source.attachments[2].first == "plans/hourglass.yaml");
  CHECK(graph.source.attachments[2].second == hourglass_plan);
}

TEST_CASE("recording is off, all, or by pattern") {
  Mission mission;
  CHECK(mission.load().record);
  CHECK(mission.load().record_rules.empty());
  mission.replace("seed: 7", "record: off");
  CHECK_FALSE(mission.load().record);
  mission.replace("record: off", "record: {file: a.mcap, ports: {\"nav.*\": 50 Hz, \"*\": all}}");
  const Graph graph = mission.load();
  CHECK(graph.record_file == "a.mcap");
  REQUIRE(graph.record_rules.size() == 2);
  CHECK(graph.record_rules[0].period_ns == 20'000'000);
  CHECK(graph.record_rules[1].period_ns == 0);
}

TEST_CASE("a mission without roles and phases is one phase in which everything steps") {
  Mission mission;
  mission.text =
      "airframe: anaconda.yaml\ncomponents:\n  boat: {use: sim_aero, in: {actuators: inner.actuators}}\n  "
      "est: {use: sim_aero/TruthState, "
      "in: {truth: boat.truth}}\n"
      "  inner: {use: control_slc/Inner, in: {state: est.state, attitude: law.attitude}}\n  law: {use: "
      "control_tecs, in: {state: "
      "est.state, command: follow.command}}\n"
      "  follow: {use: path/VectorField, in: {state: est.state, path: m.path}}\n  m: {use: path/Manager, in: "
      "{state: est.state, plan: "
      "p.plan}}\n  p: {use: path}\n";
  const Graph graph = mission.load();
  CHECK(graph.mission == "hourglass");  // the file's name
  CHECK(names(graph, graph.order) == join({"est", "p", "m", "follow", "law", "inner"}));
  REQUIRE(graph.phases.size() == 1);
  CHECK(graph.phases[0].name == "flight");
}

TEST_CASE("the graph is printed for users and for tools") {
  Mission mission;
  const Graph graph = mission.load();
  const std::string text = print_graph(graph, "text");
  const std::string head =
      "mission hourglass, io sim, 400 Hz, seed 7\n\norder of a tick\n"
      "  in  sim       sim_aero/Aircraft   vehicle   400 Hz\n";
  CHECK(text.starts_with(head));
  for (const char* part :
       {"  slc.command              <- guide.command         GuidanceCommand, at most 1 s old\n",
        "  takeoff: vehicle sim, nav ekf, guide follow, outer slc (law set), inner attitude\n"
        "    -> cruise when nav.state.height_m > 30 m for 0.5 s\n",
        "outer mine (fallback tecs)"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part);
  const std::string dot = print_graph(graph, "dot");
  CHECK(dot.starts_with("digraph \"hourglass\" {"));
  CHECK(dot.find("  follow -> slc [label=\"command\"];\n") != std::string::npos);
  CHECK(std::count(dot.begin(), dot.end(), '{') == std::count(dot.begin(), dot.end(), '}'));
  const std::string mermaid = print_graph(graph, "mermaid");
  CHECK(mermaid.starts_with("flowchart LR\n"));
  const std::string edge = "  c_follow -- command --> c_slc\n";
  CHECK(mermaid.find(edge) != std::string::npos);
  CHECK_THROWS_WITH_AS(print_graph(graph, "svg"), "inspect.format_unknown(svg,  [] text, dot, mermaid)",
                       Error);
}

TEST_CASE("a flag that the mission names in an output of the other io is none, not that of the status") {
  Mission mission;
  mission.replace("truth?: VehicleState}}", "truth?: VehicleState}, flags: {armed: truth.origin_valid}}");
  CHECK(mission.faults() == "");
  Overrides overrides;
  overrides.io = "fcu";
  CHECK(mission.faults(overrides).find(
            "graph.vehicle_flags_missing(fcu, fcu_serial/Fcu, armed, status, armed: PORT.FIELD,  Its flags: "
            "rc.link, status.armed, status.override, status.failsafe, status.on_ground, status.crashed, "
            "status.in_control, status.offboard, status.contact_known.)") != std::string::npos);
}

TEST_CASE("a component at the mission's own rate steps in every tick, and has no separate period") {
  Mission mission;
  mission.replace("control_slc/Outer, rate: 100 Hz", "control_slc/Outer, rate: 400 Hz");
  CHECK(component(mission.load(), "slc").period_ns == 0);
}

TEST_CASE("a rate outside the vehicle's range is rejected, too slow as well as too fast") {
  Mission mission;
  mission.replace("rate: 400 Hz", "rate: 40 Hz");
  CHECK(mission.faults().starts_with(
      "hourglass.yaml:5: graph.mission_rate_invalid(sim, 40, 50, 2000, sim_aero/Aircraft)\n"));
}

}  // namespace resolve_test
