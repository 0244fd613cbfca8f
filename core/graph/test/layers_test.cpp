// SPDX-License-Identifier: BSD-3-Clause
// Missions in layers, and changes of a part by a mission or the command line: a wire, a field of a record.
#include <doctest/doctest.h>

#include <cstring>

#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "core/types/named.hpp"
#include "core/types/names.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace layers_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::string left_out(const Graph& graph) {
  std::vector<std::string> list;
  for (const auto& [key, port] : graph.judge.left_out) list.push_back(key + " (" + port + ")");
  return join(list);
}

Overrides set(const std::string& name, const std::string& value) {
  Overrides o;
  o.set.emplace_back(name, value);
  return o;
}

}  // namespace

TEST_CASE("a mission extends one that extends another one, to any depth, each relative to its own folder") {
  Layered mission("extends: trials/one.yaml\nseed: 11\n");
  mission.folder.write("trials/one.yaml", "extends: two.yaml\nrate: 200 Hz\nseed: 9\n");
  mission.folder.write("trials/two.yaml", "extends: ../ground.yaml\nrate: 100 Hz\ntimeout: 60 s\nseed: 8\n");
  const Graph graph = mission.load();
  CHECK(graph.seed == 11);
  CHECK(graph.tick_ns == 5'000'000);
  CHECK(graph.timeout_ns == 60'000'000'000);
  CHECK(nth(graph.components, 0).name == "sim");
  std::vector<std::string> files;
  for (const auto& [name, text] : graph.source.attachments) files.push_back(name);
  CHECK(join(files) ==
        "hourglass.yaml, one.yaml, two.yaml, ground.yaml, anaconda.yaml, plans/hourglass.yaml");
}

TEST_CASE("a layer that is missing, is broken, or extends itself is the only fault") {
  Layered mission("extends: one.yaml\nsed: 3\n");
  mission.folder.write("one.yaml", "extends: nowhere.yaml\n");
  CHECK(mission.faults() == "one.yaml:1: graph.extends_file_invalid(graph.file_missing(nowhere.yaml, ))");
  mission.folder.write("one.yaml", "- a list\n");
  CHECK(mission.faults() ==
        "one.yaml:1: extends: graph.value_not_valid(a map with the keys of a mission, a list)");
  mission.folder.write("one.yaml", "extends: two.yaml\n");
  mission.folder.write("two.yaml", "extends: one.yaml\n");
  CHECK(mission.faults() ==
        "two.yaml:1: graph.extends_cycle(hourglass.yaml -> one.yaml -> two.yaml -> , one.yaml)");
  mission.text = "extends: hourglass.yaml\n";
  CHECK(mission.faults() == "hourglass.yaml:1: graph.extends_cycle(hourglass.yaml -> , hourglass.yaml)");
}

TEST_CASE("null removes a wire, a component, a phase, a parameter, a key") {
  Layered mission(
      "extends: ground.yaml\ndone: null\nsummary: {tracking_rmse: null}\ncomponents:\n"
      "  mine: null\n  score: {in: {truth: null}}\n  sim: {params: {wind_ned: null}}\n"
      "phases:\n  research: null\n  cruise: {next: null}\n  takeoff: {outer: null}\n");
  const Graph graph = mission.load();
  CHECK(names_of(graph.components) == std::vector<std::string>{"sim", "ekf", "plan", "manage", "follow",
                                                               "slc", "tecs", "attitude", "score"});
  CHECK(wire(graph, "score", "truth").from.kind == Source::Kind::none);
  CHECK(wire(graph, "score", "state").from.kind == Source::Kind::role);
  CHECK(param(graph, "sim", "wind_ned").number[0] == 0);
  CHECK(join(names_of(graph.phases)) == "hold, takeoff, cruise");
  CHECK(nth(graph.phases, 1).roles[3].set.empty());
  CHECK_FALSE(graph.judge.done);
  REQUIRE(graph.judge.summary.size() == 1);
  CHECK(graph.judge.summary[0].first == "estimation_rmse");
}

TEST_CASE("a key that a lower layer removed can be set again above") {
  Layered mission("extends: one.yaml\ncomponents: {score: {in: {truth: vehicle.truth}}}\n");
  mission.folder.write("one.yaml", "extends: ground.yaml\ncomponents: {score: {in: {truth: null}}}\n");
  CHECK(wire(mission.load(), "score", "truth").from.kind == Source::Kind::role);
}

TEST_CASE("null for a key that does not exist below is a fault at its own place") {
  const auto reported = [](const std::string& text) {
    Layered mission("extends: ground.yaml\n" + text);
    return mission.faults();
  };
  const std::string no_input = "components: {score: {in: {trth: null}}}\n";
  CHECK(
      reported(no_input) ==
      "hourglass.yaml:2: graph.removed_connection_missing(components.score, trth, . Did you mean 'truth'?)");
  CHECK(reported("components:\n  scor: null\n") ==
        "hourglass.yaml:3: graph.removed_key_missing(components: , ground.yaml, scor, . Did you mean "
        "'score'?)");
  CHECK(
      reported("phases: {cruse: null}\n") ==
      "hourglass.yaml:2: graph.removed_key_missing(phases: , ground.yaml, cruse, . Did you mean 'cruise'?)");
  CHECK(reported("components: {sim: {params: {wind: ~}}}\n") ==
        "hourglass.yaml:2: graph.removed_key_missing(components.sim.params: , ground.yaml, wind, )");
  CHECK(reported("resume: null\n") == "hourglass.yaml:2: graph.removed_key_missing(, ground.yaml, resume, )");
  CHECK(reported("failsafe: {elevator: null}\n") ==
        "hourglass.yaml:2: graph.removed_key_missing(failsafe: , ground.yaml, elevator, )");
  const std::string calm =  // a phase in which no component changes
      "phases:\n  cruise: {next: [{to: calm, when: \"time > 9 s\"}]}\n  calm:\n  research: null\n";
  CHECK(reported(calm) == "");
}

TEST_CASE("null removes entries of other maps") {
  Layered mission(
      "extends: middle.yaml\nresume: {manage.first: null}\nfailsafe: {aileron: null}\nlive: {token: null}\n"
      "record: {rate: null}\ndds: {import: {plan.edits: null}, humble: null}\n");
  mission.folder.write("middle.yaml",
                       "extends: ground.yaml\nresume: {manage.first: manage.progress.item}\n"
                       "failsafe: {aileron: 3 deg}\nlive: {listen: \"8000\", token: x}\nrecord: {rate: 5 Hz, "
                       "file: a.mcap}\ndds: {import: {plan.edits: /edits}, humble: true, domain: 3}\n");
  const Graph graph = mission.load();
  CHECK(graph.resume.empty());
  CHECK(graph.failsafe_ns == 2'000'000'000);
  CHECK(graph.live.token.empty());
  CHECK(graph.live.port == 8000);
  CHECK(graph.record_rules.empty());
  CHECK(graph.record_file == "a.mcap");
  CHECK(graph.dds.imports.empty());
  CHECK(graph.dds.domain == 3);
  CHECK_FALSE(graph.dds.humble);
}

TEST_CASE("null removes the wire that a role brings, unless the input is required") {
  Layered mission(
      "extends: ground.yaml\nroles: {outer: {in: {rc: vehicle.rc}}}\ncomponents:\n"
      "  slc: {in: {rc: null}}\n");
  mission.shelf.plugins["control_slc"]->components[0].inputs.push_back(optional<Rc>("rc"));
  CHECK(wire(mission.load(), "slc", "rc").from.kind == Source::Kind::none);
  mission.text += "  ekf: {in: {gnss: null}}\n";
  CHECK(mission.faults() == "hourglass.yaml:5: graph.input_disconnected(components.ekf: the input 'gnss' )");
}

TEST_CASE("a removed name that is still used is one fault, with all places") {
  Layered mission("extends: ground.yaml\ncomponents:\n  manage: null\n");
  CHECK(mission.faults() ==
        "hourglass.yaml:3: graph.still_named(components.manage, roles.guide.in.path (ground.yaml:16), "
        "components.score.in.path (ground.yaml:32), done (ground.yaml:8), progress (ground.yaml:9))");
  mission.text = "extends: ground.yaml\nroles: {outer: null}\n";
  const std::string role = mission.faults();
  CHECK(role.find(
            "hourglass.yaml:2: graph.still_named(roles.outer, phases.hold.outer (ground.yaml:36), "
            "phases.takeoff.outer (ground.yaml:37), phases.cruise.outer (ground.yaml:38), "
            "phases.research.outer (ground.yaml:39), components.slc.fills (ground.yaml:28), "
            "components.tecs.fills (ground.yaml:29), components.mine.fills (ground.yaml:31), "
            "roles.inner.in.attitude (ground.yaml:18), components.score.in.attitude (ground.yaml:32))") == 0);
  CHECK(role.find('\n') == std::string::npos);
  for (const char* by : {"phases.hold.outer (ground.yaml:36)", "components.slc.fills (ground.yaml:28)",
                         "roles.inner.in.attitude (ground.yaml:18)"})
    CHECK_MESSAGE(role.find(by) != std::string::npos, role);
  mission.text = "extends: ground.yaml\nphases: {takeoff: null}\n";
  CHECK(mission.faults() ==
        "hourglass.yaml:2: graph.still_named(phases.takeoff, phases.hold.next.to (ground.yaml:36))");
}

TEST_CASE(
    "figures, verdict and texts are dropped with the component that a layer removes, and are reported") {
  Layered mission("extends: ground.yaml\ncomponents:\n  score: null\n");
  mission.folder.write("ground.yaml", Mission().text + "\nverdict: score.verdict\ntell: [score.notices]\n");
  const Graph graph = mission.load();
  CHECK_FALSE(graph.judge.verdict);
  CHECK(graph.report.empty());
  REQUIRE(graph.judge.summary.size() == 2);  // their keys stay in the result, without a value
  for (const auto& [key, from] : graph.judge.summary) CHECK(from.kind == Source::Kind::none);
  CHECK(left_out(graph) ==
        "verdict (score.verdict), summary.tracking_rmse (score.tracking), "
        "summary.estimation_rmse (score.estimation), tell (score.notices)");
  REQUIRE(graph.source.warnings.size() == 1);
  CHECK(graph.source.warnings[0].find("graph.outputs_not_in_flight(verdict (score.verdict), ") !=
        std::string::npos);
  mission.text += "done: \"score.tracking.circuits > 1\"\n";  // a condition is not dropped
  CHECK(mission.faults().find(
            "hourglass.yaml:3: graph.still_named(components.score, done (hourglass.yaml:4))") == 0);
}

TEST_CASE(
    "figures are dropped with a component of the other io, and with one that another plugin has replaced") {
  Layered other("extends: ground.yaml\ncomponents: {score: {only: fcu}}\n");
  CHECK(left_out(other.load()) ==
        "summary.tracking_rmse (score.tracking), summary.estimation_rmse (score.estimation)");
  Layered replaced("extends: ground.yaml\ncomponents: {score: {use: control_tecs/Outer, in: null}}\n");
  CHECK(replaced.faults().find("types.name_unknown_in(") == std::string::npos);
  Layered slip("extends: ground.yaml\nsummary: {more: score.trackin}\n");
  CHECK(
      slip.faults().find(
          "types.name_unknown_in(score (score/Score), output, trackin,  [tracking] tracking, estimation)") !=
      std::string::npos);
}

TEST_CASE("a map of a few fields is no record, for every component that reads it") {
  Mission mission;
  const std::string few = "{mass: 5 kg, aero: {lift: {alpha: 5}}}";
  const std::string missing =
      "inertia.xx, inertia.yy, inertia.zz, wing.area, wing.span, wing.chord, aero.pitch.alpha, "
      "propulsion.ct0, "
      "aileron.limit, elevator.limit, rudder.limit";
  for (const std::string reader : {"sim.airframe", "attitude.airframe", "slc.airframe"})
    CHECK(mission.faults(set(reader, few))
              .starts_with("--set " + reader + "=" + few + ": graph.record_incomplete(" + reader +
                           ": , Airframe, " + missing + ", graph.record_field_hint(airframe.inertia.xx))"));
  CHECK(mission.faults(set("sim.airframe.mass", "-5 kg"))
            .find("graph.value_out_of_range(-5 kg, 0.0001, 1e+06,  kg, )") != std::string::npos);
  CHECK(mission.faults(set("sim.airframe.wing.area_m2", "-1")).find("graph.value_out_of_range(-1, ") !=
        std::string::npos);
  mission.folder.write("anaconda.yaml", "mass: 4 kg\n");
  CHECK(mission.faults().find("anaconda.yaml:1: graph.record_incomplete(, Airframe, ") == 0);
  CHECK(mission.faults().find('\n') == std::string::npos);  // once, although several read it
  Mission nowhere;
  nowhere.replace("lon: -111.6474138, ", "");
  CHECK(nowhere.faults() == "hourglass.yaml:4: graph.record_incomplete(origin: , Origin, lon, )");
}

TEST_CASE("a path sets one field of a record: the rest of the record stays") {
  Mission mission;
  const Graph graph = mission.load(set("sim.airframe.mass", "5 kg"));
  const auto changed = value<Airframe>(param(graph, "sim", "airframe"));
  CHECK(changed.mass_kg == 5);
  CHECK(changed.wing.area_m2 == 0.55);
  const auto wing =
      value<Airframe>(param(mission.load(set("sim.airframe.wing.chord", "21 cm")), "sim", "airframe"));
  CHECK(wing.wing.chord_m == 0.21);
  CHECK(wing.wing.span_m == 2.9);
  CHECK(wing.mass_kg == 4.5);
  // other components with the aircraft's data keep them
  CHECK(value<Origin>(param(graph, "sim", "origin")).alt_msl_m == 1387);
}

TEST_CASE("a path in the mission wins over the record, in any order") {
  Mission mission;
  mission.replace("wind_ned: [3, -4, 0]", "airframe.mass: 6 kg, airframe: anaconda.yaml");
  CHECK(value<Airframe>(param(mission.load(), "sim", "airframe")).mass_kg == 6);
  CHECK(value<Airframe>(param(mission.load(set("sim.airframe.mass", "7 kg")), "sim", "airframe")).mass_kg ==
        7);
}

TEST_CASE("a path of a layer wins over the record of the one below, and over a whole one of the same layer") {
  Layered mission("extends: middle.yaml\ncomponents: {sim: {params: {airframe.mass: 6 kg}}}\n");
  mission.folder.write("middle.yaml",
                       "extends: ground.yaml\ncomponents: {sim: {params: {airframe: other.yaml, "
                       "airframe.wing.span: 2 m}}}\n");
  std::string other = anaconda;
  mission.folder.write("other.yaml", other.replace(other.find("4.5 kg"), 6, "9.0 kg"));
  const auto flown = value<Airframe>(param(mission.load(), "sim", "airframe"));
  CHECK(flown.mass_kg == 6);
  CHECK(flown.wing.span_m == 2);
  CHECK(flown.wing.area_m2 == 0.55);
  mission.text = "extends: middle.yaml\ncomponents: {sim: {params: {airframe: anaconda.yaml}}}\n";
  const auto replaced = value<Airframe>(param(mission.load(), "sim", "airframe"));
  CHECK(replaced.mass_kg == 4.5);
  CHECK(replaced.wing.span_m == 2);
}

TEST_CASE("an unknown path is reported with the valid fields") {
  Mission mission;
  const auto reported = [&](const std::string& name, const std::string& value) {
    return mission.faults(set(name, value));
  };
  CHECK(reported("sim.airframe.mas", "5 kg")
            .find("graph.field_unknown(sim.airframe: , mas, Airframe,  Did you mean 'mass'? [] name, "
                  "mass_kg, inertia, wing, "
                  "aero, propulsion, aileron, elevator, rudder, mixer, limits, gear, flap)") !=
        std::string::npos);
  CHECK(reported("sim.airframe.mass", "5").find("sim.airframe.mass: ") != std::string::npos);
  CHECK(reported("sim.airframe.mass", "5 m").find("sim.airframe.mass: ") != std::string::npos);
  CHECK(reported("sim.airframe.mass.x", "5").find("sim.airframe.mass: graph.field_without_parts") !=
        std::string::npos);
  CHECK(reported("sim.airframe.mass[0]", "5").find("graph.field_not_list(mass_kg)") != std::string::npos);
  CHECK(
      reported("sim.wing.span", "3 m")
          .find(
              "graph.parameter_in_record(sim_aero/Aircraft, wing.span, sim.airframe.wing.span, airframe)") !=
      std::string::npos);
  CHECK(reported("plan.turn_radius", "80 m") ==
        "--set plan.turn_radius=80 m: plan: graph.parameter_in_record(path/Planner, turn_radius, "
        "plan.plan.turn_radius, plan)");
  CHECK(reported("attitude.roll_limit", "30")
            .find("graph.value_out_of_range(30, 0, 1.0472,  rad, . Did you mean 30 deg?)") !=
        std::string::npos);
  CHECK(reported("attitude.roll_limit", "70").find("Did you mean") == std::string::npos);
  CHECK(reported("sim.wind_ned.north", "5")
            .find("types.name_unknown_in(sim_aero/Aircraft, parameter, wind_ned.north,  [] rate, epoch, "
                  "wind_ned, turbulence, airframe, origin)") != std::string::npos);
}

TEST_CASE("a path into a list counts its items from 0") {
  Mission mission;
  const Graph graph = mission.load(set("plan.plan.waypoints[1].airspeed", "18 m/s"));
  const auto plan = value<Plan>(param(graph, "plan", "plan"));
  CHECK(plan.waypoints[1].airspeed_mps == 18);
  CHECK(plan.waypoints[0].airspeed_mps != 18);
  CHECK(mission.faults(set("plan.plan.waypoints[9].airspeed", "18 m/s"))
            .find("graph.item_index_excessive(3,  items, 2)") != std::string::npos);
  CHECK(
      mission.faults(set("plan.plan.waypoints[x].airspeed", "9 m/s")).find("graph.item_index_invalid([x])") !=
      std::string::npos);
  CHECK(mission.faults(set("plan.plan.waypoints.airspeed", "9 m/s"))
            .find("graph.item_index_missing(plan.plan.waypoints)") != std::string::npos);
}

TEST_CASE("a single field is no record: missing fields stay missing") {
  Mission mission;
  mission.replace("airframe: anaconda.yaml\n", "");
  CHECK(mission.faults(set("sim.airframe.mass", "5 kg")).find("graph.parameter_missing(sim, airframe, ") !=
        std::string::npos);
}

TEST_CASE("an airframe file with gains is valid for every key that takes an airframe") {
  Mission mission;
  const Graph graph = mission.load(set("sim.airframe", mission.folder.path / "anaconda.yaml"));
  CHECK(value<Airframe>(param(graph, "sim", "airframe")).mass_kg == 4.5);
  CHECK(param(graph, "attitude", "roll_kp").number[0] == 0.7);
}

TEST_CASE("the rules of --record come before those of the mission") {
  Mission mission;
  Overrides o;
  o.record = {"nav.*@100Hz", "attitude.probes"};
  const Graph usual = mission.load(o);
  REQUIRE(usual.record_rules.size() == 3);
  CHECK(usual.record_rules[0].ports[0] == "nav.*");
  CHECK(usual.record_rules[0].period_ns == 10'000'000);
  CHECK(usual.record_rules[1].period_ns == 0);
  CHECK(usual.record_rules[2].ports[0] == "*");
  CHECK(usual.record_rules[2].period_ns == RecordRule::usual);

  mission.replace("seed: 7", "record: {ports: {\"*\": 5 Hz}}");
  const Graph ruled = mission.load(o);
  REQUIRE(ruled.record_rules.size() == 3);
  CHECK(ruled.record_rules[2].period_ns == 200'000'000);
  mission.replace("record: {ports: {\"*\": 5 Hz}}", "record: off");
  CHECK(mission.load(o).record);

  o.record = {"all"};
  CHECK(mission.load(o).record_rules[0].ports[0] == "*");
  o.record = {"nav.stat"};
  CHECK(mission.faults(o) ==
        "--record nav.stat: graph.record_port_unknown(nav.stat,  Did you mean 'nav.state'?)");
  o.record = {"nav.state@often"};
  CHECK(mission.faults(o) ==
        "--record nav.state@often: graph.record_pattern_invalid(graph.number_invalid(often))");
  o.record = {"nav.state@100"};
  CHECK(mission.faults(o).find("graph.unit_missing(100, ") != std::string::npos);
  o.record = {"nav.state@0 Hz"};
  CHECK(mission.faults(o).find("graph.record_rate_invalid") != std::string::npos);
  o.record = {"@5 Hz"};
  CHECK(mission.faults(o) == "--record @5 Hz: graph.record_port_unknown(, )");
}

TEST_CASE("the command line arms, or leaves that to the pilot") {
  Mission mission;
  Overrides o;
  CHECK(mission.load(o).arm);
  o.arm = "off";
  CHECK_FALSE(mission.load(o).arm);
  mission.replace("arm: auto", "arm: off");
  o.arm = "auto";
  CHECK(mission.load(o).arm);
  o.io = "fcu";
  CHECK_FALSE(mission.load(o).arm);  // an aircraft is armed by its pilot
}

}  // namespace layers_test
