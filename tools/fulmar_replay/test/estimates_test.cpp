// SPDX-License-Identifier: BSD-3-Clause
// Comparison of estimators, as a user sees it: fulmar replay --with, and two in one flight.
#include <nlohmann/json.hpp>

#include "core/app/test/shell.hpp"

using namespace app_test;
using nlohmann::json;

namespace {

/// The shipped mission with two estimators, 20 s of it.
const fs::path& flown() {
  static const fs::path log = [] {
    const fs::path file = folder() / "two_filters.mcap";
    REQUIRE(fulmar("run " FULMAR_SOURCE_DIR "/configs/missions/two_filters.yaml --duration 20 --log " +
                   file.string())
                .code == 0);
    return file;
  }();
  return log;
}
const std::string ekf = FULMAR_BIN_DIR "/../lib/fulmar/estimator_ekf.so";

json replayed(const std::string& words) {
  const Result r = fulmar("replay " + flown().string() + " --json " + words);
  INFO(r.err);
  REQUIRE(r.code == 0);
  return json::parse(r.out);
}
double rms(const json& errors, const char* side, const char* key) {
  return errors.at(side).at("channels").at(key).at("rms").get<double>();
}

}  // namespace

TEST_CASE("another filter under the role's name: what the log holds and what it says stand side by side" *
          doctest::test_suite("amounts")) {
  const json j = replayed("--with nav=" + ekf + " --set \"ekf.gnss_position_time=1 s\"");
  CHECK(j.at("before_equals_log") == true);
  REQUIRE(j.at("estimates").size() == 1);  // the second one has not changed
  const json e = j.at("estimates").at(0);
  CHECK(e.at("first").at("topic") == "/nav/state");
  CHECK(e.at("first").at("name") == "before");
  CHECK(e.at("first").at("log") == flown().string());
  CHECK(e.at("second").at("name") == "now");
  CHECK(e.at("first").at("samples") == e.at("second").at("samples"));
  CHECK(e.at("difference").at("position_north_m").at("rms") > 0.01);
  CHECK(e.at("errors").at("first").at("nees").at("correlated") == true);  // of the component's own port
  // with the parameters of the flight's second filter it gives the same estimate
  const Result two = fulmar("log compare --json " + flown().string());
  const json both = json::parse(two.out).at("estimates").at(0);
  CHECK(rms(both.at("errors"), "first", "position_north_m") ==
        rms(e.at("errors"), "first", "position_north_m"));
  CHECK(rms(both.at("errors"), "second", "position_north_m") !=
        rms(both.at("errors"), "first", "position_north_m"));
}

TEST_CASE("with the second filter's parameters the first one says the same as the second did in flight") {
  const json e = replayed("--set \"ekf.gnss_position_time=1 s\"").at("estimates").at(0);
  const json both = json::parse(fulmar("log compare --json " + flown().string()).out).at("estimates").at(0);
  for (const char* key : {"roll_deg", "velocity_east_mps", "position_north_m", "height_m", "wind_east_mps"}) {
    INFO(key);
    CHECK(rms(e.at("errors"), "second", key) == rms(both.at("errors"), "second", key));
    CHECK(e.at("difference").at(key) == both.at("difference").at(key));
  }
}

TEST_CASE("the table stands behind the figures; a controller's experiment has none") {
  const Result r = fulmar("replay " + flown().string() + " --set \"ekf.gnss_position_time=1 s\"");
  CHECK(r.code == 0);
  CHECK(r.out.find("app.flights_compared") < r.out.find("now - before"));
  CHECK(r.out.find("\nlog_tool.error_against(/vehicle/truth) before") != std::string::npos);
  CHECK(r.out.find("second") == std::string::npos);
  CHECK(replayed("--set attitude.roll_kp=0.1").at("estimates") == json::array());
  CHECK(fulmar("replay " + flown().string() + " --set attitude.roll_kp=0.1").out.find("now - before") ==
        std::string::npos);
}

TEST_CASE("a log that records no estimate says so; the experiment is flown all the same") {
  const fs::path file = mission(plan + "record: {ports: {score.*: 1 Hz}}\n"), log = folder() / "little.mcap";
  REQUIRE(fulmar("run " + file.string() + " --duration 5 --log " + log.string()).code == 0);
  const Result r = fulmar("replay " + log.string() + " --with nav=" + ekf + " --set ekf.start_height=1");
  CHECK(r.code == 0);
  CHECK(r.out.find("log_tool.common_estimate_missing\n") != std::string::npos);
  const Result none = fulmar("log compare " + log.string());
  CHECK(none.code == 1);
  CHECK(none.err.find("log_tool.state_names_required(") != std::string::npos);
}

TEST_CASE("what --with cannot mean is refused before anything flies") {
  const Result several =
      fulmar("check " FULMAR_SOURCE_DIR "/configs/missions/two_schemes.yaml --with outer=control_slc");
  CHECK(several.code == 4);
  CHECK(several.err == "--with outer=control_slc: graph.role_ambiguous(outer, slc, tecs)\n");
  const Result vehicle = fulmar("replay " + flown().string() + " --with vehicle=sim_aero");
  CHECK(vehicle.code == 4);
  CHECK(vehicle.err == "replay.change_without_effect(--with sim, sim, the vehicle)\n");
}

TEST_CASE("without the program of logs an experiment is flown, and it is told what is missing") {
  const fs::path home = folder() / "home";
  fs::create_directories(home / "bin");
  fs::create_directory_symlink(FULMAR_BIN_DIR "/../lib", home / "lib");
  for (const char* name : {"fulmar", "fulmar-probe", "fulmar-child", "fulmar-replay"})
    fs::copy_file(fs::path(FULMAR_BIN_DIR) / name, home / "bin" / name);
  const Result r = shell((home / "bin/fulmar").string() + " replay " + flown().string() +
                         " --set \"ekf.gnss_position_time=1 s\"");
  CHECK(r.code == 0);
  CHECK(r.err.find("replay.estimates_not_compared(replay.log_program_missing)") != std::string::npos);
}
