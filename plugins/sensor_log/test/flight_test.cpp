// SPDX-License-Identifier: BSD-3-Clause
// Descriptions in YAML and whole flights, by the program.
#include <sys/wait.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "files.hpp"
#include "recording.hpp"

namespace flight_test {

using nlohmann::json;
using recording::Folder;
namespace fs = std::filesystem;

namespace {

const std::string mission = FULMAR_SOURCE_DIR "/configs/missions/sensor_log.yaml";
const fs::path skywalker = FULMAR_REFERENCE_DATA "/flights/skywalker_x8";

struct Said {
  int code = 0;
  std::string out;
};

/// Output of the program, with its error messages unless `2>...` redirects them.
Said fulmar_says(const std::string& arguments) {
  FILE* pipe = popen((FULMAR_BIN_DIR "/fulmar " + arguments).c_str(), "r");
  REQUIRE(pipe != nullptr);
  Said said;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) said.out.append(buffer, n);
  said.code = WEXITSTATUS(pclose(pipe));
  return said;
}

/// A mission with the description `yaml` in log.yaml in its folder. 100 Hz.
std::string mission_of(const Folder& folder, const std::string& yaml) {
  folder.write("log.yaml", yaml);
  return folder.write(
      "small.yaml",
      "mission: small\nio: sim\nrate: 100 Hz\ndone: vehicle.recording.ended\n"
      "summary: {recording: vehicle.recording, imu: vehicle.imu}\n"
      "roles: {vehicle: {out: {imu: Imu, recording: Recording}}}\n"
      "components: {recorded: {fills: vehicle, use: sensor_log, params: {log: log.yaml, folder: " +
          folder.path.string() + "}}}\n");
}

const char* const whole =
    "name: small\n"
    "imu:\n"
    "  from: {file: imu.csv, time: t, unit: ms, delay: 5 ms}\n"
    "  rate: {columns: [p, q, r], unit: degps, offset: [1 deg/s, 0 deg/s, 0 deg/s]}\n"
    "  specific_force: {columns: [x, y, z], unit: g, axes: flu}\n"
    "  withhold: [{from: 10 ms, to: 20 ms}]\n";
const char* const rows = "t,p,q,r,x,y,z\n0,0,0,0,0,0,1\n10,0,0,0,0,0,1\n20,181,0,0,0,0,1\n";

/// `whole` with one thing changed.
std::string with(const std::string& old, const std::string& now) {
  std::string text = whole;
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), now);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Output of `check` for a description.
std::string refusal(const Folder& folder, const std::string& yaml) {
  const Said said = fulmar_says("check " + mission_of(folder, yaml) + " 2>&1");
  CHECK(said.code == 4);
  return said.out;
}

/// Columns of a CSV file by name.
std::map<std::string, std::vector<double>> columns_of(const fs::path& path) {
  std::ifstream file(path);
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> names;
  std::string line, cell;
  std::getline(file, line);
  for (std::stringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    for (std::size_t i = 0; std::getline(cells, cell, ',') && i < names.size(); ++i)
      columns[names[i]].push_back(std::strtod(cell.c_str(), nullptr));
  }
  return columns;
}

}  // namespace

TEST_CASE(
    "a description in YAML says columns, units, delay, calibration and windows; its end ends the flight") {
  const Folder folder;
  folder.write("imu.csv", rows);
  const Said said = fulmar_says("run " + mission_of(folder, whole) + " --no-log --json 2>/dev/null");
  CHECK(said.code == 0);
  const json result = json::parse(said.out, nullptr, false);
  REQUIRE(result.is_object());
  CHECK(result["result"] == "flown");
  CHECK(result["reason"] == "vehicle.recording.ended");
  CHECK(result["flight_time_s"].get<double>() == doctest::Approx(0.02));
  CHECK(result["recording"]["withheld"] == 1);
  CHECK(result["imu"]["rate_radps"]["x"].get<double>() == doctest::Approx(3.14159265359));
  CHECK(result["imu"]["specific_force_mps2"]["z"].get<double>() == doctest::Approx(-9.80665));
}

TEST_CASE("the description in the README is one") {
  const Folder folder;
  std::ifstream readme(FULMAR_SOURCE_DIR "/plugins/sensor_log/README.md");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  const std::size_t begin = text.find("name: my_flight"), end = text.find("```", begin);
  REQUIRE(end != std::string::npos);
  folder.write("imu.csv",
               "t_us,gx,gy,gz,ax,ay,az\n0,0,0,0,0,0,-1\n20000000,1.2,0,0,1,0,-1\n601000000,0,0,0,0,0,-1\n");
  folder.write("mag.csv", "t,mx,my,mz\n12.5,200,0,-500\n620,200,0,-500\n");
  folder.write("air.csv", "t,p_static,p_diff\n0,1000,103\n601,1000,103\n");
  folder.write("gps.csv",
               "t,itow,lat,lon,alt,vn,ve,vd,status,nsat,hacc\n0,1,10000000,20000000,3000,0,0,0,3,8,2\n"
               "601,2,10000000,20000000,3000,0,0,0,3,8,2\n");
  const Said said = fulmar_says("run " + mission_of(folder, text.substr(begin, end - begin)) +
                                " --no-log --json 2>&1 >" + (folder.path / "result.json").string());
  CHECK_MESSAGE(said.code == 0, said.out);
  std::ifstream file(folder.path / "result.json");
  const json result = json::parse(file, nullptr, false);
  REQUIRE(result.is_object());
  CHECK(result["imu"]["rate_radps"]["x"].get<double>() == doctest::Approx(0.01745329252));  // 1.2 - 0.2 deg/s
  CHECK(result["imu"]["specific_force_mps2"]["x"].get<double>() == doctest::Approx(9.8262633));  // 1.002 g
  CHECK(result["imu"]["specific_force_mps2"]["z"].get<double>() == doctest::Approx(-9.80665));
}

TEST_CASE("what is wrong with a description is told with its file and line, and what is valid there") {
  const Folder folder;
  folder.write("imu.csv", rows);
  const std::string unit = refusal(folder, with("unit: g,", "unit: gee,"));
  CHECK(has(unit, "log.yaml:5"));
  CHECK(has(unit, "gee"));
  CHECK(has(unit, "mps2"));
  const std::string column = refusal(folder, with("[p, q, r]", "[p, yaw, r]"));
  CHECK(has(column, "log.yaml:4"));
  const std::string heading = folder.path.string() + "/imu.csv:1, t, p, q, r, x, y, z";
  CHECK(has(column, "sensor_log.column_unknown(yaw, " + heading + ")"));
  const std::string none = refusal(folder, with(" time: t,", ""));
  CHECK(has(none, "log.yaml:3"));
  CHECK(has(none, "log.imu.from.time: sensor_log.column_not_named("));
  const std::string key = refusal(folder, with("delay:", "dealy:"));
  CHECK(has(key, "log.yaml:3"));
  CHECK(has(key, "delay"));
  const std::string late = refusal(folder, with("delay: 5 ms", "delay: 5 Hz"));
  CHECK(has(late, "log.yaml:3"));
  CHECK(has(late, "5 Hz"));
  const std::string window = refusal(folder, with("to: 20 ms", "to: 10 ms"));
  CHECK(has(window, "log.yaml:6"));
  CHECK(has(window, "log.imu.withhold[0]: sensor_log.window_empty("));
}

TEST_CASE(
    "what is wrong with a file is told with its line and with the line of the description that names it") {
  const Folder folder;
  folder.write("imu.csv", std::string(rows) + "30,0,0");
  const std::string cut = refusal(folder, whole);
  CHECK(has(cut, "log.yaml:3"));
  CHECK(has(cut, "imu.csv:5, 3, 7)"));
  CHECK(has(cut, "log.imu.from.file: sensor_log.row_cut("));
  folder.write("imu.csv", std::string(rows) + "30,0,0,0,x,0,0\n");
  const std::string word = refusal(folder, whole);
  CHECK(has(word, "log.yaml:5"));
  CHECK(has(word, "imu.csv:5, x, x)"));
  CHECK(has(word, "sensor_log.number_not_valid("));
}

TEST_CASE(
    "a bag flies by a description that names its topics alone; a topic that is none is told with its line") {
  const Folder folder;
  folder.write("flight.mcap", files::bag());
  const std::string description = "name: bag\nimu:\n  from: {file: flight.mcap, topic: /imu/data}\n";
  const Said said = fulmar_says("run " + mission_of(folder, description) + " --no-log --json 2>/dev/null");
  CHECK(said.code == 0);
  const json result = json::parse(said.out, nullptr, false);
  REQUIRE(result.is_object());
  CHECK(result["result"] == "flown");
  CHECK(result["imu"]["rate_radps"]["z"].get<double>() == doctest::Approx(0.9));
  const std::string topic =
      refusal(folder, "name: bag\nimu:\n  from: {file: flight.mcap,\n         topic: /imu}\n");
  CHECK(has(topic, "log.yaml:4: recorded: log.imu.from.topic: sensor_log.topic_unknown(/imu, "));
  CHECK(has(topic, "flight.mcap, /imu/data, /gnss, "));
  folder.write("flight.mcap", files::bag().substr(0, 700));
  const std::string cut = refusal(folder, description);
  CHECK(has(cut, "log.yaml:3: recorded: log.imu.from.file: sensor_log.file_damaged("));
  CHECK(has(cut, "flight.mcap, "));
  CHECK(std::count(cut.begin(), cut.end(), '\n') == 1);
}

TEST_CASE("the log of a flight is a bag that flies: the sensors are those of then, in every bit") {
  const Folder folder;
  const std::string then = (folder.path / "then.mcap").string(), now = (folder.path / "now.mcap").string();
  const std::string alone = folder.write(
      "alone.yaml",
      "mission: alone\nio: sim\nairframe: " FULMAR_SOURCE_DIR
      "/configs/airframes/anaconda.yaml\n"
      "origin: {lat: 40.25, lon: -111.65, alt_msl: 1387 m}\nrate: 400 Hz\n"
      "roles: {vehicle: {out: {imu: Imu, gnss: Gnss, mag: Mag, baro: Baro, pitot: Pitot}}}\n"
      "components: {sim: {fills: vehicle, use: sim_aero/Aircraft, params: {sensors: rosflight}}}\n");
  const Said sim =
      fulmar_says("run " + alone + " --duration 12 --record 'vehicle.*' --log " + then + " 2>&1");
  REQUIRE_MESSAGE(sim.code == 0, sim.out);
  std::string description = "name: log\nairborne: {from: 100 s}\narmed: {from: 100 s}\n";
  for (const std::string sensor : {"imu", "mag", "baro", "pitot", "gnss"})
    description += sensor + ": {from: {file: then.mcap, topic: /vehicle/" + sensor + "}}\n";
  folder.write("log.yaml", description);
  const Said said = fulmar_says("run " + mission + " --set recorded.folder=" + folder.path.string() +
                                " --set recorded.log=" + (folder.path / "log.yaml").string() +
                                " --record 'vehicle.*' --log " + now + " 2>&1");
  REQUIRE_MESSAGE(said.code == 0, said.out);
  for (const auto& [log, csv] : {std::pair(then, "then"), std::pair(now, "now")})
    REQUIRE(
        fulmar_says("log export " + log + " --to csv --out " + (folder.path / csv).string() + " 2>&1").code ==
        0);
  for (const std::string sensor : {"imu", "mag", "baro", "pitot", "gnss"}) {
    CAPTURE(sensor);
    auto a = columns_of(folder.path / "then" / ("vehicle." + sensor + ".csv"));
    auto b = columns_of(folder.path / "now" / ("vehicle." + sensor + ".csv"));
    REQUIRE(a.size() == b.size());
    for (const auto& column : a) {
      const std::string& name = column.first;
      const std::vector<double>& numbers = column.second;
      if (name == "time_s" || name == "valid_s" || name == "utc_ns" || name == "temperature_kelvin") continue;
      CAPTURE(name);
      CHECK(numbers.size() > 10);
      if (name == "indicated_airspeed_mps")  // made of the pressure once more, which was a float then
        CHECK(numbers.back() == doctest::Approx(b[name].back()).epsilon(1e-6));
      else
        CHECK(numbers == b[name]);
    }
    for (std::size_t i = 0; i < b["time_s"].size(); ++i)
      if (std::abs(a["time_s"][i] - a["time_s"][0] - b["time_s"][i] + b["time_s"][0]) > 1e-8)
        FAIL("at " << a["time_s"][i]);
  }
}

TEST_CASE("the shipped mission without a folder is refused in one line that says how to give it") {
  const Said check = fulmar_says("check " + mission + " 2>&1");
  CHECK(check.code == 4);
  CHECK(has(check.out, "sensor_log.yaml:"));
  CHECK(has(check.out, "folder: sensor_log.folder_missing(imu.csv, mag.csv, air.csv, gps.csv)"));
  CHECK(std::count(check.out.begin(), check.out.end(), '\n') == 1);
  const Said run = fulmar_says("run --no-log " + mission + " 2>&1");
  CHECK(run.code == 4);
  CHECK(has(run.out, check.out));
}

TEST_CASE(
    "a Skywalker X-8 of 2013 flies again: every row arrives, and the estimate agrees with the one made on "
    "board") {
  if (!fs::exists(skywalker / "imu.csv")) {
    MESSAGE("skipped: no recorded flight at " << skywalker.string());
    return;
  }
  const Folder folder;
  const std::string log = (folder.path / "flight.mcap").string(), csv = (folder.path / "csv").string();
  const Said said = fulmar_says("run " + mission + " --set recorded.folder=" + skywalker.string() +
                                " --json --log " + log + " 2>/dev/null");
  CHECK(said.code == 0);
  const json result = json::parse(said.out, nullptr, false);
  REQUIRE(result.is_object());
  CHECK(result["result"] == "flown");
  CHECK(result["guards"].empty());
  CHECK(result["allocations"]["recorded"] == 0);
  for (const char* const none : {"not_finite", "out_of_order", "out_of_range", "withheld"})
    CHECK(result["recording"][none] == 0);
  CHECK(result["flight_time_s"].get<double>() == doctest::Approx(613).epsilon(1e-4));
  REQUIRE(fulmar_says("log export " + log + " --to csv --out " + csv + " 2>&1").code == 0);

  const auto before_the_end = [](const std::vector<double>& t_s) {
    return static_cast<std::size_t>(std::count_if(t_s.begin(), t_s.end(), [](double t) { return t < 613; }));
  };
  auto imu = columns_of(fs::path(csv) / "vehicle.imu.csv"), there = columns_of(skywalker / "imu.csv");
  REQUIRE(imu["time_s"].size() == before_the_end(there["t_s"]));
  bool same = true;
  for (std::size_t i = 0; i < imu["time_s"].size(); ++i)
    same = same && imu["time_s"][i] == there["t_s"][i] && imu["rate_radps.x"][i] == there["gx_rps"][i] &&
           imu["specific_force_mps2.z"][i] == there["az_mps2"][i];
  CHECK(same);
  CHECK(columns_of(fs::path(csv) / "vehicle.mag.csv")["time_s"].size() ==
        before_the_end(columns_of(skywalker / "mag.csv")["t_s"]));

  auto state = columns_of(fs::path(csv) / "nav.state.csv"),
       reference = columns_of(skywalker / "ref_dcm_attitude.csv");
  double roll = 0, pitch = 0;
  int n = 0;
  for (std::size_t i = 0, k = 0; i < reference["t_s"].size(); ++i) {
    const double t = reference["t_s"][i];
    if (t < 270 || t > 560 || std::abs(reference["pitch_deg"][i]) > 45) continue;
    while (state["time_s"][k] < t) ++k;
    const auto off = [&](const char* rad, const char* deg) {
      return std::remainder(state[rad][k] * 180 / std::numbers::pi - reference[deg][i], 360);
    };
    roll += std::pow(off("roll_rad", "roll_deg"), 2);
    pitch += std::pow(off("pitch_rad", "pitch_deg"), 2);
    ++n;
  }
  REQUIRE(n > 10000);
  CHECK(std::sqrt(roll / n) < 3.6);  // deg, the bounds of estimator_ekf's own test on this flight
  CHECK(std::sqrt(pitch / n) < 3.5);
}

}  // namespace flight_test
