// SPDX-License-Identifier: BSD-3-Clause
// The program itself, on a pseudo-terminal with a controller behind it, in real time.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>

#include "plugins/fcu_serial/test/device.hpp"

namespace cli_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::testing::Device;
using fulmar::fcu::testing::Pty;

struct Run {
  std::string out;
  int code = -1;
  explicit Run(const std::string& arguments) {
    const std::string line = "timeout 30 " FULMAR_BIN_DIR "/fulmar-fcu " + arguments + " 2>&1 </dev/null";
    std::FILE* pipe = ::popen(line.c_str(), "r");
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
    const int status = ::pclose(pipe);
    code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool says(const std::string& part) const { return out.find(part) != std::string::npos; }
};

struct Controller {
  peer::Firmware firmware;
  Device device;
  Controller() : device([this](Pty& pty) { testing::serve(firmware, pty); }) {
    device.change([this](Pty&) { firmware.provision(testing::wall_us()); });
  }
  Run run(const std::string& arguments) const { return Run("--port " + device.name() + " " + arguments); }
};

TEST_CASE("status, parameters and the check over a terminal line, as a user types them") {
  Controller controller;
  const Run status = controller.run("status");
  CHECK(status.code == 0);
  CHECK(status.says("ROSflight v2.0.1"));
  CHECK(status.says("disarmed"));
  CHECK(controller.run("version").out == "v2.0.1-0-ge8cf6a0f\n");
  const std::string name = "RC_ARM_CHN", lower = "rc_arm_chn";
  CHECK(controller.run("params get " + lower).out == "4\n");
  const Run list = controller.run("params list --json");
  CHECK(nlohmann::json::parse(list.out).size() == 333);
  CHECK(controller.run("params set " + name + " 6").says("fcu.param_set(RC_ARM_CHN, 4, 6)"));
  CHECK(nlohmann::json::parse(controller.run("--json params get " + name).out)["value"] == 6);
  CHECK(controller.run("params set " + name + " 1.5").code == 1);
  CHECK(controller.run("mixer").says("elevator"));
  CHECK(controller.run("check").says("FAIL"));
  CHECK(controller.run("test-outputs").says("fcu.confirmation_required(--propeller-off, once it is)"));
  CHECK(controller.run("calibrate mag").says("fcu.terminal_required"));
}

TEST_CASE("wrong usage ends with 2, and a device that is not there with 1") {
  CHECK(Run("").code == 2);
  CHECK(Run("params get").code == 2);
  CHECK(
      Run("statsu").says("fcu.subcommand_unknown(, statsu,  [status] status, version, params, calibrate, "
                         "check, bench, mixer, test-outputs, reboot)"));
  CHECK(Run("calibrate gro")
            .says("fcu.subcommand_unknown( calibrate, gro,  [gyro] imu, gyro, rc, baro, airspeed, mag)"));
  CHECK(Run("statsu").code == 2);
  CHECK(Run("--baud 17 status").code == 2);
  CHECK(Run("--help").code == 0);
  for (const char* command : {"status", "version", "params list", "params get", "params set", "params write",
                              "params save", "params load", "params diff", "calibrate imu", "calibrate mag",
                              "check", "mixer", "test-outputs", "reboot"}) {
    const Run help(std::string(command) + " --help");
    CAPTURE(help.out);
    CHECK(help.code == 0);
    CHECK(help.says("Example: fulmar fcu " + std::string(command)));
    CHECK(help.out.find("Example", help.out.find("Example") + 1) == std::string::npos);
    CHECK_FALSE(
        std::regex_search(help.out, std::regex("REQUIRED *\n")));  // each positional has a word of help
  }
  const Run missing("--port /dev/ttyNOWHERE status");
  CHECK(missing.code == 1);
  CHECK(missing.says("port.device_missing(/dev/ttyNOWHERE, "));
  CHECK(std::count(missing.out.begin(), missing.out.end(), '\n') == 1);
}

TEST_CASE("a reboot that unplugs the device, as USB does, is seen through to its end") {
  peer::Firmware firmware;
  std::uint32_t boots = 0;
  Device device([&](Pty& pty) {
    testing::serve(firmware, pty);
    if (boots != 0 && firmware.boots() != boots) {
      pty.pull();
      testing::pause_us(500000);
      pty.plug();
    }
    boots = firmware.boots();
  });
  device.change([&](Pty&) {
    firmware.provision(testing::wall_us());
    boots = firmware.boots();
  });
  testing::pause_us(3000000);  // it has been up for longer than it will be unplugged, which shows the restart
  const Run reboot("--port " + device.name() + " reboot");
  CAPTURE(reboot.out);
  CHECK(reboot.code == 0);
  CHECK(reboot.says("Rebooted."));
}

TEST_CASE("a device that is pulled out ends what is under way with a sentence") {
  Controller controller;
  std::thread pull([&] {
    testing::pause_us(2000000);
    controller.device.change([](Pty& pty) { pty.pull(); });
  });
  const Run status = controller.run("status --watch");
  pull.join();
  CHECK(status.code == 1);
  CHECK(status.says("port.device_lost(" + controller.device.name() + ")"));
}

TEST_CASE("a port that another program holds is told with its name") {
  Controller controller;
  std::thread first([&] { controller.run("calibrate baro"); });
  testing::pause_us(1000000);
  const Run second = controller.run("status");
  CHECK(second.code == 1);
  CHECK(second.says("port.port_in_use(" + controller.device.name() + ", another program, "));
  first.join();
}

}  // namespace

}  // namespace cli_test
