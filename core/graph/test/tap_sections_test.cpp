// SPDX-License-Identifier: BSD-3-Clause
// The sections `live:` and `dds:`: their values, and the messages for faults in them.
#include <doctest/doctest.h>

#include "core/graph/live_options.hpp"
#include "core/graph/test/shelf.hpp"

namespace tap_sections_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// The hourglass mission with one more line, its sixth.
std::string faults(const std::string& line) {
  Mission mission;
  return mission.replace("seed: 7", line).faults();
}

bool holds(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a flight has a live view at the mission's address, and none by default") {
  Mission silent;
  CHECK_FALSE(silent.load().live.on);
  Mission mission;
  const Graph g = mission.replace("seed: 7", "live: {listen: \"[::1]:9000\", token: a}").load();
  CHECK(g.live.on);
  CHECK(g.live.host == "::1");
  CHECK(g.live.port == 9000);
  CHECK(g.live.token == "a");
  CHECK_FALSE(g.live.save);
  Mission usual;
  const Graph h = usual.replace("seed: 7", "live: {}").load();
  CHECK(h.live.on);
  CHECK(h.live.host == "127.0.0.1");
  CHECK(h.live.port == 8765);
  Mission off;
  CHECK_FALSE(off.replace("seed: 7", "live: off").load().live.on);
  CHECK(parse_live("8080").port == 8080);
  CHECK_FALSE(parse_live("off").on);
  CHECK_THROWS_AS(parse_live("here"), Error);
}

TEST_CASE("a fault in live: is reported with its line and the valid form") {
  CHECK(faults("live: on") ==
        "hourglass.yaml:6: live: graph.value_not_valid('off' or a map {listen, token, tiles, attribution, "
        "save}, 'on')");
  for (const char* address : {"here", "127.0.0.1:99999", "127.0.0.1:", ":80", "1.5", "300.1.1.1:80",
                              "ground-station:80", "[::x]:80"}) {
    CAPTURE(address);
    holds(faults("live: {listen: \"" + std::string(address) + "\"}"),
          "6: graph.live_address_invalid(" + std::string(address) + ")");
  }
  holds(faults("live: {save: perhaps}"), "6: live.save: graph.flag_expected('perhaps')");
  Mission off;
  CHECK(off.replace("seed: 7", "live: {save: off}").load().live.save == false);
  holds(faults("live: {port: 1}"),
        "6: graph.key_unknown(live: , port,  [] listen, token, tiles, attribution, save)");
}

TEST_CASE("the address of tiles is unambiguous in a header and in a pattern") {
  const auto printed = [](const std::string& url) {
    return faults("live: {tiles: \"" + url + "\", attribution: Example}");
  };
  for (const char* url : {"https://tile.example.org/{z}/{x}/{y}.png", "http://127.0.0.1:8080/{x}-{y}-{z}",
                          "https://a.b/{z}/{x}/{y}@2x.jpg?key=abc&v=1"}) {
    CAPTURE(url);
    CHECK(printed(url) == "");
  }
  for (const char* url : {"https://tile.example.org/{z}/{x}.png",
                          "https://tile.example.org/{z}/{x}/{y}/{z}",
                          "https://{s}.example.org/{z}/{x}/{y}",
                          "https://tile.example.org/{s}/{z}/{x}/{y}",
                          "ftp://tile.example.org/{z}/{x}/{y}",
                          "//tile.example.org/{z}/{x}/{y}",
                          "tile.example.org/{z}/{x}/{y}",
                          "https:///{z}/{x}/{y}",
                          "https://me:secret@tile.example.org/{z}/{x}/{y}",
                          "https://a.b:0/{z}/{x}/{y}",
                          "https://a.b:99999/{z}/{x}/{y}",
                          "https://a.b:/{z}/{x}/{y}",
                          "https://a.b;script-src *;/{z}/{x}/{y}",
                          "https://a.b/{z}/{x}/{y};script-src *",
                          "https://a.b/{z}/{x}/{y}'",
                          "https://a.b/{z}/{x}/{y}, x",
                          "https://a.b /{z}/{x}/{y}",
                          "https://a.b/{z}/{x}/{y}\\n",
                          "https://*.b/{z}/{x}/{y}",
                          "",
                          "https://[::1]:80/{z}/{x}/{y}",
                          "https://a.b#/{z}/{x}/{y}"}) {
    CAPTURE(url);
    holds(printed(url), "hourglass.yaml:6: graph.live_tiles_invalid(" +
                            std::string(url).substr(0, std::string(url).find('\\')));
  }
  holds(faults("live: {attribution: Example}"), "6: graph.live_tiles_missing");
  Mission mission;
  const Graph g =
      mission.replace("seed: 7", "live: {tiles: \"https://a.b/{z}/{x}/{y}\", attribution: Example}").load();
  CHECK(g.live.tiles == "https://a.b/{z}/{x}/{y}");
  CHECK(g.live.attribution == "Example");
  CHECK(origin_of(g.live.tiles) == "https://a.b");
}

TEST_CASE("ports are exported under ROS 2 names, inputs without a wire are fed by topics") {
  Mission mission;
  mission.replace("seed: 7",
                  "dds: {domain: 7, namespace: uav1, export: [nav.state, {port: follow.command, topic: /cmd, "
                  "rate: 50 Hz, "
                  "best_effort: true}], import: {plan.edits: /fulmar/plan_edits}}");
  mission.replace("follow: {fills: guide, use: path/VectorField, rate: 100 Hz}",
                  "follow: {fills: guide, use: path/VectorField}");
  const std::string text = mission.faults();
  holds(text,
        "6: graph.dds_port_unknown(follow.command,  [] vehicle.imu, vehicle.gnss, vehicle.mag, vehicle.baro, "
        "vehicle.pitot, vehicle.rc, vehicle.status, vehicle.truth, nav.state, guide.command, outer.attitude, "
        "inner.actuators, plan.plan, manage.path, manage.progress, attitude.probes, score.tracking, "
        "score.estimation)");  // its name is that of the role
  Mission good;
  const Graph g =
      good.replace("seed: 7",
                   "dds: {domain: 7, namespace: uav1, export: [nav.state, {port: guide.command, topic: /cmd, "
                   "rate: 50 Hz, best_effort: true}], import: {plan.edits: /fulmar/plan_edits}}")
          .load();
  CHECK(g.dds.on);
  CHECK(g.dds.where.line == 6);
  CHECK(g.dds.domain == 7);
  CHECK(g.dds.name_space == "uav1");
  REQUIRE(g.dds.exports.size() == 2);
  CHECK(g.dds.exports[0].topic == "nav/state");
  CHECK(g.dds.exports[1].topic == "/cmd");
  CHECK(g.dds.exports[1].period_ns == 20'000'000);
  CHECK(g.dds.exports[1].best_effort);
  REQUIRE(g.dds.imports.size() == 1);
  const Component& plan = g.components[static_cast<std::size_t>(g.dds.imports[0].component)];
  CHECK(plan.name == "plan");
  CHECK(plan.info().inputs[static_cast<std::size_t>(g.dds.imports[0].input)].name == "edits");
  CHECK(plan.wires[static_cast<std::size_t>(g.dds.imports[0].input)].import == 0);
}

TEST_CASE(
    "what is imported counts as fed, and an input of a component that this run does not have is passed "
    "over") {
  Mission mission;
  mission.replace("  plan:   {use: path/Planner",
                  "  other:  {use: path/VectorField, in: {path: manage.path}}\n  plan:   {use: path/Planner");
  holds(mission.faults(), "graph.input_not_connected(components.other: the input 'state' , ");
  mission.replace("seed: 7", "dds: {import: {other.state: /uav0/nav/state}}");
  CHECK(mission.faults() == "");
  Mission with_other_io;
  const Graph g = with_other_io.replace("seed: 7", "dds: {import: {fcu.actuators: /x}}").load();
  CHECK(g.dds.imports.empty());
}

TEST_CASE("an import replaces a wire of the extended file") {
  Mission mission;
  mission.folder.write("base.yaml", hourglass);
  mission.text = "mission: far\nextends: base.yaml\ndds: {import: {manage.plan: /laptop/plan}}\n";
  const Graph g = mission.load();
  REQUIRE(g.dds.imports.size() == 1);
  const Component& manage = g.components[static_cast<std::size_t>(g.dds.imports[0].component)];
  CHECK(manage.name == "manage");
  CHECK(manage.wires[static_cast<std::size_t>(g.dds.imports[0].input)].from.kind == Source::Kind::none);
  mission.text += "components: {manage: {in: {plan: plan.plan}}}\n";
  holds(mission.faults(), "graph.imported_input_connected(hourglass.yaml:4)");
}

TEST_CASE("a fault in dds: is reported with its line and the valid form") {
  holds(faults("dds: {domain: 233}"), "6: graph.dds_domain_invalid(233, 232)");
  holds(faults("dds: {domain: 1.5}"), "6: graph.dds_domain_invalid(1.5, 232)");
  holds(faults("dds: {domain: 1e300}"), "6: graph.dds_domain_invalid(1e+300, 232)");
  holds(faults("dds: {export: [{port: nav.state, rate: 1e-300 Hz}]}"), "6: graph.dds_rate_too_low(1e-300)");
  holds(faults("dds: {namespace: /uav1}"), "6: graph.dds_namespace_invalid(/uav1)");
  holds(faults("dds: {interfaces: lo}"),
        "6: dds.interfaces: graph.value_not_valid(a list of addresses such as [192.168.1.7], 'lo')");
  holds(faults("dds: {interfaces: [lo]}"), "6: graph.dds_address_invalid(interfaces, lo)");
  holds(faults("dds: {peers: [127.0.0.1, foo]}"), "6: graph.dds_address_invalid(peers, foo)");
  holds(faults("dds: {namespace: a, export: [{port: nav.state, topic: x}], import: {plan.edits: /a/x}}"),
        "6: dds.export: nav.state: graph.dds_type_differs(/a/x, PlanEdit, hourglass.yaml:6, VehicleState)");
  holds(faults("dds: on"), "6: dds: graph.value_not_valid('off' or a map {export, import}, 'on')");
  holds(faults("dds: {export: nav.state}"),
        "6: dds.export: graph.value_not_valid(a list of ports such as [nav.state], 'nav.state')");
  holds(faults("dds: {export: [nav.stat]}"), "graph.dds_port_unknown(nav.stat,  [nav.state] ");
  holds(faults("dds: {export: [{topic: /x}]}"), "6: graph.dds_port_missing");
  holds(faults("dds: {export: [{port: nav.state, topic: \"a b\"}]}"),
        "6: dds.export: graph.dds_topic_invalid(a b)");
  holds(faults("dds: {export: [{port: nav.state, topic: /x}, {port: manage.path, topic: /x}]}"),
        "6: graph.dds_topic_repeated(/x)");
  holds(faults("dds: {import: [plan.edits]}"),
        "6: dds.import: graph.value_not_valid(a map {component.input: /topic}, a list)");
  holds(faults("dds: {import: {plan.edis: /x}}"),
        "6: dds.import.plan.edis: graph.imported_input_unknown(path/Planner,  [edits] state, edits, edit)");
  holds(faults("dds: {import: {plan.edit: /x}}"), "graph.imported_input_invalid");
  holds(faults("dds: {import: {plant.edits: /x}}"),
        "types.name_unknown(component, plant,  [plan] sim, ekf, truth, plan, manage, follow, slc, tecs, "
        "attitude, mine, score)");
  holds(faults("dds: {import: {manage.state: /x}}"), "graph.imported_input_connected(hourglass.yaml:26)");
  holds(faults("dds: {exports: []}"),
        "6: graph.key_unknown(dds: , exports,  [export] domain, namespace, interfaces, peers, export, "
        "import, services, parameters, humble)");
}

TEST_CASE(
    "a topic that is exported and imported with one type is in order, and so is one name in two namespaces") {
  for (const char* import :
       {"{namespace: a, export: [{port: plan.plan, topic: x}], import: {plan.edits: x2}}",
        "{namespace: a, export: [{port: nav.state, topic: x}], import: {plan.edits: /x}}"}) {
    CAPTURE(import);
    CHECK(faults("dds: " + std::string(import)) == "");
  }
}

TEST_CASE("a mission removes the dds section of the file that it extends") {
  Mission mission;
  mission.folder.write(
      "base.yaml", mission.replace("seed: 7", "dds: {export: [nav.state], import: {plan.edits: /x}}").text);
  CHECK(mission.load().dds.on);
  mission.text = "mission: alone\nextends: base.yaml\ndds: off\n";
  const Graph g = mission.load();
  CHECK_FALSE(g.dds.on);
  CHECK(g.dds.exports.empty());
  CHECK(g.dds.imports.empty());
}

TEST_CASE("a log is one file: a mission with more names has an unknown key") {
  holds(faults("record: {rotate: 100 MB}"),
        "6: graph.key_unknown(record: , rotate,  [rate] file, ports, rate)");
}

}  // namespace tap_sections_test
