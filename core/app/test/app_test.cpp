// SPDX-License-Identifier: BSD-3-Clause
// The program for its users: exit codes, JSON keys, options, bad input, interruption, a full disk.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "shell.hpp"

namespace app_test {

using nlohmann::json;

TEST_CASE("the JSON of a flight has the keys that scripts need, and null for missing figures") {
  const Result r = fulmar("run " + hourglass + " --json --no-log --duration 150");
  REQUIRE(r.code == 0);
  const json j = json::parse(r.out);
  CHECK(j["mission"] == "hourglass");
  CHECK(j["io"] == "sim");
  CHECK(j["result"] == "flown");
  CHECK(j["reason"] == "duration reached");
  CHECK(j["flight_time_s"].get<double>() == doctest::Approx(155).epsilon(1e-4));
  CHECK(j["speedup"].get<double>() ==
        doctest::Approx(j["flight_time_s"].get<double>() / j["wall_time_s"].get<double>()));
  CHECK(j["log"].is_null());
  CHECK(j["log_sha256"].is_null());
  CHECK(j["log_dropped"] == 0);
  CHECK(j["guards"].empty());
  CHECK(j["phases"][0]["name"] == "hold");
  for (const char* key : {"mean", "p50", "p99", "max"})
    CHECK(j["step_time_us"]["ekf"][key].get<double>() > 0);
  CHECK(j["step_time_us"]["ekf"]["mean"] < j["step_time_us"]["ekf"]["max"]);
  for (const char* key :
       {"north_m", "east_m", "altitude_m", "roll_deg", "pitch_deg", "course_deg", "airspeed_mps"}) {
    CHECK(j["tracking_rmse"][key].is_number());
    CHECK(j["tracking_true_rmse"][key].is_number());
  }
  for (const char* key :
       {"north_m", "east_m", "altitude_m", "vel_x_mps", "vel_y_mps", "vel_z_mps", "roll_deg", "pitch_deg",
        "heading_deg", "course_deg", "airspeed_mps", "wind_n_mps", "wind_e_mps"})
    CHECK(j["estimation_rmse"][key].is_number());
  for (const char* key : {"north_m", "east_m"}) CHECK(j["gnss_error_rmse"][key].is_number());
  for (const char* key : {"waypoints_reached", "miss_distance_max_m", "lap_time_s", "surface_rate_rms_radps",
                          "airspeed_min_mps"})
    CHECK(j["mission_figures"].contains(key));
  for (const auto& component : j["allocations"].items())
    CHECK_MESSAGE(component.value() == 0, component.key());
  std::string last;
  for (const auto& [key, value] : j.items()) {
    CHECK(last < key);
    last = key;
  }
  const json early = json::parse(fulmar("run " + hourglass + " --json --no-log --duration 5").out);
  CHECK(early["tracking_rmse"].is_null());
}

TEST_CASE("the figure of a course without a command is null, and the others are numbers") {
  const Result r = fulmar(
      "run " +
      mission(plan + "  judge: {use: score/Score, in: {state: nav.state, attitude: outer.attitude}}\n" +
              "summary: {judged: judge.tracking}\n")
          .string() +
      " --json --no-log --duration 60");
  REQUIRE(r.code == 0);
  const json figures = json::parse(r.out)["judged"];
  CHECK(figures["course_deg"].is_null());
  CHECK(figures["roll_deg"].get<double>() > 0);
}

TEST_CASE("the table names the log, and never overwrites one") {
  const std::string log = (folder() / "one.mcap").string();
  const Result r = fulmar("run " + hourglass + " --duration 5 --log " + log);
  CHECK(r.code == 0);
  CHECK(r.out.find("hourglass: flown (duration reached)") != std::string::npos);
  CHECK(r.out.find("log " + log) != std::string::npos);
  const Result again = fulmar("run " + hourglass + " --duration 5 --log " + log);
  CHECK(again.code == 4);
  CHECK(again.err.find("log.log_exists(" + log + ")") != std::string::npos);
}

TEST_CASE("wrong usage exits 2") {
  CHECK(fulmar("").code == 2);
  CHECK(fulmar("run").code == 2);
  CHECK(fulmar("run a b c").code == 2);
  CHECK(fulmar("fly " + hourglass).code == 2);
  CHECK(fulmar("run " + hourglass + " --speed fast").code == 2);
  CHECK(fulmar("run " + hourglass + " --io boat").code == 2);
  CHECK(fulmar("run " + hourglass + " --set nonsense").code == 2);
  for (const char* duration : {"1e300", "nan", "-5", "0", "5x"})
    CHECK(fulmar("run " + hourglass + " --duration=" + duration).code == 2);
  CHECK(fulmar("run " + hourglass + " --seed=-1").code == 2);
  for (const char* words : {"run m.yaml --log ''", "replay a.mcap --log ''"}) {
    const Result r = fulmar(words);
    CHECK(r.code == 2);
    CHECK(r.err.starts_with("--log: app.file_name_empty("));
  }
  CHECK(fulmar("run " + hourglass + " --speed 0x10").code == 2);
  CHECK(fulmar("--help").code == 0);
  CHECK(fulmar("run --help").code == 0);
}

TEST_CASE("bad input is rejected with its place, and exits 4") {
  const Result missing = fulmar("run nowhere.yaml");
  CHECK(missing.code == 4);
  CHECK(missing.err.find("nowhere.yaml") != std::string::npos);
  const fs::path broken = folder() / "broken.yaml";
  std::ofstream(broken) << "mission: x\nroles: {a: [}\n";
  const Result yaml = fulmar("run " + broken.string());
  CHECK(yaml.code == 4);
  CHECK(yaml.err.find("broken.yaml:2") != std::string::npos);
  const Result airframe = fulmar("run " + mission(plan, "glider.yaml").string());
  CHECK(airframe.code == 4);
  CHECK(airframe.err.find("mission.yaml:4") != std::string::npos);
  CHECK(airframe.err.find("glider.yaml") != std::string::npos);
  const Result nan = fulmar("run " + mission(plan + "  slc: {params: {course_kp: .nan}}\n").string());
  CHECK(nan.code == 4);
  CHECK(nan.err.find("mission.yaml:8") != std::string::npos);
  CHECK(nan.err.find("course_kp") != std::string::npos);
  const Result set = fulmar("run " + hourglass + " --set slc.course_kq=1");
  CHECK(set.code == 4);
  CHECK(set.err.find("course_kp") != std::string::npos);
}

TEST_CASE("an interrupted flight closes its log and exits 130") {
  const std::string log = (folder() / "interrupted.mcap").string();
  const auto interrupted = [](const std::string& file) {  // the signal is sent once the flight has begun
    return " & until [ -e " + file + ".part ]; do sleep 0.1; done; sleep 0.5; kill -INT $!; wait $!; echo ";
  };
  const Result r = shell(program + "run " + hourglass + " --speed real --json --log " + log +
                         interrupted(log) + "code $?");
  const json j = json::parse(r.out.substr(0, r.out.rfind('}') + 1));
  CHECK(j["result"] == "interrupted");
  CHECK(fs::exists(log));
  // A shell lets its background commands ignore the signal until they handle it.
  const std::string again = (folder() / "signalled.mcap").string();
  const Result code = shell(program + "run " + hourglass + " --speed real --log " + again + " >/dev/null" +
                            interrupted(again) + "$?");
  CHECK(code.out == "130\n");
}

TEST_CASE("a crash names the component, a second signal ends a hanging one") {
  if (!FULMAR_CRASH_TESTS) return;  // a sanitizer reports crashes in a different form
  const std::string lab = folder() / "lab.yaml";
  std::ofstream(lab) << "mission: lab\nroles:\n  vehicle: {in: {command: law.command}, out: {signal: "
                        "Signal}}\n  law: {in: {signal: vehicle.signal}, out: "
                        "{command: Command}}\n"
                        "components:\n  sim: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: "
                        "lab/Law, params: {fault: crashes, fault_at: 0}}\n";
  const std::string run = "FULMAR_PLUGIN_PATH=" FULMAR_TEST_PLUGIN_DIR " " + program + "run " + lab +
                          " --log " + (folder() / "crash.mcap").string();
  const Result crash = shell("ulimit -c 0; " + run);
  const fs::path part = folder() / "crash.mcap.part";
  CHECK(crash.err.find("fulmar: app.component_crashed(one, step, segmentation fault). app.log_until_end(" +
                       part.string()) != std::string::npos);
  CHECK(fs::exists(part));
  const Result hang = shell(
      "export FULMAR_PLUGIN_PATH=" FULMAR_TEST_PLUGIN_DIR "; " + program + "run " + lab +
      " --no-log --set one.fault=hangs & sleep 2; kill -INT $!; sleep 0.7; kill -INT $!; wait $!; echo $?");
  CHECK(hang.out == "130\n");
  CHECK(hang.err.find("fulmar: app.ended_by_second_signal_in(step, one)") != std::string::npos);
}

TEST_CASE("a real-time flight takes real time") {
  const json j = json::parse(fulmar("run " + hourglass + " --json --no-log --duration 5 --speed 20").out);
  CHECK(j["wall_time_s"].get<double>() >= 0.499);
}

TEST_CASE("on a full disk the flight continues and the loss is reported") {
  // no file may grow beyond 1024 blocks of 512 bytes
  const std::string log = (folder() / "full.mcap").string();
  const Result r =
      shell("ulimit -f 1024; " + program + "run " + hourglass + " --json --duration 60 --log " + log);
  CHECK(r.code == 1);
  const json j = json::parse(r.out);
  CHECK(j["result"] == "flown");
  CHECK(j["log_dropped"].get<std::uint64_t>() > 1000);
  CHECK(j["log_error"].is_string());
  const std::string why = "log.operation_failed(write, " + log + ".part, File too large)";
  // The loop reports it in flight. Its progress at that time depends on two threads and on the load of the
  // machine.
  const std::size_t reported = r.err.find("run.log_failed(" + why),
                    summed_up = r.err.find("app.log_incomplete(" + why + ", " +
                                           std::to_string(j["log_dropped"].get<std::uint64_t>()) + ", ");
  CHECK(summed_up != std::string::npos);
  CHECK(reported < summed_up);
  CHECK(r.err.find(", " + log + ".part)\n", summed_up) != std::string::npos);
  CHECK_FALSE(fs::exists(log));
  CHECK(fulmar("log info " + log + ".part").out.find("complete") == std::string::npos);
  CHECK(fulmar("replay " + log + ".part").out.find("replay.log_cut_off(") != std::string::npos);
}

TEST_CASE("an incomplete log is a failure, for every end of the flight") {
  const std::string log = (folder() / "cut.mcap").string(), words = (folder() / "cut.txt").string();
  const Result r = shell("ulimit -f 64; " + program + "run " + hourglass + " --speed real --log " + log +
                         " >/dev/null 2>" + words + " & until grep -q 'run.log_failed(' " + words +
                         "; do sleep 0.1; done; kill -INT $!; wait $!; echo $?");
  CHECK(r.out == "1\n");
}

TEST_CASE("inspect and graph print text for users") {
  const Result inspect = fulmar("inspect " FULMAR_PLUGIN_DIR "/control_slc.so");
  CHECK(inspect.code == 0);
  CHECK(inspect.out.find("Outer") != std::string::npos);
  CHECK(inspect.out.find("Inner") != std::string::npos);
  CHECK(inspect.out.find("GuidanceCommand") != std::string::npos);
  for (const char* format : {"text", "dot", "mermaid"}) {
    const Result graph = fulmar("graph " + hourglass + " --format " + format);
    CHECK(graph.code == 0);
    CHECK(graph.out.find("ekf") != std::string::npos);
    if (std::string(format) == "text") CHECK(graph.out.find("cruise") != std::string::npos);
  }
}

TEST_CASE(
    "--repeat flies so many flights in one host, each with its own log; equal flights have equal bytes") {
  const Result r = fulmar("run " + hourglass + " --json --duration 5 --repeat 3 --log " +
                          (folder() / "again.mcap").string());
  REQUIRE(r.code == 0);
  const json flights = json::parse(r.out)["flights"];
  REQUIRE(flights.size() == 3);
  CHECK(flights[0]["log_sha256"] == flights[2]["log_sha256"]);
  CHECK(flights[1]["log"] == (folder() / "again-2.mcap").string());
  CHECK(fs::exists(folder() / "again-3.mcap"));
  const Result table = fulmar("run " + hourglass + " --duration 5 --repeat 2 --no-log");
  CHECK(table.out.find("no figure has changed") != std::string::npos);
}

namespace {

/// Runs the program in the background; collects its output.
struct Background {
  fs::path out = folder() / "background.txt";
  std::string pid;
  explicit Background(const std::string& arguments) {
    pid = shell(program + arguments + " >" + out.string() + " 2>&1 & echo $!").out;
    pid.erase(pid.find_last_not_of('\n') + 1);
  }
  ~Background() { shell("kill -INT " + pid + "; sleep 0.2; kill -9 " + pid); }
  std::string printed() const {
    std::ifstream file(out);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Waits for `words` in the output; returns false after a generous time.
  bool prints(const std::string& words, std::size_t times = 1) const {
    for (int i = 0; i < 1200; ++i) {
      const std::string text = printed();
      std::size_t found = 0;
      for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
      if (found >= times) return true;
      usleep(50'000);
    }
    return false;
  }
};

void put(const fs::path& from, const fs::path& to) {
  fs::copy_file(from, to.string() + ".new", fs::copy_options::overwrite_existing);
  fs::rename(to.string() + ".new", to);
}

}  // namespace

TEST_CASE(
    "--watch flies again with a plugin that has changed, compares, and stays with the old one when the new "
    "one is no good") {
  const fs::path mine = folder() / "mine.so", lib = FULMAR_PLUGIN_DIR;
  put(lib / "control_slc.so", mine);
  const fs::path file =
      mission("done: \"nav.state.height_m > 40 m\"\n" + plan +
              "  mine: {fills: outer, use: mine.so/Outer, rate: 100 Hz}\n" +
              "phases:\n  takeoff: {outer: {use: mine, set: {law: takeoff}}}\n  cruise: {outer: mine}\n");
  const Background watch("run " + file.string() + " --no-log --watch");
  REQUIRE(watch.prints("waiting for a change"));
  put(lib / "control_tecs.so", mine);
  REQUIRE(watch.prints("waiting for a change", 2));
  CHECK(watch.printed().find("rehearsed on 256 steps") != std::string::npos);
  CHECK(watch.printed().find("app.flights_compared") != std::string::npos);
  CHECK(watch.printed().find("flight_time_s") != std::string::npos);
  put(lib / "score.so", mine);
  REQUIRE(watch.prints("types.name_unknown_in(the plugin mine.so, component, Outer,  [] Score)"));
  REQUIRE(watch.prints("app.former_mission_kept"));
  put(lib / "control_slc.so", mine);
  CHECK(watch.prints("waiting for a change", 3));
}

TEST_CASE("--watch --build builds when a source has changed, and reports a failure") {
  const fs::path place = folder() / "project";
  fs::create_directories(place);
  put(fs::path(FULMAR_PLUGIN_DIR) / "control_slc.so", place / "next.so");
  put(fs::path(FULMAR_PLUGIN_DIR) / "control_tecs.so", place / "mine.so");
  const fs::path general =
      mission("done: \"nav.state.height_m > 40 m\"\n" + plan +
              "  mine: {fills: outer, use: mine.so/Outer, rate: 100 Hz}\n" +
              "phases:\n  takeoff: {outer: {use: mine, set: {law: takeoff}}}\n  cruise: {outer: mine}\n");
  fs::copy_file(general, place / "mission.yaml");
  std::ofstream(place / "law.cpp") << "1\n";
  const Background watch("run " + (place / "mission.yaml").string() +
                         " --no-log --watch --build \"grep -q 1 " + (place / "law.cpp").string() + " && mv " +
                         (place / "next.so").string() + " " + (place / "mine.so").string() + "\"");
  REQUIRE(watch.prints("waiting for a change"));
  std::ofstream(place / "law.cpp") << "nonsense\n";
  REQUIRE(watch.prints("campaign.build_failed"));
  std::ofstream(place / "law.cpp") << "1 \n";
  REQUIRE(watch.prints("app.flights_compared"));
  CHECK(fulmar("run " + hourglass + " --build true").code == 2);
}

TEST_CASE("a motion outside the model ends the flight with its cause and a complete log") {
  const std::string log = (folder() / "away.mcap").string();
  const auto fails = [&](const std::string& changes, const std::string& cause) {
    fs::remove(log);
    const Result r = fulmar("run " + hourglass + " --log " + log + " " + changes);
    CHECK(r.code == 1);
    CHECK(r.out.find("hourglass: failed") != std::string::npos);
    CHECK_MESSAGE((r.out + r.err).find("(run.vehicle_failed(" + cause) != std::string::npos, (r.out + r.err));
    const Result info = fulmar("log info " + log);
    CHECK(info.code == 0);
    CHECK_MESSAGE(info.out.find("complete") != std::string::npos, info.out);
  };
  fails("--set sim.airframe.aero.pitch.q=1e4 --set \"sim.start_height=100 m\"", "sim_aero.motion_diverged(");
  // take-off needs more than these 4 deg
  fails(
      "--set \"sim.airframe.aero.tables=[{coefficient: lift, over: alpha, at: [-0.1, 0.07], values: [0, "
      "0]}]\"",
      "sim_aero.flow_beyond_tables(angle of attack, ");
}

TEST_CASE("an interrupt during a build ends the build and the program") {
  const fs::path place = folder() / "slow_build";
  fs::create_directories(place);
  std::ofstream(place / "law.cpp") << "1\n";
  fs::copy_file(mission("done: \"nav.state.height_m > 20 m\"\n" + plan), place / "mission.yaml");
  const Background watch("run " + (place / "mission.yaml").string() +
                         " --no-log --watch --build \"sleep 4321\"");
  REQUIRE(watch.prints("waiting for a change"));
  std::ofstream(place / "law.cpp") << "2 \n";
  REQUIRE(watch.prints("building"));
  shell("kill -INT " + watch.pid);
  bool gone = false;
  for (int i = 0; i < 100 && !gone; ++i, usleep(50'000)) gone = shell("kill -0 " + watch.pid).code != 0;
  CHECK(gone);
  CHECK(shell("pgrep -f '^sleep 4321$'").code == 1);
}

TEST_CASE("the hourglass is flown over each Earth model and over flat ground" *
          doctest::test_suite("amounts")) {
  for (const char* earth : {"gravity", "wgs84"}) {
    const Result r = fulmar("run " + hourglass + " --json --no-log --strict --set sim.earth=" + earth);
    REQUIRE_MESSAGE(r.code == 0, r.err);
    const json j = json::parse(r.out);
    CHECK(j["result"] == "flown");
    CHECK(j["guards"].empty());
    CHECK(j["tracking_true_rmse"]["altitude_m"].get<double>() < 1.19);  // the limit of bench_missions
    CHECK(j["tracking_true_rmse"]["north_m"].get<double>() < 3.05);
    CHECK(j["tracking_true_rmse"]["east_m"].get<double>() < 3.29);
  }
}

TEST_CASE(
    "a log that is moved or removed is told while it flies, and the last sentence points to what is there") {
  const fs::path logs = folder() / "gone", kept = folder() / "kept";
  for (const bool removed : {false, true}) {
    CAPTURE(removed);
    const Background flight("run " + hourglass + " --speed real --log " + (logs / "a.mcap").string());
    const fs::path part = logs / "a.mcap.part";
    for (int i = 0; i < 1200 && !fs::exists(part); ++i) usleep(50'000);
    REQUIRE(flight.prints(" m  airspeed"));  // the flight has begun
    if (removed)
      fs::remove_all(logs);
    else
      fs::rename(logs, kept);
    const std::string what = (removed ? "log.log_removed(" : "log.log_moved(") + part.string();
    REQUIRE(flight.prints("run.log_failed(" + what));
    shell("kill -INT " + flight.pid);
    REQUIRE(flight.prints((removed ? "app.log_lost(" : "app.log_incomplete(") + what));
    const std::string printed = flight.printed();
    CHECK((printed.find(", " + (kept / "a.mcap.part").string() + ")\n") != std::string::npos) == !removed);
    CHECK((printed.find("app.log_lost(") != std::string::npos) == removed);
  }
}

TEST_CASE("check prints on standard error without time stamps; standard output is one line") {
  const fs::path file = mission(plan + "  follow: {in: {path: {from: manage.path, max_age: off}}}\n");
  const Result r = fulmar("check " + file.string());
  CHECK(r.code == 0);
  CHECK(r.out.starts_with(file.string() + " is in order: "));
  CHECK(r.out.find('\n') == r.out.size() - 1);
  CHECK_MESSAGE(r.err.starts_with("mission.yaml:8: "), r.err);
  CHECK(r.err.find("[warning]") == std::string::npos);
}

}  // namespace app_test
