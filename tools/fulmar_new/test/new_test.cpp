// SPDX-License-Identifier: BSD-3-Clause
// `fulmar new`: its reading of a mission, its output, its rejections. installed.sh builds and flies the
// projects.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "tools/fulmar_new/new_contract.hpp"
#include "tools/fulmar_new/new_mission.hpp"
#include "tools/fulmar_new/new_places.hpp"
#include "tools/fulmar_new/new_source.hpp"

namespace fs = std::filesystem;
using namespace fulmar::core;

namespace {

const fs::path program = FULMAR_BIN_DIR "/fulmar";
const fs::path missions = FULMAR_SOURCE_DIR "/configs/missions";

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-new-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};
const fs::path& folder() {
  static Folder f;
  return f.path;
}

struct Result {
  int code;
  std::string words;
};
Result call(const std::string& arguments) {
  const std::string command =
      "cd " + folder().string() + " && " + program.string() + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string words;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) words.append(buffer, n);
  return {WEXITSTATUS(pclose(pipe)), words};
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

fs::path file_with(const std::string& name, const std::string& text) {
  std::ofstream(folder() / name) << text;
  return folder() / name;
}

/// The host loads what `new` wrote, with a stand-in for the plugin that is not built: the fallback flies.
Graph loaded(const fs::path& mission, const std::string& plugin, const std::string& stand_in) {
  const std::string line = "use: build/lib/fulmar/" + plugin + ".so";
  std::string text = text_of(mission);
  const std::size_t at = text.find(line);
  REQUIRE(at != std::string::npos);
  return load_mission(file_with("stand_in.yaml", text.replace(at, line.size(), "use: " + stand_in)).string());
}

}  // namespace

TEST_CASE("the contract of a role is what the mission says of it") {
  const MissionView mission = view_mission(missions / "hourglass.yaml");
  const Contract outer = read_contract(mission, {"outer"});
  REQUIRE(outer.inputs.size() == 2);
  CHECK(outer.inputs[1].name == "command");
  CHECK(outer.inputs[1].type->name == "GuidanceCommand");
  CHECK(outer.inputs[1].from.text() == "guide.command");
  REQUIRE(outer.outputs.size() == 1);
  CHECK(outer.outputs[0].type_name == "AttitudeCommand");
  CHECK(outer.phase == "cruise");
  CHECK(outer.shipped_words() == "slc");
  const Contract vehicle = read_contract(mission, {"vehicle"});
  CHECK(vehicle.inputs.back().kind == FULMAR_IN_REQUEST);  // arm
  CHECK(vehicle.outputs.back().optional);                  // truth
  CHECK_THROWS_WITH_AS(read_contract(mission, {"gude"}),
                       "new.role_unknown(gude, hourglass.yaml,  [guide] vehicle, nav, guide, outer, inner)",
                       Error);
}

TEST_CASE("the project of a shipped role is complete, and its mission names the shipped law as fallback") {
  const Result made = call("new my_law --role outer");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  for (const char* file : {"my_law.hpp", "my_law.cpp", "my_law_test.cpp", "mission.yaml", "README.md",
                           "CMakeLists.txt", "CMakePresets.json", ".clang-format", ".gitignore"})
    CHECK_MESSAGE(fs::is_regular_file(folder() / "my_law" / file), file);
  CHECK(holds(text_of(folder() / "my_law" / "my_law.hpp"), "In<GuidanceCommand> command;"));
  CHECK_FALSE(holds(text_of(folder() / "my_law" / "my_law.hpp"), "// ports"));
  CHECK_FALSE(holds(text_of(folder() / "my_law" / "README.md"), "@"));
  CHECK_FALSE(holds(text_of(folder() / "my_law" / "CMakePresets.json"), "@"));
  const Graph graph = loaded(folder() / "my_law" / "mission.yaml", "my_law", "control_tecs/Outer");
  std::size_t outer = 0;
  while (graph.roles.at(outer).name != "outer") ++outer;
  const Assignment& cruise = graph.phases.back().roles[outer];
  CHECK(graph.components[static_cast<std::size_t>(cruise.component)].name == "my_law");
  CHECK(graph.components[static_cast<std::size_t>(cruise.fallback)].name == "slc");
  CHECK(graph.components[static_cast<std::size_t>(cruise.component)].period_ns == 10'000'000);
}

TEST_CASE("what takes the vehicle's role has it for itself") {
  REQUIRE(call("new glider --role vehicle").code == 0);
  const Graph graph = loaded(folder() / "glider" / "mission.yaml", "glider", "sim_aero/Aircraft");
  CHECK(graph.components[static_cast<std::size_t>(graph.vehicle)].name == "glider");
}

TEST_CASE(
    "a role of somebody's own mission gets a body that passes on what was there, and messages that the SDK "
    "lacks") {
  const std::string common = (missions / "common.yaml").string();
  file_with("own.yaml",
            "mission: own\nextends: " + common +
                "\nairframe: " FULMAR_SOURCE_DIR
                "/configs/airframes/anaconda.yaml\n"
                "roles:\n  judge: {in: {state: nav.state, command: guide.command}, out: {figures: Figures}}\n"
                "components:\n  referee: {fills: judge, use: score/Score, rate: 50 Hz, params: "
                "{start_height: 30 m}}\n"
                "  plan: {params: {plan: " FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}\n");
  const Result made = call("new my_judge --role judge --mission own.yaml --dir deep/er");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  const std::string header = text_of(folder() / "deep/er/my_judge.hpp"),
                    written = text_of(folder() / "deep/er/mission.yaml");
  CHECK(holds(header, "fulmar/msg/guidance_command.hpp>\n"));
  CHECK(holds(header, "struct Figures {"));
  CHECK(holds(header, "Out<messages::Figures> figures;"));
  for (const char* line :
       {"reference: {use: score/Score, rate: 50 Hz, in: {state: nav.state, command: guide.command}, "
        "params: {start_height: 30 m}}",
        "in: {reference_figures: reference.figures}"})
    CHECK_MESSAGE(holds(written, line), line);
}

TEST_CASE("an input that the mission's role brings beside those of the template is in what is written") {
  const fs::path mission = folder() / "winds.yaml";
  std::ofstream(mission)
      << "extends: " << (missions / "hourglass.yaml").string()
      << "\nroles: {guide: {in: {state: nav.state, path: manage.path, gauge: vehicle.baro}}}\n";
  const Result made = call("new windy --role guide --mission winds.yaml");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  CHECK(holds(text_of(folder() / "windy/windy.hpp"), "<Baro> gauge;"));
}

TEST_CASE("file names of the given mission are still found from the new one") {
  fs::create_directories(folder() / "beside");
  fs::copy_file(missions / "common.yaml", folder() / "beside/common.yaml");
  fs::copy_file(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml", folder() / "beside/air.yaml");
  fs::copy_file(FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml", folder() / "beside/plan one.yaml");
  fs::copy_file(FULMAR_PLUGIN_DIR "/control_tecs.so", folder() / "beside/home.so");
  std::ofstream(folder() / "beside/m.yaml")
      << "extends: common.yaml\nairframe: air.yaml\ncomponents:\n  plan: {params: {plan: \"plan "
         "one.yaml\"}}\n"
         "  slc: {use: home.so/Outer}\nphases:\n  takeoff: {outer: tecs}\n";
  const Result made = call("new far --role inner --mission beside/m.yaml --dir 'a b'");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  const Graph graph = loaded(folder() / "a b/mission.yaml", "far", "control_slc/Inner");
  CHECK(graph.airframe == (folder() / "beside/air.yaml").string());
  for (const Component& component : graph.components)
    if (component.name == "slc") CHECK(component.plugin->path == (folder() / "beside/home.so").string());
}

TEST_CASE("the C++ struct of a message says what its field table says") {
  auto inner = std::make_shared<Type>();
  inner->name = "Point";
  inner->fields = {{.name = "at_m", .unit = "m", .type = nullptr, .labels = {}, .kind = FULMAR_F32}};
  Type type;
  type.name = "Track";
  Field mode{.name = "mode", .unit = "", .type = nullptr, .labels = {"off", "on"}, .kind = FULMAR_ENUM};
  Field points{
      .name = "points", .unit = "", .type = inner, .labels = {}, .kind = FULMAR_STRUCT, .shape = FULMAR_LIST};
  points.count = 8;
  Field name{.name = "title", .unit = "", .type = nullptr, .labels = {}, .kind = FULMAR_TEXT};
  name.stride = 24;
  type.fields = {mode, points, name};
  const std::string source =
      "struct Point {\n  float at_m{};\n};\n\nenum class TrackMode : std::uint8_t { off, on };\nstruct "
      "Track {\n  TrackMode mode{};\n"
      "  List<Point, 8> points;\n  Text<24> title;\n};\n\n";
  CHECK(message_source(type) == source);
}

TEST_CASE("a component without a role has the ports that are asked for, wired, and its own message") {
  const Result made = call(
      "new ranger --in state=nav.state --in truth?=vehicle.truth --in \"notices=vehicle.notices[]\" --out "
      "range=Distance --out edits=PlanEdit[] --out score=Figures");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  CHECK(holds(made.words, "new.component_beside_roles(ranger, hourglass, ranger)"));
  const std::string header = text_of(folder() / "ranger/ranger.hpp"),
                    written = text_of(folder() / "ranger/mission.yaml");
  for (const char* line :
       {"In<VehicleState> state;", "Optional<VehicleState> truth;", "Queue<Notice> notices;",
        "Out<messages::Distance> range;", "OutQueue<PlanEdit, 16> edits;", "Out<messages::Figures> score;",
        "fulmar/msg/plan_edit.hpp>", "struct Distance {"})
    CHECK_MESSAGE(holds(header, line), line);
  const std::string component =
      "ranger: {use: build/lib/fulmar/ranger.so, rate: 100 Hz, in: {state: nav.state, truth: "
      "vehicle.truth, notices: vehicle.notices}}";
  CHECK(holds(written, component));
  CHECK_FALSE(holds(written, "fills"));
  CHECK_FALSE(holds(text_of(folder() / "ranger/README.md"), "@"));
}

TEST_CASE("a vehicle is a frame to be filled in, or a point mass that flies") {
  REQUIRE(call("new frame --role vehicle").code == 0);
  const std::string header = text_of(folder() / "frame/frame.hpp");
  CHECK(holds(header, "  // 4. Surface commands"));
  CHECK_FALSE(holds(header, "point mass"));
  const std::string from_template = " --role vehicle --template ";
  REQUIRE(call("new toy" + from_template + "point_mass").code == 0);
  CHECK(holds(text_of(folder() / "toy/toy.hpp"), "// A point mass"));
  CHECK(holds(call("new toy2" + from_template + "mass").words,
              "new.role_template_unknown(mass, vehicle,  Valid: point_mass.)"));
  CHECK(holds(call("new toy2 --role outer --role inner --template point_mass").words,
              "new.roles_template_missing(point_mass, outer, inner)"));
  CHECK(holds(call("new toy2 --mission sensor_log" + from_template + "point_mass").words,
              "new.template_ports_mismatch(point_mass, vehicle, sensor_log, recording Recording, actuators "
              "Actuators, arm ArmRequest)"));
}

TEST_CASE("templates for a sensor and a planner are wired to what the mission has") {
  REQUIRE(call("new altimeter --template sensor").code == 0);
  const std::string component =
      "altimeter: {use: build/lib/fulmar/altimeter.so, rate: 20 Hz, in: {state: vehicle.truth}}";
  CHECK(holds(text_of(folder() / "altimeter/mission.yaml"), component));
  CHECK(holds(text_of(folder() / "altimeter/altimeter.hpp"), "OutQueue<AltimeterRange, 4> range;"));
  CHECK_FALSE(holds(text_of(folder() / "altimeter/altimeter.hpp"), "// wired"));
  const Result blind = call("new blind --template sensor --in state=nav.state");
  REQUIRE_MESSAGE(blind.code == 0, blind.words);
  CHECK(holds(text_of(folder() / "blind/mission.yaml"), "in: {state: nav.state}"));
  const Result made = call("new search --template planner");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  CHECK(holds(made.words, "to plan.edits"));
  const std::string written = text_of(folder() / "search/mission.yaml");
  for (const char* line :
       {"edits: {from: search.edits, delayed: true}",
        "rate: 10 Hz, in: {progress: manage.progress, state: nav.state, results: plan.results}"})
    CHECK_MESSAGE(holds(written, line), line);
}

TEST_CASE(
    "several roles are filled at once, each with its own fallback, and passed on until there is a law") {
  const Result made = call("new lqr --role outer --role inner");
  REQUIRE_MESSAGE(made.code == 0, made.words);
  const std::string header = text_of(folder() / "lqr/lqr.hpp"),
                    written = text_of(folder() / "lqr/mission.yaml");
  for (const char* line :
       {"lqr: {fills: [outer, inner], use: build/lib/fulmar/lqr.so, rate: 100 Hz",
        "cruise: {outer: {use: lqr, fallback: slc}, inner: {use: lqr, fallback: attitude}}",
        "attitude: reference_outer.attitude"})
    CHECK_MESSAGE(holds(written, line), line);
  CHECK(holds(header, "In<GuidanceCommand> command;"));
  CHECK(holds(header, "roles `outer` and `inner`\n"));
  CHECK_FALSE(holds(header, "AttitudeCommand> attitude;"));  // its own output is no input
  CHECK(holds(header, "    AttitudeCommand attitude;\n    Actuators actuators;\n"));
}

TEST_CASE("ports and templates that cannot be are refused with a sentence") {
  const auto refused = [](const std::string& arguments, const std::string& words) {
    const Result result = call("new a_part " + arguments);
    CHECK(result.code == 1);
    CHECK_MESSAGE(holds(result.words, words), result.words);
  };
  refused("", "new.component_unspecified");
  refused("--in state=nav.stat",
          "new.output_unknown(state, nav.stat, hourglass.yaml,  [nav.state] vehicle.imu, ");
  refused("--in nav.state", "new.port_form_invalid(--in, nav.state, OWNER.PORT, as in state=nav.state)");
  refused("--out range=range", "new.output_form_invalid(range, range)");
  refused("--out a=A --out a=B", "new.port_duplicate(a)");
  refused("--template planer", "new.template_unknown(planer,  [planner] planner, sensor)");
  refused("--template planner --in edits=nav.state",
          "new.template_input_unknown(edits, planner,  [] progress, state, results)");
  refused("--template planner --out a=A", "new.template_with_outputs");
  refused("--role outer --in state=nav.state", "new.role_with_ports");
  refused("--role outer --role outer", "new.role_duplicate(outer)");
  refused("--role outer --role vehicle", "new.vehicle_with_roles");
}

TEST_CASE("a struct never takes a name that the SDK has") {
  REQUIRE(call("new gnss --role nav").code == 0);
  CHECK(holds(text_of(folder() / "gnss/gnss.hpp"), "struct GnssComponent {"));
}

TEST_CASE("what cannot be written is refused with a sentence, and nothing is overwritten") {
  CHECK(call("new 9lives --role outer").words == "new.plugin_name_invalid(9lives)\n");
  CHECK(call("new test --role outer").words == "new.plugin_name_reserved(test, test)\n");
  CHECK(call("new ekf --role nav").words == "new.name_in_use(hourglass, component, ekf, ekf)\n");
  const std::string a_law = "new a_law --role outer ";
  CHECK(holds(call(a_law + "--mission hourglas").words,
              "new.mission_unknown(hourglas,  [hourglass] autotune, by_hand, calm, "));
  file_with("taken", "mine");
  CHECK(call(a_law + "--dir taken").words == "new.folder_is_file(taken)\n");
  fs::create_directories(folder() / "full");
  file_with("full/file", "mine");
  const Result refused = call(a_law + "--dir full");
  CHECK(refused.code == 1);
  CHECK(refused.words == "new.folder_not_empty(full)\n");
  CHECK(text_of(folder() / "full/file") == "mine");
  CHECK_THROWS_AS(find_places("/nowhere/bin/fulmar"), Error);
}

TEST_CASE("a shell reads back the word that is written for it") {
  for (const std::string word : {"plain/path-1.yaml", "two words", "it's", "a$b`c"}) {
    FILE* pipe = popen(("printf %s " + shell_word(word)).c_str(), "r");
    char buffer[64] = {};
    CHECK(fread(buffer, 1, sizeof buffer - 1, pipe) == word.size());
    pclose(pipe);
    CHECK(buffer == word);
  }
}
