// SPDX-License-Identifier: BSD-3-Clause
// The shipped mission: every signal is flown, the output of `fulmar response`, and the reasons of an abort.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "kit.hpp"
#include "sdk/test/said.hpp"

namespace flight_test {

namespace fs = std::filesystem;
using namespace fulmar::test;
using nlohmann::json;

namespace {

struct Folder {
  static inline int count = 0;
  fs::path path = fs::temp_directory_path() /
                  ("fulmar_signal_" + std::to_string(getpid()) + "_" + std::to_string(count++));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

constexpr const char* mission = FULMAR_SOURCE_DIR "/configs/missions/excitation.yaml";

/// A log of the mission, flown once for all cases.
std::string flown() {
  static const Folder folder;
  static const std::string log = [] {
    const std::string file = (folder.path / "x.mcap").string();
    const Said r = typed(std::string("run ") + mission + " --live off --strict --log " + file);
    REQUIRE_MESSAGE(r.code == 0, r.out);
    for (const char* phase : {"pitch_doublet", "roll_chirp", "elevator_3211", "height_step", "level"})
      CHECK_MESSAGE(holds(r.out, std::string("run.phase_entered(") + phase + ")"), r.out);
    CHECK_MESSAGE(!holds(r.out, "aborted"), r.out);
    return file;
  }();
  return log;
}
json response(const std::string& words) {
  const Said r = typed("response " + flown() + " --json " + words);
  REQUIRE_MESSAGE(r.code == 0, r.out);
  return json::parse(r.out);
}

}  // namespace

TEST_CASE("the mission is in order in simulation and on a flight controller; a wrong shape is refused") {
  for (const char* io : {"sim", "fcu"}) {
    const Said r = typed(std::string("check ") + mission + " --io " + io);
    CHECK_MESSAGE(r.code == 0, r.out);
  }
  const Said r = typed(std::string("check ") + mission + " --set attitude_signal.shape=triangle");
  CHECK(r.code == 4);
  for (const char* word :
       {"attitude_signal.shape",
        "graph.choice_unknown(triangle,  [] none, step, doublet, square, sine, chirp, d3211, multisine)"})
    CHECK_MESSAGE(holds(r.out, word), r.out);
  const Said large = typed(std::string("check ") + mission + " --set \"surface_signal.size=40 deg\"");
  CHECK(large.code == 4);
  CHECK_MESSAGE(holds(large.out, "surface_signal.size"), large.out);
}

TEST_CASE("the doublet stands in the log as it was asked for, and the aircraft has followed it") {
  const json o = response(
      "--phase pitch_doublet --step --input attitude_signal.pitch_excitation_rad --output "
      "nav.state.pitch_rad");
  const json step = o.at("step");  // the larger one, from up to down
  CHECK(step.at("input_change").get<double>() == doctest::Approx(-8).epsilon(0.02));
  CHECK(step.at("end_time_s").get<double>() - step.at("step_time_s").get<double>() ==
        doctest::Approx(0.99).epsilon(0.01));
  CHECK(step.at("output_change").get<double>() < -3);
}

TEST_CASE("the height step: time domain figures of the outer loop") {
  const json step = response(
                        "--phase height_step --input command_signal.height_excitation_m --output "
                        "nav.state.height_m")
                        .at("step");
  CHECK(step.at("input_change").get<double>() == doctest::Approx(5));
  CHECK(step.at("steady_gain").get<double>() == doctest::Approx(1).epsilon(0.03));
  CHECK(std::abs(step.at("steady_error").get<double>()) < 0.15);
  // no faster than it may climb, 0.8 * 5 m with all of 20 degrees at 17 m/s; and settled well before the end
  CHECK(step.at("rise_time_s").get<double>() > 0.8 * 5 / (17 * std::sin(20 * kit::deg)));
  CHECK(step.at("rise_time_s").get<double>() < 3);
  CHECK(step.at("settling_time_s").get<double>() < 8);
  CHECK(step.at("overshoot_percent").get<double>() < 15);
}

TEST_CASE("the sweep: roll follows its command below its bandwidth, lags beyond, and is coherent") {
  const json frequency = response(
                             "--phase roll_chirp --frequency --input excited_attitude.attitude.roll_rad "
                             "--output nav.state.roll_rad")
                             .at("frequency");
  double low = 0, high = 0, before = 400;
  for (const json& row : frequency.at("rows")) {
    const double hz = row.at("frequency_hz");
    if (hz < 0.3 || hz > 3) continue;
    CHECK(row.at("coherence").get<double>() > 0.97);  // least where the chirp is as fast as the loop: 0.977
    if (hz < 0.5) {
      ++low;
      CHECK(row.at("gain").get<double>() == doctest::Approx(1.04).epsilon(0.05));
      CHECK(std::abs(row.at("phase_deg").get<double>()) < 12);
    }
    if (hz > 2.5) {
      ++high;
      CHECK(row.at("phase_deg").get<double>() < -70);
    }
    CHECK(row.at("phase_deg").get<double>() < before + 2);
    before = row.at("phase_deg");
  }
  CHECK(low >= 2);
  CHECK(high >= 4);
}

TEST_CASE("a signal that leaves its bound is aborted, told, and no other follows; the flight goes on") {
  const Said r = typed(std::string("run ") + mission + " --live off --no-log --duration 60 --set " +
                       "\"attitude_signal.pitch_bound=4 deg\"");
  CHECK(r.code == 0);
  CHECK_MESSAGE(holds(r.out, "signal.aborted_by_pitch"), r.out);
  CHECK_MESSAGE(holds(r.out, "run.phase_entered(level)"), r.out);
  CHECK_MESSAGE(!holds(r.out, "run.phase_entered(roll_chirp)"), r.out);
}

TEST_CASE("the pilot takes over in the midst of a sweep: aborted, and not begun again when he lets go") {
  const Folder folder;
  const fs::path file = folder.path / "pilot.yaml";
  std::ofstream(file)
      << "extends: " << mission << "\nlive: null\nphases:\n"
      << "  any: {next: null}\n"
      << "  roll_chirp: {next: [{to: taken, when: \"time > 45 s\"}]}\n"
      << "  taken: {vehicle: {set: {pilot_flies: true}}, excited_attitude: {set: {shape: chirp, "
         "channel: roll, size: 8 deg, duration: 40 s, frequency: 0.15 Hz}}, next: [{to: back, "
         "when: \"time > 47 s\"}]}\n"
      << "  back: {excited_attitude: {set: {shape: chirp, channel: roll, size: 8 deg, duration: 40 "
         "s, frequency: 0.15 Hz}}, next: [{to: elevator_3211, when: \"time > 1000 s\"}]}\n";
  const std::string log = (folder.path / "pilot.mcap").string();
  const Said r = typed("run " + file.string() + " --duration 60 --log " + log);
  CHECK_MESSAGE(holds(r.out, "signal.aborted_by_pilot"), r.out);
  const std::string to_csv = " --to csv --topic /attitude_signal/probes --out ";
  REQUIRE(typed("log export " + log + to_csv + folder.path.string() + "/csv").code == 0);
  std::ifstream csv(folder.path / "csv" / "attitude_signal.probes.csv");
  std::string line, cell;
  std::getline(csv, line);
  std::vector<std::string> names;
  for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
  std::size_t excited = 0, after = 0;
  while (std::getline(csv, line)) {
    std::istringstream row(line);
    double time = 0, roll = 0;
    for (const std::string& name : names) {
      std::getline(row, cell, ',');
      if (name == "time_s") time = std::atof(cell.c_str());
      if (name == "roll_excitation_rad") roll = std::atof(cell.c_str());
    }
    if (time > 40 && time < 45 && roll != 0) ++excited;
    if (time > 45.3 && roll != 0) ++after;
  }
  CHECK(excited > 400);
  CHECK(after == 0);
}

TEST_CASE("its replay gives equal bytes") {
  CHECK(holds(typed("replay " + flown()).out, "0 differing bytes"));
}

}  // namespace flight_test
