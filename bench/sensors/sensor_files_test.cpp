// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "bench/sensors/suite_file.hpp"
#include "plugins/sim_aero/test/allan.hpp"

namespace sensor_files_test {

using namespace fulmar;
using namespace fulmar::sim;

namespace {

SensorSuite shipped(const std::string& name) {
  return suite_file(FULMAR_SOURCE_DIR "/configs/sensors/" + name + ".yaml");
}

void same(const NoiseSpec& a, const NoiseSpec& b) {
  CHECK(a.white == b.white);
  CHECK(a.bias == b.bias);
  CHECK(a.walk == b.walk);
  CHECK(std::abs(a.drift - b.drift) <= 1e-15 * b.drift);  // a decimal figure of what the code computes
  if (a.drift > 0) {
    CHECK(a.drift_tau_s == b.drift_tau_s);
    CHECK(a.drift_settled == b.drift_settled);
  }
  CHECK(a.offset == b.offset);
  if (a.offset != 0) CHECK(a.offset_tau_s == b.offset_tau_s);
}

std::string reported_of(const std::string& yaml) {
  const std::string file = "sensor_files_test.yaml";
  std::ofstream(file) << yaml;
  std::string words;
  try {
    suite_file(file);
  } catch (const std::exception& e) {
    words = e.what();
  }
  std::remove(file.c_str());
  return words;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("the files of the built-in sets say the built-in sets") {
  for (const auto& [name, set] : {std::pair{"perfect", SensorSet::perfect},
                                  {"rosflight", SensorSet::rosflight},
                                  {"ublox", SensorSet::ublox}}) {
    const std::string said = name;
    CAPTURE(said);
    const SensorSpec file = spec_of(shipped(name), 400), built_in = with_timing(sensor_spec(set));
    for (std::size_t i = 0; i < 3; ++i) {
      same(file.gyro[i], built_in.gyro[i]);
      same(file.accel[i], built_in.accel[i]);
      same(file.mag[i], built_in.mag[i]);
      same(file.gnss_position[i], built_in.gnss_position[i]);
      same(file.gnss_velocity[i], built_in.gnss_velocity[i]);
    }
    same(file.baro, built_in.baro);
    same(file.pitot, built_in.pitot);
    CHECK(file.pitot_scale == built_in.pitot_scale);
    CHECK(file.gnss_timing.latency_s == built_in.gnss_timing.latency_s);
    for (const auto line : {&SensorSpec::imu_timing, &SensorSpec::gnss_timing, &SensorSpec::mag_timing,
                            &SensorSpec::baro_timing, &SensorSpec::pitot_timing})
      CHECK((file.*line).rate_hz == (built_in.*line).rate_hz);
    CHECK(file.horizontal_std_m == built_in.horizontal_std_m);
    CHECK(file.vertical_std_m == built_in.vertical_std_m);
    CHECK(file.speed_std_mps == built_in.speed_std_mps);
    CHECK(file.single_precision == built_in.single_precision);
    CHECK(file.temperature_kelvin == built_in.temperature_kelvin);
    for (const auto sheet : {&SensorSpec::gyro_sheet, &SensorSpec::accel_sheet, &SensorSpec::mag_sheet,
                             &SensorSpec::baro_sheet, &SensorSpec::pitot_sheet})
      CHECK(!(file.*sheet).used());
  }
}

TEST_CASE("the Allan deviation of a shipped set is that of its data sheet") {
  // ADIS16470: 0.34 deg and 0.037 m/s per root hour, 8 deg/h, 13 ug. MPU-6000: 5 mdeg/s and 400 ug per root
  // Hz
  const double deg = 0.017453292519943295, ug = 9.80665e-6;
  const bool whole = std::getenv("FULMAR_LONG") != nullptr;
  const double seconds = whole ? 36000 : 1200;
  struct Figures {
    const char* name;
    double gyro_1s, gyro_lowest, accel_1s, accel_lowest;
  };
  for (const Figures& f : {Figures{"tactical", 0.34 * deg / 60, 8 * deg / 3600, 0.037 / 60, 13 * ug},
                           Figures{"mems_budget", 0.005 * deg / std::sqrt(2.0), 5 * deg / 3600,
                                   400 * ug / std::sqrt(2.0), 80 * ug}}) {
    CAPTURE(f.name);
    const SensorSpec s = spec_of(shipped(f.name), 400);
    const Curve gyro = allan_curve(s.gyro, s.gyro_sheet, 400, seconds, 1);
    const Curve accel = allan_curve(s.accel, s.accel_sheet, 400, seconds, 2);
    CHECK(std::abs(gyro.at_1s() / f.gyro_1s - 1) < 0.1);
    CHECK(std::abs(accel.at_1s() / f.accel_1s - 1) < 0.1);
    if (!whole) continue;
    CHECK(std::abs(gyro.lowest() / f.gyro_lowest - 1) < 0.1);
    CHECK(std::abs(accel.lowest() / f.accel_lowest - 1) < 0.1);
  }
}

TEST_CASE("what is wrong in a file of sensors is told with its line") {
  const std::string misspelt = reported_of("imu:\n  gyro: {nois_per_root_hz: 5 mdeg/s}\n");
  CHECK(misspelt.starts_with("sensor_files_test.yaml:2: "));
  CHECK(holds(misspelt, "graph.field_unknown(imu.gyro: , nois_per_root_hz, "));
  CHECK(holds(misspelt, "'noise_per_root_hz'?"));
  const std::string backward = reported_of("mag:\n  timing: {rate: -5 Hz}\n");
  CHECK(holds(backward, ":2: mag.timing.rate: graph.value_out_of_range(-5 Hz, "));
  const std::string often = reported_of("gnss: {timing: {dropouts: 1.5}}\n");
  CHECK(holds(often, "graph.value_out_of_range(1.5, 0, 0.99, "));
  const std::string negative = reported_of("imu: {accel: {noise_per_root_hz: -100 ug}}\n");
  CHECK_FALSE(holds(negative, "graph.value_out_of_range("));
  CHECK(holds(negative, "graph.value_too_small(-100 ug, 0"));
  const std::string angular = reported_of("imu: {accel: {noise_per_root_hz: 100 deg/s}}\n");
  CHECK(holds(angular, "graph.dimension_differs(100 deg/s, an angular rate, , an acceleration)"));
  const std::string valid = "imu: {accel: {noise_per_root_hz: 100 ug}}\n";
  CHECK(reported_of(valid).empty());
}

TEST_CASE("the hourglass is flown with each shipped set") {
  for (const std::string name : {"mems_budget", "tactical"}) {
    const std::string command = FULMAR_BIN_DIR "/fulmar run " FULMAR_SOURCE_DIR
                                               "/configs/missions/hourglass.yaml --log sensor_files_test.mcap"
                                               " --set sim.sensor_file=" FULMAR_SOURCE_DIR
                                               "/configs/sensors/" +
                                name + ".yaml >sensor_files_test.txt 2>&1";
    CAPTURE(name);
    CHECK(std::system(command.c_str()) == 0);
    std::remove("sensor_files_test.mcap");
    std::remove("sensor_files_test.txt");
  }
}

}  // namespace sensor_files_test
