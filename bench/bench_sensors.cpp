// SPDX-License-Identifier: BSD-3-Clause
// Allan deviations at rest of inertial sensors from files, ten hours of samples, compared with the values of
// the files: at one second, where it is that of the noise density, and the minimum, which is the bias
// instability. Exits 1 when one differs by more than a tenth.
// bench_sensors FILE.yaml... [--hours N] [--seed N] [--json]
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plugins/sim_aero/test/allan.hpp"
#include "sensors/suite_file.hpp"

using namespace fulmar::sim;

namespace {

struct Options {
  std::vector<std::string> files;
  double hours = 10;
  std::uint64_t seed = 1;
  bool json = false;
};

int usage() {
  std::fprintf(stderr, "usage: bench_sensors FILE.yaml... [--hours N] [--seed N] [--json]\n");
  return 2;
}

bool read(int argc, char** argv, Options& o) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool valued = word == "--hours" || word == "--seed";
    if (valued && i + 1 == argc) return false;
    if (word == "--json")
      o.json = true;
    else if (word == "--hours")
      o.hours = std::atof(argv[++i]);
    else if (word == "--seed")
      o.seed = std::strtoull(argv[++i], nullptr, 10);
    else if (word.starts_with("-"))
      return false;
    else
      o.files.push_back(word);
  }
  return !o.files.empty() && o.hours >= 0.1 && o.hours <= 100;
}

/// One line, and true when it is within a tenth. A value that a file does not give is 0, and is accepted.
bool report(const char* sensor, double unit, const Curve& c, const SheetSpec& sheet, const Options& o,
            nlohmann::json& into) {
  const auto near = [](double is, double stated) { return stated <= 0 || std::abs(is / stated - 1) <= 0.1; };
  const double density = sheet.instability > 0 ? sheet.noise_after_1s : 0;
  const bool within = near(c.at_1s(), density) && near(c.lowest(), sheet.instability);
  into[sensor] = {{"at_1s", c.at_1s()},      {"at_1s_stated", sheet.noise_after_1s},
                  {"lowest", c.lowest()},    {"lowest_stated", sheet.instability},
                  {"within", within},        {"tau_s", c.tau_s},
                  {"deviation", c.deviation}};
  if (!o.json)
    std::printf("  %-6s at 1 s %10.4g (%10.4g)   lowest %10.4g (%10.4g)%s\n", sensor, c.at_1s() / unit,
                sheet.noise_after_1s / unit, c.lowest() / unit, sheet.instability / unit,
                within ? "" : "   BEYOND");
  return within;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  if (!read(argc, argv, o)) return usage();
  bool within = true;
  nlohmann::json all = nlohmann::json::object();
  try {
    for (const std::string& file : o.files) {
      const SensorSuite suite = suite_file(file);
      const SensorSpec s = spec_of(suite, suite.imu.timing.rate_hz);
      if (!o.json) std::printf("%s: gyro deg/h, accel ug; stated in brackets\n", file.c_str());
      nlohmann::json& into = all[std::string(suite.name.view())];
      const double seconds = 3600 * o.hours, degph = 3.14159265358979 / 180 / 3600, ug = 9.80665e-6;
      const Curve gyro = allan_curve(s.gyro, s.gyro_sheet, s.imu_hz, seconds, o.seed);
      within = report("gyro", degph, gyro, s.gyro_sheet, o, into) && within;
      const Curve accel = allan_curve(s.accel, s.accel_sheet, s.imu_hz, seconds, o.seed + 1);
      within = report("accel", ug, accel, s.accel_sheet, o, into) && within;
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  all["within"] = within;
  if (o.json) std::printf("%s\n", all.dump(2).c_str());
  return within ? 0 : 1;
}
