// SPDX-License-Identifier: BSD-3-Clause
// A recorded flight (CSV files of one folder) as messages for the component in order of time.
#pragma once
#include <cstdlib>
#include <fstream>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace recorded {

using namespace fulmar;
using Table = std::vector<std::vector<double>>;

inline Table read_csv(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  Table table;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<double> row;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
    table.push_back(row);
  }
  return table;
}

struct Fix {
  double t = 0;  ///< arrival
  Gnss gnss;
};
struct Reference {
  double t = 0, roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
};

struct Flight {
  std::vector<std::pair<double, Imu>> imu;
  std::vector<Fix> gnss;
  std::vector<std::pair<double, Mag>> mag;
  std::vector<std::pair<double, Baro>> baro;
  std::vector<std::pair<double, Pitot>> pitot;
  std::vector<Reference> reference;
  double gnss_delay_s = 0.2;
};

/// Skywalker X-8, 2013: README.md of the data folder.
inline Flight skywalker_x8(const std::string& folder) {
  constexpr double rad = std::numbers::pi / 180;
  Flight f;
  for (const auto& r : read_csv(folder + "/imu.csv"))
    f.imu.push_back({r[0], {{r[4], r[5], r[6]}, {r[1], r[2], r[3]}, 300}});
  for (const auto& r : read_csv(folder + "/mag.csv"))
    f.mag.push_back({r[0], {{r[1] * 1e-7, r[2] * 1e-7, r[3] * 1e-7}}});
  for (const auto& r : read_csv(folder + "/air.csv")) {
    f.pitot.push_back({r[0],
                       {0.5 * isa::sea_level_density * r[1] * r[1], r[1],
                        300}});  // ArduPilot of 2013 logs a speed made with sea-level density
    f.baro.push_back({r[0], {standard_air(25 + r[2]).pressure_pa, 300}});
  }
  double itow = 0;
  for (const auto& r : read_csv(folder + "/gps.csv")) {
    if (r[1] == itow) continue;
    itow = r[1];
    Fix fix{r[0], {}};
    Gnss& g = fix.gnss;
    g.latitude_deg = r[5];
    g.longitude_deg = r[6];
    g.altitude_m = r[7];
    g.velocity_mps = {r[11], r[12], r[10]};
    g.utc_ns = 1384992000'000'000'000;  // 2013-11-21
    g.fix = r[2] >= 3 ? FixType::fix_3d : FixType::none;
    g.satellites = static_cast<std::uint8_t>(r[3]);
    f.gnss.push_back(fix);
  }
  for (const auto& r : read_csv(folder + "/ref_dcm_attitude.csv"))
    f.reference.push_back({r[0], r[1] * rad, r[2] * rad, r[3] * rad});
  return f;
}

}  // namespace recorded
