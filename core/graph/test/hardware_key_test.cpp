// SPDX-License-Identifier: BSD-3-Clause
// Missions for hardware, and reads of ports that only a simulator has.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "core/graph/mission.hpp"
#include "core/graph/shipped.hpp"
#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"

namespace hardware_key_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

/// Of a vehicle with a switch in its landing gear.
struct Wheels {
  bool on_ground = false;
};

namespace {

Overrides on(const std::string& io) {
  Overrides o;
  o.io = io;
  return o;
}

std::string keyed(const std::string& key, const Overrides& o) {
  Mission mission;
  mission.replace("seed: 7", "hardware: " + key);
  return mission.faults(o);
}

/// Warnings of the hourglass mission about simulation only, with `from` replaced by `to`.
std::vector<std::string> warned(const std::string& from, const std::string& to,
                                const std::string& io = "sim") {
  Mission mission;
  std::vector<std::string> list = mission.replace(from, to).load(on(io)).source.warnings;
  std::erase_if(list, [](const std::string& w) {
    return w.find("graph.simulated_") == std::string::npos &&
           w.find("graph.contact_not_measured(") == std::string::npos;
  });
  return list;
}

}  // namespace

TEST_CASE("a mission that is not for hardware is rejected there with its reason and its line") {
  const std::string no = "{fit: no, because: \"its phases fly by the true state\"}";
  CHECK(keyed(no, on("sim")) == "");
  CHECK(keyed(no, on("fcu")) ==
        "hourglass.yaml:6: graph.hardware_not_allowed(its phases fly by the true state)");
  CHECK(keyed("yes", on("fcu")) == "");
  CHECK(keyed("{fit: yes}", on("fcu")) == "");
  CHECK(Mission().faults(on("fcu")) == "");  // a mission without the key is allowed
}

TEST_CASE("a mission may need a role or a component that the command line chooses") {
  const std::string with = "{with: outer, because: \"no law of it has flown\"}";
  CHECK(keyed(with, on("sim")) == "");
  CHECK(keyed(with, on("fcu")) ==
        "hourglass.yaml:6: graph.hardware_component_missing(outer, no law of it has flown, slc, tecs, mine)");
  CHECK(keyed("{with: tecs, because: \"it has not flown\"}", on("fcu")) ==
        "hourglass.yaml:6: graph.hardware_plugin_missing(tecs, it has not flown)");
  Overrides chosen = on("fcu");
  chosen.roles = {{"outer", "tecs"}};
  CHECK(keyed(with, chosen) == "");
  chosen.roles = {{"guide", "follow"}};
  CHECK(keyed(with, chosen) != "");
}

TEST_CASE("the section hardware is checked in simulation too") {
  for (const char* io : {"sim", "fcu"}) {
    CHECK(keyed("perhaps", on(io)).find("hourglass.yaml:6: graph.hardware_value_invalid('perhaps')") == 0);
    CHECK(keyed("no", on(io)).find("hourglass.yaml:6: graph.hardware_value_invalid('no')") == 0);
    CHECK(keyed("{fit: no}", on(io)).find("hourglass.yaml:6: graph.hardware_reason_missing") == 0);
    CHECK(keyed("{with: outer}", on(io)).find("hourglass.yaml:6: graph.hardware_reason_missing") == 0);
    CHECK(
        keyed("{fits: no}", on(io)).find("graph.key_unknown(hardware: , fits,  [fit] fit, with, because)") !=
        std::string::npos);
    CHECK(keyed("[yes]", on(io))
              .find("hourglass.yaml:6: graph.map_expected(hardware: , fit, with, because, a list)") == 0);
  }
}

TEST_CASE("the key is inherited, and a layer replaces it as a whole") {
  Mission mission;
  mission.folder.write("base.yaml", std::string(hourglass) + "hardware: {fit: no, because: \"it is not\"}\n");
  mission.text = "extends: base.yaml\n";
  CHECK(mission.faults(on("fcu")).find("it is not") != std::string::npos);
  mission.text = "extends: base.yaml\nhardware: yes\n";
  CHECK(mission.faults(on("fcu")) == "");
}

TEST_CASE("a condition that reads ground contact, a crash or the true state is reported") {
  const std::string when = "\"nav.state.height_m > 30 m\"";
  CHECK(warned(when, when).empty());
  CHECK(warned(when, "\"vehicle.status.armed\"").empty());
  const auto contact = warned(when, "\"nav.state.height_m > 3 m and not vehicle.status.on_ground\"");
  REQUIRE(contact.size() == 1);
  CHECK(contact[0] ==
        "hourglass.yaml:37: graph.contact_not_measured(phases.takeoff.next: vehicle.status, on_ground, "
        "vehicle.status)");
  CHECK(warned(when, "\"vehicle.status.crashed\"").size() == 1);
  CHECK(warned(when, "\"sim.status.crashed\"").size() == 1);
  Mission refused;
  CHECK(refused.replace(when, "\"vehicle.status.crashed\"")
            .faults(on("fcu"))
            .find("hourglass.yaml:37: graph.contact_not_measured(phases.takeoff.next: vehicle.status, "
                  "crashed, ") == 0);
  const auto truth = warned(when, "\"vehicle.truth.height_m > 30 m\"");
  REQUIRE(truth.size() == 1);
  CHECK(truth[0] == "hourglass.yaml:37: graph.simulated_output(phases.takeoff.next: vehicle.truth)");
  CHECK(warned("\"vehicle.status.override\"", "\"vehicle.status.on_ground\"").size() == 1);  // of `any`
}

TEST_CASE("a vehicle that measures contact, or a condition on contact_known, is not reported") {
  const std::string when = "\"nav.state.height_m > 30 m\"";
  CHECK(warned(when, "\"vehicle.status.contact_known and not vehicle.status.on_ground\"").empty());
  CHECK(warned(when, "\"sim.status.contact_known and vehicle.status.on_ground\"").size() == 1);
  for (const char* io : {"sim", "fcu"}) {
    Mission mission;  // a message without contact_known has a switch, for any name of the field
    for (const char* plugin : {"sim_aero", "fcu_serial"})
      mission.shelf.plugins[plugin]->components[0].outputs.push_back(out<Wheels>("wheels"));
    mission.replace("status: VehicleStatus", "wheels: Wheels, status: VehicleStatus")
        .replace(when, "\"not vehicle.wheels.on_ground\"");
    CHECK(mission.faults(on(io)) == "");
    CHECK(mission.load(on(io)).source.warnings.empty());
  }
}

TEST_CASE("a verdict may read what only the simulator has") {
  CHECK(warned("seed: 7", "failed: \"vehicle.status.crashed\"").empty());
  CHECK(warned("\"manage.progress.circuits >= 2\"", "\"vehicle.status.on_ground\"").empty());
}

TEST_CASE("a component that steers by the true state is reported, one that only measures is not") {
  const std::string manage = "use: path/Manager, in: {state: nav.state,";
  const auto list = warned(manage, "use: path/Manager, in: {state: vehicle.truth,");
  REQUIRE(list.size() == 1);
  CHECK(list[0] == "hourglass.yaml:26: graph.simulated_input(manage, state, truth)");
  const std::string simulated = "use: path/Manager, in: {state: sim.truth,";
  CHECK(warned(manage, simulated).size() == 1);
  const std::string measures = "only: sim}\n  second: {use: sim_aero/TruthState, in: {truth: vehicle.truth}}";
  CHECK(warned("only: sim}", measures).empty());
  // a component that only measures takes part in a decision when a phase reads it
  const auto decided = warned("\"nav.state.height_m > 30 m\"", "\"score.tracking.circuits > 1\"");
  REQUIRE(decided.size() == 1);
  CHECK(decided[0].find("graph.simulated_input(score, truth, truth)") != std::string::npos);
  Mission open;  // an optional input without a source on hardware
  CHECK(open.replace("\"nav.state.height_m > 30 m\"", "\"score.tracking.circuits > 1\"")
            .faults(on("fcu"))
            .find("graph.simulated_input(score, truth, truth)") != std::string::npos);
  // a component of the simulation alone is declared as such
  Mission mission;
  Overrides o = on("sim");
  o.roles = {{"nav", "truth"}};
  const std::vector<std::string> truth = mission.load(o).source.warnings;
  CHECK(std::none_of(truth.begin(), truth.end(),
                     [](const std::string& w) { return w.find("graph.simulated_") != std::string::npos; }));
}

TEST_CASE("a mission for simulation only, or without another vehicle, gets no warning") {
  const std::string crashed = "\"vehicle.status.crashed\"", when = "\"nav.state.height_m > 30 m\"";
  Mission mission;
  mission.replace(when, crashed).replace("seed: 7", "hardware: {fit: no, because: \"it is a toy\"}");
  CHECK(mission.load().source.warnings.empty());
  Mission alone;
  alone.replace(when, crashed)
      .replace("  fcu:    {fills: vehicle, use: fcu_serial, params: {port: /dev/ttyACM0}}\n", "");
  CHECK(alone.load().source.warnings.empty());
}

TEST_CASE("each shipped mission states whether it is for hardware") {
  const fs::path folder = named_file("", "fulmar:missions/common.yaml").parent_path();
  int missions = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    Report report;
    Overrides overrides;
    const MissionText text = parse_mission(entry.path().string(), overrides, report);
    const Node own = parse_yaml(text.file, report);
    if (!own.find("mission")) continue;
    ++missions;
    CHECK_MESSAGE(own.find("hardware"), entry.path().filename().string());
    CHECK_MESSAGE(report.empty(), report.text());
  }
  CHECK(missions > 15);
}

}  // namespace hardware_key_test
