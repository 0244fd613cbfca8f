// SPDX-License-Identifier: BSD-3-Clause
// Missions in layers, and what a mission or the command line changes in a part of something: a wire, a field
// of a record.
#include <doctest/doctest.h>

#include <cstring>

#include "core/graph/test/shelf.hpp"
#include "core/types/named.hpp"
#include "core/types/names.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/plan.hpp"

namespace layers_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::string component_names(const Graph& graph) { return join(names_of(graph.components)); }

const ParamValue& param(const Graph& graph, const std::string& owner, const std::string& name) {
  const Component& c = nth(graph.components, index_named(graph.components, owner));
  return nth(c.params, c.info().param(name));
}
const Wire& wire(const Graph& graph, const std::string& owner, const std::string& input) {
  const Component& c = nth(graph.components, index_named(graph.components, owner));
  return nth(c.wires, c.info().input(input));
}
template <class T>
T record_of(const Graph& graph, const std::string& owner, const std::string& name) {
  const ParamValue& value = param(graph, owner, name);
  REQUIRE(value.data.size() == sizeof(T));
  T out;
  std::memcpy(static_cast<void*>(&out), value.data.data(), sizeof out);
  return out;
}

/// The made-up hourglass as the lowest layer of a mission that says `text`.
struct Layered : Mission {
  explicit Layered(const std::string& top) {
    folder.write("ground.yaml", text);
    text = top;
  }
};

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
  for (const auto& [name, text] : graph.attachments) files.push_back(name);
  CHECK(join(files) ==
        "hourglass.yaml, one.yaml, two.yaml, ground.yaml, anaconda.yaml, plans/hourglass.yaml");
}

TEST_CASE("a layer that is not there, is broken, or is its own ground is the only fault") {
  Layered mission("extends: one.yaml\nsed: 3\n");
  mission.folder.write("one.yaml", "extends: x.yaml\n");
  CHECK(mission.faults() == "one.yaml:1: extends: there is no file x.yaml");
  mission.folder.write("one.yaml", "- a list\n");
  CHECK(mission.faults() == "one.yaml:1: extends: expected a map with the keys of a mission, found a list");
  mission.folder.write("one.yaml", "extends: two.yaml\n");
  mission.folder.write("two.yaml", "extends: one.yaml\n");
  CHECK(mission.faults() ==
        "two.yaml:1: extends: the files extend each other: hourglass.yaml -> one.yaml -> "
        "two.yaml -> one.yaml");
  mission.text = "extends: hourglass.yaml\n";
  CHECK(mission.faults() ==
        "hourglass.yaml:1: extends: the files extend each other: hourglass.yaml -> hourglass.yaml");
}

TEST_CASE("null takes away a wire, a component, a phase, a parameter, a key") {
  Layered mission(
      "extends: ground.yaml\ndone: null\nsummary: {tracking_rmse: null}\ncomponents:\n"
      "  mine: null\n  score: {in: {truth: null}}\n  sim: {params: {wind_ned: null}}\n"
      "phases:\n  research: null\n  cruise: {next: null}\n  takeoff: {outer: null}\n");
  const Graph graph = mission.load();
  CHECK(component_names(graph) == "sim, ekf, plan, manage, follow, slc, tecs, attitude, score");
  CHECK(wire(graph, "score", "truth").from.kind == Source::Kind::none);
  CHECK(wire(graph, "score", "state").from.kind == Source::Kind::role);
  CHECK(param(graph, "sim", "wind_ned").number[0] == 0);
  CHECK(join(names_of(graph.phases)) == "hold, takeoff, cruise");
  CHECK(nth(graph.phases, 1).roles[3].set.empty());
  CHECK_FALSE(graph.done);
  REQUIRE(graph.summary.size() == 1);
  CHECK(graph.summary[0].first == "estimation_rmse");
}

TEST_CASE("what is taken away below can be there again above") {
  Layered mission("extends: one.yaml\ncomponents: {score: {in: {truth: vehicle.truth}}}\n");
  mission.folder.write("one.yaml", "extends: ground.yaml\ncomponents: {score: {in: {truth: null}}}\n");
  CHECK(wire(mission.load(), "score", "truth").from.kind == Source::Kind::role);
}

TEST_CASE("null for what is not there below is a fault of its own place") {
  Layered mission("extends: ground.yaml\ncomponents: {score: {in: {trth: null}}}\n");
  CHECK(mission.faults().find("hourglass.yaml:2: components.score.in.trth: expected a port") == 0);
}

TEST_CASE("a path leads into a record: the rest of the record stays") {
  Mission mission;
  const Graph graph = mission.load(set("sim.airframe.mass", "5 kg"));
  const auto changed = record_of<Airframe>(graph, "sim", "airframe");
  CHECK(changed.mass_kg == 5);
  CHECK(changed.wing.area_m2 == 0.55);
  const auto wing =
      record_of<Airframe>(mission.load(set("sim.airframe.wing.chord", "21 cm")), "sim", "airframe");
  CHECK(wing.wing.chord_m == 0.21);
  CHECK(wing.wing.span_m == 2.9);
  CHECK(wing.mass_kg == 4.5);
  // whoever else has the aircraft's data keeps them
  CHECK(record_of<Origin>(graph, "sim", "origin").alt_msl_m == 1387);
}

TEST_CASE("a path in the mission counts over the record, whichever stands first") {
  Mission mission;
  mission.replace("wind_ned: [3, -4, 0]", "airframe.mass: 6 kg, airframe: anaconda.yaml");
  CHECK(record_of<Airframe>(mission.load(), "sim", "airframe").mass_kg == 6);
  CHECK(record_of<Airframe>(mission.load(set("sim.airframe.mass", "7 kg")), "sim", "airframe").mass_kg == 7);
}

TEST_CASE("a path that leads nowhere is told with the valid fields") {
  Mission mission;
  const auto told = [&](const std::string& name, const std::string& value) {
    return mission.faults(set(name, value));
  };
  CHECK(told("sim.airframe.mas", "5 kg")
            .find("sim.airframe: unknown field 'mas' of Airframe. Did you mean "
                  "'mass'?") != std::string::npos);
  CHECK(told("sim.airframe.mass", "5").find("sim.airframe.mass: ") != std::string::npos);
  CHECK(told("sim.airframe.mass", "5 m").find("sim.airframe.mass: ") != std::string::npos);
  CHECK(told("sim.airframe.mass.x", "5").find("sim.airframe.mass: has no parts") != std::string::npos);
  CHECK(told("sim.airframe.mass[0]", "5").find("'mass_kg' is no list") != std::string::npos);
  CHECK(told("sim.wind_ned.north", "5").find("has no parameter 'wind_ned.north'") != std::string::npos);
}

TEST_CASE("a path into a list counts its items from 0") {
  Mission mission;
  const Graph graph = mission.load(set("plan.plan.waypoints[1].airspeed", "18 m/s"));
  const auto plan = record_of<Plan>(graph, "plan", "plan");
  CHECK(plan.waypoints[1].airspeed_mps == 18);
  CHECK(plan.waypoints[0].airspeed_mps != 18);
  CHECK(mission.faults(set("plan.plan.waypoints[9].airspeed", "18 m/s")).find("counted from [0]") !=
        std::string::npos);
  CHECK(mission.faults(set("plan.plan.waypoints[x].airspeed", "9 m/s")).find("'[x]' is no place in a list") !=
        std::string::npos);
  CHECK(
      mission.faults(set("plan.plan.waypoints.airspeed", "9 m/s")).find("is a list; name one of its items") !=
      std::string::npos);
}

TEST_CASE("who goes on listening to a manager that was replaced is warned of") {
  Layered mission(
      "extends: ground.yaml\nroles: {guide: {in: {path: mine_too.path}}}\ncomponents:\n"
      "  mine_too: {use: path/Manager, in: {state: nav.state, plan: plan.plan}}\n");
  const std::string why = "manage, which does not steer: follow.path comes from mine_too.path";
  CHECK(mission.load().warnings == std::vector<std::string>{"ground.yaml:32: score.path comes from " + why,
                                                            "ground.yaml:8: done looks at " + why,
                                                            "ground.yaml:9: progress shows " + why});
  mission.text +=
      "  score: {in: {path: mine_too.path}}\ndone: \"mine_too.progress.circuits >= 2\"\nprogress: null\n";
  CHECK(mission.load().warnings.empty());  // the former one flies along, and nobody listens
  Mission usual;
  CHECK(usual.load().warnings.empty());
}

TEST_CASE("a field alone is no record: what was never given stays missing") {
  Mission mission;
  mission.replace("airframe: anaconda.yaml\n", "");
  CHECK(mission.faults(set("sim.airframe.mass", "5 kg")).find("the parameter 'airframe' is missing") !=
        std::string::npos);
}

TEST_CASE("an airframe file with gains is an airframe wherever one is wanted") {
  Mission mission;
  const Graph graph = mission.load(set("sim.airframe", mission.folder.path / "anaconda.yaml"));
  CHECK(record_of<Airframe>(graph, "sim", "airframe").mass_kg == 4.5);
  CHECK(param(graph, "attitude", "roll_kp").number[0] == 0.7);
}

TEST_CASE("the command line records more, in front of what the mission records") {
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
        "--record nav.stat: record.ports: 'nav.stat' matches no port. Did you mean 'nav.state'?");
  o.record = {"nav.state@often"};
  CHECK(mission.faults(o).find("--record nav.state@often: ") == 0);
  o.record = {"nav.state@0 Hz"};
  CHECK(mission.faults(o).find("a rate is from 0.001 to 1e6 Hz") != std::string::npos);
  o.record = {"@5"};
  CHECK(mission.faults(o) == "--record @5: record.ports: '' matches no port.");
}

TEST_CASE("the command line arms, or leaves that to somebody") {
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
