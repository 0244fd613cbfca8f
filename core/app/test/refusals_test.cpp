// SPDX-License-Identifier: BSD-3-Clause
// Input that the program rejects before a flight: values, aircraft and names.
#include "shell.hpp"

namespace app_test {

TEST_CASE("impossible values are rejected before the flight") {
  const Result command = fulmar("runn " + hourglass);
  CHECK(command.code == 2);
  CHECK(command.err.find("fulmar: app.command_unknown(runn,  [run] run, check, graph, inspect, new") == 0);
  const Result driver = fulmar("run " + hourglass + " --no-log --drivers-from nowhere.mcap");
  CHECK(driver.code == 4);
  CHECK(driver.err.find("run.driver_missing(nowhere.mcap, hourglass)") != std::string::npos);
  CHECK(fulmar("run " + hourglass + " --with slc=").code == 2);
  const std::string with_slc = "check " + hourglass + " --with slc=";
  CHECK(fulmar(with_slc + "control_slc").code == 0);
  CHECK(fulmar(with_slc + "control_slc/Outer").code == 0);
  const Result no_plugin = fulmar(with_slc + "control_slk");
  CHECK(no_plugin.err.find("graph.plugin_unknown(control_slk, ") != std::string::npos);
  CHECK(no_plugin.err.find("control_manual, control_slc,") != std::string::npos);
  const Result as_json = fulmar("run " + hourglass + " --set slc.roll_kq=1 --json");
  CHECK(as_json.code == 4);
  for (const char* part :
       {"\"code\": \"types.name_unknown_in\"", "\"name\": \"roll_kq\"", "\"place\": \"--set slc.roll_kq=1\""})
    CHECK_MESSAGE(as_json.out.find(part) != std::string::npos, as_json.out);
  const Result full = shell(program + "run " + hourglass + " --json --no-log --duration 1 > /dev/full");
  CHECK(full.code == 1);
  CHECK(full.err.find("app.result_not_writable(No space left on device)") != std::string::npos);
  const Result page = shell(program + "check " + hourglass + " > /dev/full");
  CHECK(page.code == 1);
  CHECK(page.err == "fulmar: app.output_not_writable\n");
}

TEST_CASE("a value that no aircraft has is rejected, with its range" * doctest::test_suite("amounts")) {
  const std::string with_plan = "components:\n  plan: {params: {plan: ";
  const auto refused = [](const std::string& text, const std::string& reported) {
    CAPTURE(text);
    for (const std::string command : {"check ", "run --no-log --duration 1 "}) {
      const Result r = fulmar(command + mission(text).string());
      CHECK(r.code == 4);
      CHECK_MESSAGE(r.err.find(reported) != std::string::npos, r.err);
    }
  };
  refused(plan + "failsafe: {elevator_rad: 100}\n",
          "elevator_rad: graph.value_out_of_range(100, -1.5708, 1.5708,  rad, )");
  refused(plan + "failsafe: {rudder_rad: -2}\n",
          "rudder_rad: graph.value_out_of_range(-2, -1.5708, 1.5708,  rad, . Did you mean -2 deg?)");
  refused(plan + "timeout: 1e-300 s\n", "timeout: graph.duration_too_short('1e-300 s')");
  const std::string way =
      ", waypoints: [{north: 300 m, east: 0 m, up: 70 m}, {north: 0 m, east: 300 m, up: 70 m}]}}}\n";
  refused(with_plan + "{airspeed: 1e-6 m/s" + way,
          "airspeed: graph.value_out_of_range(1e-6 m/s, 3, 300,  m/s, )");
  refused(with_plan + "{airspeed: 1e6 m/s" + way,
          "airspeed: graph.value_out_of_range(1e6 m/s, 3, 300,  m/s, )");
  refused(with_plan + "{turn_radius: 1e9 m" + way,
          "turn_radius: graph.value_out_of_range(1e9 m, 1, 100000,  m, )");
  refused(with_plan + "{waypoints: [{north: 1e9 m, east: 0 m, up: 70 m}]}}}\n",
          "north: graph.value_out_of_range(1e9 m, -100000, 100000,  m, )");
  const std::string same = "{north: 1 m, east: 2 m, up: 70 m}";
  refused(with_plan + "{waypoints: [" + same + ", " + same + "]}}}\n",
          "plan.waypoints[1]: path.waypoint_before_close");
  refused(with_plan + "{waypoints: [" + same + "]}}}\n", "plan.waypoints: path.circuit_of_one");
  CHECK(fulmar("run --no-log --duration 1 " +
               mission(with_plan + "{end: orbit, waypoints: [" + same + "]}}}\n").string())
            .code == 0);
  for (const char* const altitude : {"1e30 m", "100 km", "-20 km"}) {
    const fs::path file = mission(plan);
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    text.replace(text.find("1387 m"), 6, altitude);
    std::ofstream(file) << text;
    const Result r = fulmar("check " + file.string());
    CHECK(r.code == 4);
    CHECK_MESSAGE(r.err.find("origin.alt_msl: graph.value_out_of_range(" + std::string(altitude) + ", ") !=
                      std::string::npos,
                  r.err);
  }
}

TEST_CASE("a rejected waypoint, and a rejected value of a plan, have their line in the plan file") {
  const fs::path file = folder() / "refused_plan.yaml";
  const fs::path m = mission("components:\n  plan: {params: {plan: " + file.string() + "}}\n");
  const auto refused = [&](const std::string& text, const std::string& reported) {
    std::ofstream(file) << text;
    const Result r = fulmar("check " + m.string());
    CHECK(r.code == 4);
    CHECK_MESSAGE(r.err.find(file.string() + reported) != std::string::npos, r.err);
  };
  const std::string waypoint = "  - {north: 300 m, east: 0 m, up: 70 m}\n";
  refused("waypoints:\n" + waypoint + "  - {north: 0 m, east: 0 m, up: -70 m}\n",
          ":3: plan: plan.waypoints[1]: path.waypoint_low(-70.0, 1)");
  refused("waypoints:\n" + waypoint + waypoint, ":3: plan: plan.waypoints[1]: path.waypoint_before_close");
  refused("end: circuit\nwaypoints:\n" + waypoint, ":2: plan: plan.waypoints: path.circuit_of_one");
  refused("turn_radius: 80 m\n", ":1: plan: plan: path.plan_empty");
}

namespace {

/// A copy of a shipped airframe with `from` replaced; and the line of the replacement.
std::pair<std::string, int> changed_airframe(const std::string& from, const std::string& to) {
  std::ifstream in(FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  text.replace(at, from.size(), to);
  const fs::path file = folder() / "changed.yaml";
  std::ofstream(file) << text;
  return {file.string(), static_cast<int>(line)};
}

}  // namespace

TEST_CASE("an aircraft that cannot fly is rejected with the line of the fault, before the flight") {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& field,
                          const std::string& why) {
    const auto [file, line] = changed_airframe(from, to);
    const fs::path m = folder() / "aircraft.yaml";
    std::ofstream(m) << "mission: trial\nextends: " << hourglass << "\nairframe: " << file << "\n";
    for (const std::string command : {"check ", "run --no-log "}) {
      const Result r = fulmar(command + m.string());
      CHECK(r.code == 4);
      CHECK_MESSAGE(
          r.err.find(file + ":" + std::to_string(line) + ": sim: " + field + ": ") != std::string::npos,
          r.err);
      CHECK_MESSAGE(r.err.find(why) != std::string::npos, r.err);
    }
  };
  refused("xz_kgm2: 0.06", "xz_kgm2: 0.5", "airframe.inertia.xz", "sim_aero.inertia_not_definite(");
  refused("airspeed_cruise: 17 m/s", "airspeed_cruise: 8 m/s", "airframe.limits.airspeed_cruise",
          "sim_aero.wing_stalls(");
  const fs::path m = folder() / "aircraft.yaml";
  std::ofstream(m) << "mission: trial\nextends: " << hourglass
                   << "\ncomponents:\n  sim:\n    params:\n      start_height: 70 m\n"
                      "      start_airspeed: 6 m/s\n";
  CHECK(fulmar("check " + m.string())
            .err.find("aircraft.yaml:7: sim: start_airspeed: sim_aero.level_flight_impossible(6, ") !=
        std::string::npos);
  const Result set = fulmar("check " + hourglass + " --set \"sim.airframe.mass=45 kg\"");
  CHECK(set.code == 4);
  CHECK_MESSAGE(set.err.find(": sim: airframe.limits.airspeed_cruise: ") != std::string::npos, set.err);
  const Result inertia = fulmar("check " + hourglass + " --set \"sim.airframe.inertia.xz=1 kg m^2\"");
  CHECK_MESSAGE(inertia.err.find("--set sim.airframe.inertia.xz=1 kg m^2: sim: airframe.inertia.xz: ") !=
                    std::string::npos,
                inertia.err);
}

TEST_CASE("an invalid file name, or one with control characters, is rejected") {
  const fs::path file = folder() / "names.yaml";
  for (const char* const text :
       {"mission: \"a\\0b\"\n", "mission: \"\\e[2J\"\n", "record: {file: \"x\\0y.mcap\"}\n"}) {
    std::ofstream(file) << text;
    const Result r = fulmar("check " + file.string());
    CHECK(r.code == 4);
    CHECK_MESSAGE(r.err.find("names.yaml:1: graph.control_character_found(") != std::string::npos, r.err);
  }
  const Result r = fulmar("run " + hourglass + " --duration 1 --log " + std::string(300, 'x') + ".mcap");
  CHECK(r.code == 4);
  CHECK_MESSAGE(r.err.find(".mcap.part, File name too long)") != std::string::npos, r.err);
  CHECK(r.err.find("filesystem error") == std::string::npos);
  fs::create_symlink(folder() / "nowhere" / "there", folder() / "link.mcap");
  const Result link = fulmar("run " + hourglass + " --duration 1 --log " + (folder() / "link.mcap").string());
  CHECK(link.code == 4);
  CHECK_MESSAGE(
      link.err.find("log.log_exists(" + (folder() / "link.mcap").string() + ")") != std::string::npos,
      link.err);
}

}  // namespace app_test
