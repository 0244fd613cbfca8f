// SPDX-License-Identifier: BSD-3-Clause
// sensor_log_files FOLDER: writes a bag and a ULog there and prints, as one JSON object, what the vehicle
// published of them: a list of [arrival in ns since the first inertial sample, numbers...] for each sensor of
// each file.
#include <cstdio>
#include <fulmar/testing.hpp>

#include "../recorded.hpp"
#include "files.hpp"

using namespace fulmar;
using namespace fulmar::sensor_log;

namespace {

using Rows = std::string;

void add(Rows& rows, std::int64_t at_ns, const std::vector<double>& numbers) {
  char text[64];
  std::snprintf(text, sizeof text, "%s[%lld", rows.empty() ? "" : ",", static_cast<long long>(at_ns));
  rows += text;
  for (const double x : numbers) {
    std::snprintf(text, sizeof text, ",%.17g", x);
    rows += text;
  }
  rows += "]";
}

std::vector<double> numbers(const Vec3<Body>& a) { return {a.x, a.y, a.z}; }

/// The JSON object of one file.
std::string published(const std::string& folder, const char* file, const std::array<const char*, 5>& topics) {
  Bench<Recorded> bench;
  Description& d = bench.params.log.value;
  d.imu.from.file = d.mag.from.file = d.baro.from.file = d.pitot.from.file = d.gnss.from.file = file;
  d.imu.from.topic = topics[0];
  d.mag.from.topic = topics[1];
  d.baro.from.topic = topics[2];
  d.pitot.from.topic = topics[3];
  d.gnss.from.topic = topics[4];
  bench.params.folder.value = Text<256>(folder);
  Rows imu, mag, baro, pitot, gnss;
  do {
    if (bench.read() != Status::ok) throw std::runtime_error(bench.error());
    const auto& out = bench.out;
    if (out.imu.written) {
      std::vector<double> all = numbers(out.imu.value.rate_radps);
      for (const double x : numbers(out.imu.value.specific_force_mps2)) all.push_back(x);
      add(imu, out.imu.valid_at_ns, all);
    }
    if (out.mag.written) add(mag, out.mag.valid_at_ns, numbers(out.mag.value.field_tesla));
    if (out.baro.written) add(baro, out.baro.valid_at_ns, {out.baro.value.pressure_pa});
    if (out.pitot.written) add(pitot, out.pitot.valid_at_ns, {out.pitot.value.pressure_pa});
    const Gnss& g = out.gnss.value;
    if (out.gnss.written)
      add(gnss, out.gnss.valid_at_ns,
          {g.latitude_deg, g.longitude_deg, g.altitude_m, g.velocity_mps.north, g.velocity_mps.east,
           g.velocity_mps.down, g.horizontal_std_m, static_cast<double>(g.satellites)});
  } while (!bench.out.recording.ended);
  return "{\"imu\":[" + imu + "],\"mag\":[" + mag + "],\"baro\":[" + baro + "],\"pitot\":[" + pitot +
         "],\"gnss\":[" + gnss + "]}";
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::string folder = words[1];
  write(folder + "/flight.mcap", files::bag());
  write(folder + "/flight.ulg", files::ulog());
  try {
    std::printf(
        "{\"bag\":%s,\n\"ulog\":%s}\n",
        published(folder, "flight.mcap", {"/imu/data", "/mag", "/pressure", "/airspeed", "/gnss"}).c_str(),
        published(
            folder, "flight.ulg",
            {"sensor_combined", "sensor_mag#1", "vehicle_air_data", "differential_pressure", "sensor_gps"})
            .c_str());
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
  return 0;
}
