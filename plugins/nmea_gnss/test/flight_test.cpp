// SPDX-License-Identifier: BSD-3-Clause
// The receiver as a driver of a flight: a pseudo-terminal feeds the program, and then its log does.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "device.hpp"
#include "sentences.hpp"

namespace flight_test {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-nmea-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

/// An aircraft that waits on the ground at the origin, and a receiver next to it.
fs::path mission(const fs::path& folder, const std::string& port) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs/";
  std::ofstream(folder / "receiver.yaml")
      << "mission: receiver\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\n"
         "arm: off\n"
         "origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
         "summary: {difference: compare.difference}\n"
         "roles:\n"
         "  reference: {out: {gnss: Gnss}}\n"
         "components:\n"
         "  plan: {params: {plan: "
      << configs
      << "plans/hourglass.yaml}}\n"
         "  receiver: {fills: reference, use: nmea_gnss/Receiver, run: driver, params: {port: "
      << port
      << "}}\n"
         "  compare: {use: nmea_gnss/Compare, rate: 100 Hz, in: {state: nav.state, reference: "
         "reference.gnss}}\n";
  return folder / "receiver.yaml";
}

json fly(const std::string& arguments) {
  FILE* pipe = popen((FULMAR_BIN_DIR "/fulmar run --json " + arguments + " 2>/dev/null").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  const int status = pclose(pipe);
  CHECK(WEXITSTATUS(status) == 0);
  return json::parse(out, nullptr, false);
}

/// The origin, 3 m to the north of it (0.00162 minutes of arc of 1852 m).
std::string epoch_at_origin(int number) {
  char time[64], gga[192], rmc[192];
  std::snprintf(time, sizeof time, "%02d%02d%02d.%d0", 12 + number / 18000, number / 300 % 60,
                number / 5 % 60, number % 5 * 2);
  std::snprintf(gga, sizeof gga, "GNGGA,%s,4014.78396,N,11138.84483,W,1,09,1.00,1387.0,M,-17.0,M,,", time);
  std::snprintf(rmc, sizeof rmc, "GNRMC,%s,A,4014.78396,N,11138.84483,W,0.1,90.0,091226,,,A", time);
  return framed(rmc) + framed(gga);
}

}  // namespace

TEST_CASE(
    "samples of the receiver enter a flight as they come, are recorded, and come back from the log to the "
    "bit") {
  const Folder folder;
  Device device;
  device.plug();
  const fs::path file = mission(folder.path, device.path()), log = folder.path / "first.mcap";
  std::atomic<bool> stop{false};
  std::thread sender([&] {
    for (int i = 0; !stop; ++i) {
      device.try_write(epoch_at_origin(i));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // five per second of flight
    }
  });
  const json first = fly(file.string() + " --speed 10 --duration 10 --log " + log.string());
  stop = true;
  sender.join();
  device.pull();
  REQUIRE(first.is_object());
  REQUIRE(first["difference"].is_object());
  CHECK(first["difference"]["samples"].get<int>() >= 10);  // 75 on an idle machine
  CHECK(first["difference"]["north_m"].get<double>() == doctest::Approx(3).epsilon(0.05));
  CHECK(first["difference"]["east_m"].get<double>() < 0.2);

  const json again = fly(file.string() + " --duration 10 --no-log --drivers-from " + log.string());
  REQUIRE(again.is_object());
  CHECK(again["difference"] == first["difference"]);
  CHECK(again["difference"].dump() == first["difference"].dump());
}

TEST_CASE("a flight whose receiver is not there flies without it") {
  const Folder folder;
  const json result =
      fly(mission(folder.path, "/dev/fulmar-no-such-port").string() + " --duration 2 --no-log");
  REQUIRE(result.is_object());
  CHECK(result["result"] == "flown");
  CHECK(result["difference"].is_null());
}

}  // namespace flight_test
