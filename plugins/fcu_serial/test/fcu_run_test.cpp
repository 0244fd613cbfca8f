// SPDX-License-Identifier: BSD-3-Clause
// `fulmar run --io fcu` with different devices.
#include <doctest/doctest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "device.hpp"

namespace fcu_run_test {

using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;

namespace {

struct Result {
  int code = -1;
  std::string said;
  double seconds = 0;
  bool says(const std::string& message) const { return said.find(message) != std::string::npos; }
};

/// The hourglass with this port.
Result fly(const std::string& port, const std::string& more = "") {
  const std::string command = "timeout -k 1 90 " FULMAR_BIN_DIR "/fulmar run " FULMAR_SOURCE_DIR
                              "/configs/missions/hourglass.yaml --io fcu --no-log --set fcu.port=" +
                              port + " " + more + " 2>&1";
  Result r;
  const std::int64_t begun = wall_us();
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), pipe)) r.said += line.data();
  const int status = pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  r.seconds = 1e-6 * static_cast<double>(wall_us() - begun);
  return r;
}

void refused(const Result& r, const std::string& code, const std::string& arguments) {
  CAPTURE(r.said);
  CHECK(r.code == 4);
  CHECK(r.says(code));
  CHECK(r.says(arguments));
  CHECK(r.seconds < 50);  // ten times the bar
}

}  // namespace

TEST_CASE("no device") {
  const std::string port = "/dev/ttyFulmar9";
  refused(fly(port), "--set fcu.port=" + port + ": fcu: port: port.device_missing(", port);
}

TEST_CASE("a silent device") {
  Device device([](Pty&) { pause_us(10000); });
  refused(fly(device.name()), "fcu_serial.device_silent(", device.name() + ")");
}

TEST_CASE("bytes of another baud rate") {
  std::uint32_t x = 12345;
  Device device([&x](Pty& pty) {
    std::array<std::uint8_t, 100> noise{};
    for (auto& b : noise) b = static_cast<std::uint8_t>((x = x * 1664525 + 1013904223) >> 24);
    pty.write(noise);
    pause_us(2000);
  });
  refused(fly(device.name(), "--set fcu.baud=115200"), "fcu_serial.frames_missing_at_baud(",
          ", " + device.name() + ", 115200)");
}

TEST_CASE("a satellite receiver") {
  Device device([](Pty& pty) {
    const std::string line = "$GNGGA,120000.00,4014.782,N,11138.845,W,1,12,0.8,1387.0,M,-17,M,,*5B\r\n";
    pty.write({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
    pause_us(20000);
  });
  refused(fly(device.name()), "fcu_serial.text_received(", device.name() + ")");
}

TEST_CASE("an old firmware") {
  peer::Options options;
  options.version = "v1.3.1";
  peer::Firmware fcu(options);
  fcu.provision(wall_us());
  Device device([&fcu](Pty& pty) { serve(fcu, pty); });
  refused(fly(device.name()), "fcu_serial.firmware_too_old(", device.name() + ", v1.3.1)");
}

TEST_CASE("a controller that is no fixed wing") {
  peer::Firmware fcu;
  fcu.reboot(wall_us());
  Device device([&fcu](Pty& pty) { serve(fcu, pty); });
  refused(fly(device.name()), "fcu_serial.not_fixed_wing(", device.name() + ")");
}

TEST_CASE("another autopilot") {
  Device device([](Pty& pty) {
    Heartbeat beat;
    beat.autopilot = 3;
    pty.write(encode(beat, 0, 1, 1).view());
    pause_us(100000);
  });
  refused(fly(device.name()), "fcu_serial.other_autopilot(", device.name() + ", 3)");
}

TEST_CASE("a controller: it is flown for as long as was asked, armed by its pilot, unplugged and back") {
  peer::Firmware fcu;
  fcu.provision(wall_us());
  std::int64_t begun = 0;  // of the commands
  bool pulled = false, back = false;
  Device device([&](Pty& pty) {
    if (begun == 0 && fcu.commands() > 0) begun = wall_us();
    const std::int64_t t = begun == 0 ? 0 : wall_us() - begun;
    fcu.inputs.rc_us[4] =
        t > 1'000'000 && t < 6'500'000 ? 2000 : 1000;  // the flight does not end while it is armed
    fcu.inputs.rc_us[5] = t > 1'000'000 && t < 1'500'000 ? 2000 : 1000;
    if (!pulled && t > 4'000'000) {
      pty.pull();
      pulled = true;
    }
    if (!back && t > 5'000'000) {
      pty.plug();
      back = true;
    }
    serve(fcu, pty);
  });
  const Result r = fly(device.name(), "--duration 7");
  CAPTURE(r.said);
  CHECK(r.code == 0);
  CHECK(r.says("hourglass: flown: score.never_airborne (duration reached)"));
  CHECK(back);
  CHECK(fcu.commands() >
        100);  // 20 Hz and more in the 6 s with a cable; how many come in a tick's time is shown elsewhere
  for (const char* words : {"fcu_serial.connected(v2.0.1", "fcu: fcu_serial.armed",
                            "fcu_serial.pilot_flies(fcu_serial.attitude_switch, fcu_serial.throttle_switch)",
                            "fcu_serial.pilot_hands_over", "fcu_serial.in_control", "fcu_serial.device_gone",
                            "fcu_serial.controller_back(1.", "fcu_serial.disarmed"}) {
    CAPTURE(words);
    CHECK(r.says(words));
  }
}

TEST_CASE(
    "a host that is killed in the air after a reboot of its controller: the next one uses no pitot either") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("fulmar-fcu-run-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  peer::Firmware fcu;
  fcu.provision(wall_us());
  std::int64_t begun = 0;  // of the commands
  bool crashed = false;
  std::atomic<bool> landed{false};
  Device device([&](Pty& pty) {
    if (begun == 0 && fcu.commands() > 0) begun = wall_us();
    const std::int64_t t = begun == 0 ? 0 : wall_us() - begun;
    fcu.inputs.rc_us[4] = t > 500'000 && !landed ? 2000 : 1000;
    fcu.inputs.rc_us[5] = t > 500'000 && t < 1'000'000 ? 2000 : 1000;
    if (!crashed && t > 2'000'000) {
      fcu.crash(wall_us());
      crashed = true;  // it arms itself again
    }
    serve(fcu, pty);
  });
  const std::string run = FULMAR_BIN_DIR "/fulmar run " FULMAR_SOURCE_DIR
                                         "/configs/missions/hourglass.yaml --io fcu --set fcu.port=" +
                          device.name();
  const std::string script = "cd " + folder.string() + " && timeout -s KILL 12 " + run +
                             " 2>&1; echo killed; timeout -s TERM -k 9 6 " + run + " 2>&1";
  Result r;
  FILE* pipe = popen(script.c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), pipe)) {
    r.said += line.data();
    if (r.says("killed") && r.said.find("run.resumed(") != std::string::npos) landed = true;
  }
  pclose(pipe);
  std::filesystem::remove_all(folder);
  CAPTURE(r.said);
  CHECK(crashed);
  const std::size_t killed = r.said.find("killed");
  REQUIRE(killed != std::string::npos);
  const std::string first = r.said.substr(0, killed), second = r.said.substr(killed);
  CHECK(first.find("fcu_serial.pitot_zeroed_in_flight") != std::string::npos);
  CHECK(second.find("manage.first_item = 0, fcu.pitot_zeroed = 1") != std::string::npos);
  CHECK(second.find("fcu_serial.pitot_zeroed_in_flight") != std::string::npos);
  CHECK(second.find("fcu_serial.ready_but(missing.right_airspeed_zero") !=
        std::string::npos);  // once it is disarmed
}

namespace {

/// The thread of this name in a process; -1: none.
pid_t thread_of(pid_t process, const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm") >> std::ws, found);
    if (found == name) return std::stoi(task.path().filename().string());
  }
  return -1;
}

}  // namespace

TEST_CASE("a crash of the thread that reads the port is told, and the controller gets the last frame") {
  if (!FULMAR_CRASH_TESTS) return;  // a sanitized build handles crashes by itself
  const std::filesystem::path mission =
      std::filesystem::temp_directory_path() / ("fulmar-fcu-run-" + std::to_string(getpid()) + ".yaml");
  const std::string configs = FULMAR_SOURCE_DIR "/configs/";
  std::ofstream(mission) << "mission: last_frame\nextends: " << configs
                         << "missions/common.yaml\nairframe: " << configs
                         << "airframes/anaconda.yaml\nfailsafe: {throttle_frac: 0.25, for: 2 s}\n"
                         << "origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
                         << "components:\n  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n";
  peer::Firmware fcu;
  fcu.provision(wall_us());
  std::string said;
  bool reported = false;
  {
    std::atomic<std::uint64_t> commands{0};
    Device device([&](Pty& pty) {
      serve(fcu, pty);
      commands = fcu.commands();
      reported = reported || fcu.last_command().u[0] == 0.25f;
    });
    const std::string command = "echo $$; exec " FULMAR_BIN_DIR "/fulmar run " + mission.string() +
                                " --io fcu --no-log --set fcu.port=" + device.name() + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe);
    std::array<char, 512> line{};
    REQUIRE(std::fgets(line.data(), line.size(), pipe));
    const pid_t host = std::atoi(line.data());
    bool hit = false;
    while (std::fgets(line.data(), line.size(), pipe)) {
      said += line.data();
      if (hit || said.find("run.phase_entered(hold)") == std::string::npos) continue;
      while (commands < 20) pause_us(10'000);
      const pid_t thread = thread_of(host, "fulmar-fcu");
      hit = thread > 0 && syscall(SYS_tgkill, host, thread, SIGSEGV) == 0;
    }
    const int status = pclose(pipe);
    CAPTURE(said);
    CHECK(hit);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGSEGV);
    CHECK(said.find("app.host_crashed(segmentation fault)") != std::string::npos);
    pause_us(300'000);  // the frame is on its way
  }
  CHECK(reported);
  std::filesystem::remove(mission);
}

}  // namespace fcu_run_test
