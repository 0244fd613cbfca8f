// SPDX-License-Identifier: BSD-3-Clause
// bench_outage for an aircraft that does not move, so that the errors are known.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace outage_test {

using doctest::Approx;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-outage-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

struct Said {
  int code = 0;
  std::string out;
};

Said bench(const std::string& arguments) {
  FILE* pipe = popen((FULMAR_BIN_DIR "/bench_outage " + arguments + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  Said said;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) said.out.append(buffer, n);
  said.code = WEXITSTATUS(pclose(pipe));
  return said;
}

/// 60 s at rest on the equator, where a degree of longitude is 111319.49 m (WGS 84: a pi / 180). Fixes from
/// 30 s to `until_s` have errors of 3e-4 deg and 5 m of height.
void write_standing(const Folder& folder, double until_s, const std::string& more = "") {
  std::ofstream imu(folder.path / "imu.csv"), gps(folder.path / "gps.csv"), air(folder.path / "air.csv");
  imu << "t,p,q,r,x,y,z\n", gps << "t,lat,lon,alt,vn,ve,vd\n", air << "t,p\n";
  for (int i = 0; i <= 6000; ++i) imu << 0.01 * i << ",0,0,0,0,0,-9.80665\n";
  for (int i = 0; i <= 300; ++i) {
    const bool off = 0.2 * i >= 30 && 0.2 * i < until_s;
    gps << 0.2 * i << ",0," << (off ? "10.0003" : "10") << "," << (off ? 5 : 0) << ",0,0,0\n";
  }
  for (int i = 0; i <= 1200; ++i) air << 0.05 * i << ",101325\n";
  std::ofstream(folder.path / "log.yaml")
      << "name: standing\narmed: {to: 0 s}\nairborne: {to: 0 s}\n"
         "imu:\n  from: {file: imu.csv, time: t}\n  rate: {columns: [p, q, r]}\n"
         "  specific_force: {columns: [x, y, z]}\n"
         "baro:\n  from: {file: air.csv, time: t}\n  pressure: {column: p}\n"
         "gnss:\n  from: {file: gps.csv, time: t, delay: 200 ms}\n"
         "  position: {columns: [lat, lon, alt]}\n  velocity: {columns: [vn, ve, vd]}\n"
      << more;
}

std::string log_of(const Folder& folder) {
  return (folder.path / "log.yaml").string() + " --folder " + folder.path.string();
}

json figures(const std::string& arguments) {
  const Said said = bench(arguments + " --json");
  REQUIRE_MESSAGE(said.code == 0, said.out);
  json result = json::parse(said.out, nullptr, false);
  REQUIRE(result.is_object());
  return result;
}

}  // namespace

TEST_CASE("the error is that from the last fix withheld, at its time; quantiles are of all outages") {
  const Folder folder;
  write_standing(folder, 40);
  const json f = figures(log_of(folder) + " --starts 30,15 --seconds 10");
  const json &wrong = f["outages"][0], &right = f["outages"][1];
  constexpr double off_m = 3e-4 * 111319.49;
  CHECK(wrong["horizontal_m"].get<double>() == Approx(off_m).epsilon(0.02));
  CHECK(wrong["height_m"].get<double>() == Approx(-5).epsilon(0.1));
  CHECK(wrong["after_s"].get<double>() == Approx(9.6));  // arrived at 39.8 s, 0.2 s late
  CHECK(right["horizontal_m"].get<double>() < 0.5);
  CHECK(right["start_s"] == 15);
  const double a = right["horizontal_m"], b = wrong["horizontal_m"];
  CHECK(f["horizontal"]["median_m"].get<double>() == Approx((a + b) / 2));
  CHECK(f["horizontal"]["p90_m"].get<double>() == Approx(a + 0.9 * (b - a)));
  CHECK(f["horizontal"]["max_m"].get<double>() == Approx(b));
  CHECK(f["horizontal"]["rms_m"].get<double>() == Approx(std::sqrt((a * a + b * b) / 2)));
  CHECK(f["height"]["max_m"].get<double>() == Approx(5).epsilon(0.1));
  const double c = wrong["claimed_m"], d = right["claimed_m"];
  CHECK(c > 0);
  CHECK(f["horizontal"]["claimed_m"].get<double>() == Approx(std::sqrt((c * c + d * d) / 2)));
}

TEST_CASE("with all fixes each of them is compared, and a receiver that jumps moves the height by degrees") {
  const Folder folder;
  write_standing(folder, 30);  // no fix is off
  const json right = figures(log_of(folder) + " --starts 15 --seconds 10")["with_fixes"];
  CHECK(right["fixes"].get<int>() > 250);
  CHECK(right["height_rms_m"].get<double>() < 0.3);
  CHECK(right["height_step_m"].get<double>() < 0.05);
  CHECK(right["velocity_down_rms_mps"].get<double>() < 0.05);
  write_standing(folder, 60);  // half of them are, by 5 m and 33 m
  const json wrong = figures(log_of(folder) + " --starts 15 --seconds 10")["with_fixes"];
  CHECK(wrong["fixes"] == right["fixes"]);
  CHECK(wrong["height_rms_m"].get<double>() > 1);
  CHECK(wrong["height_rms_m"].get<double>() < 5);
  CHECK(wrong["height_step_m"].get<double>() < 0.8);
  CHECK(wrong["horizontal_rms_m"].get<double>() > 5);
  CHECK(wrong["horizontal_rms_m"].get<double>() < 3e-4 * 111319.49);
}

TEST_CASE("windows of the description itself stay") {
  const Folder folder;
  write_standing(folder, 45, "  withhold: [{from: 30 s, to: 45 s}]\n");
  const json f = figures(log_of(folder) + " --starts 45 --seconds 5");
  CHECK(f["outages"][0]["horizontal_m"].get<double>() < 0.5);
}

TEST_CASE("a filter's parameter can be set, and the deviation it claims is then another") {
  const Folder folder;
  write_standing(folder, 40);
  const std::string outage = log_of(folder) + " --starts 30 --seconds 10";
  const double as_shipped = figures(outage)["horizontal"]["claimed_m"];
  const double set = figures(outage + " --set ekf.gnss_horizontal_std='30 m'")["horizontal"]["claimed_m"];
  CHECK(set > 2 * as_shipped);
}

TEST_CASE("what cannot be flown is told in one sentence") {
  const Folder folder;
  write_standing(folder, 40);
  const Said late = bench(log_of(folder) + " --starts 55 --seconds 10");
  CHECK(late.code == 1);
  CHECK(late.out ==
        "outage.fixes_outside(55 s, 65 s, " + (folder.path / "log.yaml").string() + ", 0 s, 60 s)\n");
  const Said nowhere = bench((folder.path / "log.yaml").string() + " --folder nowhere --starts 30");
  CHECK(nowhere.code == 1);
  CHECK(nowhere.out.find("sensor_log.file_missing(nowhere/imu.csv)") != std::string::npos);
  for (const char* const none : {"", "log.yaml --starts 30", "log.yaml --folder . --starts 30,x",
                                 "log.yaml --folder . --starts 30 --seconds 0", "log.yaml --what 1"}) {
    const Said usage = bench(none);
    CHECK(usage.code == 2);
    CHECK(usage.out.starts_with("usage: bench_outage "));
  }
}

TEST_CASE("on a real flight thirty seconds without GNSS stay within the drift of good estimators") {
  const fs::path flight = FULMAR_REFERENCE_DATA "/flights/skywalker_x8";
  if (!fs::exists(flight / "imu.csv")) {
    MESSAGE("skipped: no recorded flight at " << flight.string());
    return;
  }
  const json f = figures("configs/sensor_logs/skywalker_x8.yaml --folder " + flight.string() +
                         " --starts 280,310,340,370,400,430,460,490,520 --seconds 30");
  CHECK(f["outages"].size() == 9);
  CHECK(f["horizontal"]["median_m"].get<double>() < 35);
  CHECK(f["horizontal"]["max_m"].get<double>() < 80);
  CHECK(f["horizontal"]["max_m"].get<double>() > 5);  // a smaller error would show that fixes were used
}

}  // namespace outage_test
