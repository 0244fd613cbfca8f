// SPDX-License-Identifier: BSD-3-Clause
// A mission that is flown by hand, through a pipe of joystick records; and again from its log, to the byte.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>

#include "pipe.hpp"
#include "sdk/test/said.hpp"

namespace flight_test {

namespace fs = std::filesystem;
using namespace fulmar::test;
using namespace std::chrono_literals;
using nlohmann::json;

namespace {

/// As `typed`; calls back with the address of the live view as soon as it is printed.
Said watched(const std::string& words, std::atomic<int>& port) {
  return shell(FULMAR_BIN_DIR "/fulmar " + words + " 2>&1", [&](const std::string& line) {
    const std::string before = "live view: ws://127.0.0.1:";
    if (line.starts_with(before)) port = std::stoi(line.substr(before.size()));
  });
}

/// The mission of the pilot, without the simulation that an onlooker may be watching on this computer.
fs::path mission(const Pipe& pipe, const std::string& more = "") {
  const fs::path file = fs::path(pipe.path()).parent_path() / "hand.yaml";
  std::ofstream(file) << "extends: " FULMAR_SOURCE_DIR
                         "/configs/missions/by_hand.yaml\nlive: {listen: 127.0.0.1:0}\n"
                      << more << "components: {pilot: {params: {device: " << pipe.path() << "}}}\n";
  return file;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Levers and sticks where they are at rest: throttle closed, switches off.
std::string at_rest() {
  std::string all;
  for (int i = 0; i < 8; ++i) all += record(0x82, i, i == 2 || i > 3 ? -32767 : 0);
  return all;
}

}  // namespace

TEST_CASE("a roll is flown by hand, and its log flies it again, byte for byte") {
  Pipe pipe;
  pipe.plug();
  const fs::path folder = fs::path(pipe.path()).parent_path(), log = folder / "first.mcap",
                 again = folder / "again.mcap";
  const fs::path file = mission(pipe, "done: \"vehicle.status.override and vehicle.truth.roll_rad > 0.7\"\n");
  pipe.write(at_rest());
  std::atomic<bool> over{false};
  std::atomic<int> port{0};
  std::thread pilot([&] {  // by the state of the aircraft, independent of real time
    const auto wait = [&](const std::string& field, auto there) {
      while (!over) {
        std::this_thread::sleep_for(5ms);
        if (port == 0) continue;
        const Said r = typed("echo " + field + " --count 1 --json --at 127.0.0.1:" + std::to_string(port));
        const json row = json::parse(r.out, nullptr, false);
        if (row.is_object() && row.contains("value") && there(row["value"].get<double>())) return;
      }
    };
    wait("sim.truth.height_m", [](double h) { return h > 40; });
    pipe.write(axis(2, 8000) + axis(1, -5400) + axis(0, 12000) + axis(7, 32767));  // to the right
  });
  const Said first =
      watched("run " + file.string() + " --speed 4 --duration 200 --log " + log.string(), port);
  over = true;
  pilot.join();
  CHECK_MESSAGE(first.code == 0, first.out);
  CHECK(holds(first.out, "joystick.pilot_present(" + pipe.path() + ")"));

  const Said replayed = typed("replay " + log.string());
  CHECK(replayed.code == 0);
  CHECK(holds(replayed.out, "0 differing bytes"));
  const Said flown = typed("run " + file.string() + " --duration 200 --drivers-from " + log.string() +
                           " --log " + again.string());
  CHECK(flown.code == 0);
  const Said diff = typed("log diff " + log.string() + " " + again.string());
  CHECK_MESSAGE(holds(diff.out, "messages are equal"), diff.out);
}

TEST_CASE("without a joystick the aircraft is not armed, and the pilot is told why") {
  const Pipe pipe;
  const Said r = typed("run " + mission(pipe).string() + " --speed 4 --duration 3 --no-log");
  const std::string fault = std::make_error_code(std::errc::no_such_file_or_directory).message();
  CHECK(holds(r.out, "joystick.pilot_absent(" + pipe.path() + ", " + fault + ")"));
  CHECK(holds(r.out, "hold"));
  CHECK_FALSE(holds(r.out, "takeoff"));
}

}  // namespace flight_test
