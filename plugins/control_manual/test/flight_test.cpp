// SPDX-License-Identifier: BSD-3-Clause
// The shipped mission with a scripted transmitter: every level, the research scheme, and back, without a
// step.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sdk/test/said.hpp"

namespace flight_test {

namespace fs = std::filesystem;
using namespace fulmar::test;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar_manual_" + std::to_string(getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// The shipped mission with the pilot of scripted_pilot.cpp.
  fs::path mission() const {
    const fs::path file = path / "script.yaml";
    std::ofstream(file) << "extends: " FULMAR_SOURCE_DIR "/configs/missions/manual.yaml\nlive: null\n"
                        << "components: {script: {fills: transmitter, use: " FULMAR_BIN_DIR
                           "/../lib/fulmar-test/scripted_pilot.so}}\n";
    return file;
  }
};

/// A topic of an exported log: columns of numbers by their names.
struct Table {
  std::map<std::string, std::vector<double>> columns;
  explicit Table(const fs::path& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(in, line);
    for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
    while (std::getline(in, line)) {
      std::istringstream row(line);
      for (const std::string& name : names) {
        std::getline(row, cell, ',');
        columns[name].push_back(std::atof(cell.c_str()));
      }
    }
    REQUIRE(columns["time_s"].size() > 10);
  }
  /// At the first row from `time_s` on.
  double at(const std::string& name, double time_s) const {
    const auto& t = columns.at("time_s");
    const auto i = std::lower_bound(t.begin(), t.end(), time_s) - t.begin();
    return columns.at(name).at(static_cast<std::size_t>(i));
  }
  /// Largest difference between two neighbours between two times.
  double step(const std::string& name, double from_s, double to_s) const {
    const auto &t = columns.at("time_s"), &x = columns.at(name);
    double most = 0;
    for (std::size_t i = 1; i < t.size(); ++i)
      if (t[i] > from_s && t[i] < to_s) most = std::max(most, std::abs(x[i] - x[i - 1]));
    return most;
  }
};

}  // namespace

TEST_CASE("the mission is in order in simulation and on a flight controller") {
  for (const char* io : {"sim", "fcu"}) {
    const Said r = typed(std::string("check " FULMAR_SOURCE_DIR "/configs/missions/manual.yaml --io ") + io);
    CHECK_MESSAGE(r.code == 0, r.out);
  }
}

TEST_CASE("a word that is no choice of an axis is refused before the flight, with the choices") {
  const Said r = typed("check " FULMAR_SOURCE_DIR "/configs/missions/manual.yaml --set moved.course=stick");
  CHECK(r.code == 4);
  for (const char* word :
       {"moved.course: ", "graph.choice_unknown(stick,  [sticks] sticks, automatic, hold, flown)"})
    CHECK_MESSAGE(holds(r.out, word), r.out);
  const Folder folder;
  const fs::path file = folder.path / "wrong.yaml";
  std::ofstream(file) << "extends: " FULMAR_SOURCE_DIR "/configs/missions/manual.yaml\n"
                      << "phases:\n  rates: {inner: {use: stick, set: {aileron: rudder}}}\n";
  const Said phase = typed("check " + file.string());
  CHECK(phase.code == 4);
  CHECK_MESSAGE(holds(phase.out, "wrong.yaml:3"), phase.out);
  CHECK_MESSAGE(holds(phase.out, "graph.choice_unknown(rudder,  [] surface, rate, attitude)"), phase.out);
}

TEST_CASE(
    "a radio that falls silent leaves the pilot's level after the time-out, and the first frames bring it "
    "back") {
  const Folder folder;
  const Said r = typed("run " + folder.mission().string() +
                       " --role transmitter=script --set script.lost=65 --duration 75 --no-log");
  CHECK_MESSAGE(r.code == 0, r.out);
  CHECK_MESSAGE(holds(r.out, "65.59 s  run.phase_entered(cruise)"),
                r.out);  // 0.5 s without a frame, 0.1 s of the condition
  CHECK_MESSAGE(holds(r.out, "66.50 s  run.phase_entered(increments)"), r.out);
}

TEST_CASE(
    "every level, the research scheme and back: the pilot's stick moves what it should, and no surface "
    "steps") {
  const Folder folder;
  const fs::path log = folder.path / "flight.mcap", csv = folder.path / "csv";
  const Said flown = typed("run " + folder.mission().string() +
                           " --role transmitter=script --set sim.turbulence=none --set sim.sensors=perfect "
                           "--duration 140 --record 'inner.actuators,guide.command,outer.attitude' --log " +
                           log.string());
  REQUIRE_MESSAGE(flown.code == 0, flown.out);
  for (const char* phase : {"increments", "angles", "rates", "surfaces", "research"})
    CHECK_MESSAGE(holds(flown.out, std::string("run.phase_entered(") + phase + ")"), flown.out);
  CHECK(holds(flown.out, "manual: flown (duration reached)"));

  REQUIRE(typed("log export " + log.string() + " --to csv --out " + csv.string()).code == 0);
  const Table u(csv / "inner.actuators.csv"), command(csv / "guide.command.csv"),
      truth(csv / "vehicle.truth.csv");
  // increments: 2 s of 0.4 to the right and of 0.15 back, with the shipped dead zone and expo
  const auto shape = [](double x) {
    const double y = (x - 0.05) / 0.95;
    return 0.7 * y + 0.3 * y * y * y;
  };
  const double course =
      std::remainder(command.at("course_rad", 65) - command.at("course_rad", 61), 2 * std::acos(-1.0));
  CHECK(course == doctest::Approx(2 * 0.5 * shape(0.4)).epsilon(0.02));
  CHECK(command.at("height_m", 65) - command.at("height_m", 61) ==
        doctest::Approx(2 * 3 * shape(0.15)).epsilon(0.02));
  CHECK(std::remainder(truth.at("course_rad", 69) - command.at("course_rad", 69), 6.2831853) ==
        doctest::Approx(0).epsilon(0.05));
  // angles
  CHECK(truth.at("roll_rad", 73.9) == doctest::Approx(0.5 * shape(0.4)).epsilon(0.1));
  CHECK(std::abs(truth.at("roll_rad", 79)) < 0.03);
  // rates: two seconds, and then it stays
  const double bank = truth.at("roll_rad", 84.5) - truth.at("roll_rad", 81.9);
  CHECK(bank == doctest::Approx(std::min(2 * 1.5 * shape(0.4), 0.785)).epsilon(0.1));
  CHECK(std::abs(truth.at("roll_rad", 89.5) - truth.at("roll_rad", 84.5)) < 0.06);
  for (double t = 60; t <= 120; t += 10) {
    CAPTURE(t);
    for (const char* surface : {"aileron_rad", "elevator_rad", "rudder_rad"}) {
      CAPTURE(surface);
      CHECK(u.step(surface, t - 0.05, t + 0.3) < 0.025);  // rad, from one step to the next, 10 ms
    }
    CHECK(u.step("throttle_frac", t - 0.05, t + 0.3) < 0.03);
  }
  // control returned: at the end the aircraft is on its path
  CHECK(truth.at("height_m", 138) == doctest::Approx(70).epsilon(0.02));
  CHECK(holds(typed("replay " + log.string()).out, "0 differing bytes"));
}

}  // namespace flight_test
