// SPDX-License-Identifier: BSD-3-Clause
// Every command with a link that rejects, delays, drops, duplicates and corrupts: it succeeds, and its report
// is correct; or it reports its failure in one sentence. It never hangs.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <regex>

#include "captured.hpp"
#include "lossy_port.hpp"
#include "tools/fulmar_fcu/app.hpp"

namespace faults_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;
using fulmar::fcu::test::Captured;
using fulmar::fcu::test::Faults;
using peer::param;

struct Named {
  const char* name;
  Faults faults;
};
const std::vector<Named> all_faults{{"none", {}},
                                    {"delays 50 ms", {0, 0, 0, 50000}},
                                    {"delays 300 ms", {0, 0, 0, 300000}},
                                    {"drops 5 %", {0.05, 0, 0, 0}},
                                    {"drops 30 %", {0.3, 0, 0, 0}},
                                    {"duplicates half", {0, 0.5, 0, 0}},
                                    {"corrupts 5 %", {0, 0, 0.05, 0}},
                                    {"does it all", {0.05, 0.1, 0.05, 20000}},
                                    {"refuses", {0, 0, 0, 0, true}},
                                    {"is deaf", {0, 0, 0, 0, false, true}}};

/// A command, and the required state of the controller after a success.
struct Case {
  const char* name;
  std::function<int(Client&)> run;
  std::function<bool(Bench&)> done;
  std::function<void(Bench&)> prepare = {};
};

double real(Bench& bench, std::size_t id) { return static_cast<double>(bench.firmware.params().f(id)); }
bool near(double a, double b) { return std::fabs(a - b) < 1e-4 * (1 + std::fabs(b)); }
bool three(Bench& bench, std::size_t id, double x, double y, double z) {
  return near(real(bench, id), x) && near(real(bench, id + 1), y) && near(real(bench, id + 2), z);
}

std::string temporary(const char* name) {
  return (std::string("/tmp/fulmar_fcu_test_") + std::to_string(::getpid()) + "_") + name;
}

const struct Cleanup {
  ~Cleanup() {
    for (const char* name : {"load.yaml", "save.yaml"}) std::remove(temporary(name).c_str());
  }
} cleanup;

HardwareOptions calibrating(const char* what) {
  HardwareOptions h;
  h.what = what;
  return h;
}

ParamsOptions setting(const char* name, const char* value, bool write = false) {
  ParamsOptions p;
  p.name = name;
  p.value = value;
  p.write = write;
  return p;
}

Options sure() {
  Options o;
  o.yes = true;
  return o;
}

ParamsOptions file(const std::string& path) {
  ParamsOptions p;
  p.file = path;
  p.replace = true;
  return p;
}

/// After a power cycle.
std::int32_t kept(Bench& bench, std::size_t id) {
  bench.firmware.reboot(bench.now_us);
  return bench.firmware.params().i(id);
}

std::vector<Case> cases() {
  const Options o;
  const std::string load = temporary("load.yaml"), save = temporary("save.yaml");
  std::ofstream(load) << "RC_OVRD_DEV: 0.25\nPRIMARY_MIXER: 10\nRC_ARM_CHN: 6\nPRI_MIXER_4_1: -0.5\n";
  const auto always = [](Bench&) { return true; };
  return {
      {"status", [=](Client& c) { return status_command(c, o, true); }, always},
      {"version", [=](Client& c) { return version_command(c, o); }, always},
      {"params list", [=](Client& c) { return params_list(c, o, {}); }, always},
      {"params get", [=](Client& c) { return params_get(c, o, setting("RC_ARM_CHN", "")); }, always},
      {"params set", [=](Client& c) { return params_set(c, o, setting("RC_ARM_CHN", "-1")); },
       [](Bench& b) { return b.firmware.params().i(param("RC_ARM_CHN")) == -1; }},
      {"params set --write", [=](Client& c) { return params_set(c, o, setting("RC_ARM_CHN", "6", true)); },
       [](Bench& b) { return kept(b, param("RC_ARM_CHN")) == 6; }},
      {"params write", [=](Client& c) { return params_write(c, o); },
       [](Bench& b) { return kept(b, param("RC_NUM_CHN")) == 7; },
       [](Bench& b) { b.firmware.params().set(param("RC_NUM_CHN"), 7); }},
      {"params save", [=](Client& c) { return params_save(c, o, file(save)); },
       [=](Bench&) { return std::ifstream(save).good(); }},
      {"params diff", [=](Client& c) { return params_diff(c, o, file(load)) == 1 ? 0 : 1; }, always},
      {"params load", [=](Client& c) { return params_load(c, sure(), file(load)); },
       [](Bench& b) {
         return b.firmware.params().i(param("PRIMARY_MIXER")) == 10 &&
                b.firmware.params().i(param("RC_ARM_CHN")) == 6 && near(real(b, param("RC_OVRD_DEV")), 0.25);
       }},
      {"calibrate imu", [=](Client& c) { return calibrate_command(c, o, calibrating("imu")); },
       [](Bench& b) {
         return three(b, param("ACC_X_BIAS"), 0.1, -0.2, 0.10665) &&
                three(b, param("GYRO_X_BIAS"), 0.01, -0.02, 0.03);
       }},
      {"calibrate gyro", [=](Client& c) { return calibrate_command(c, o, calibrating("gyro")); },
       [](Bench& b) { return three(b, param("GYRO_X_BIAS"), 0.01, -0.02, 0.03); }},
      {"calibrate rc", [=](Client& c) { return calibrate_command(c, o, calibrating("rc")); },
       [](Bench& b) { return real(b, param("X_EQ_TORQUE")) > 0.039; }},
      {"calibrate baro", [=](Client& c) { return calibrate_command(c, o, calibrating("baro")); },
       [](Bench& b) { return near(real(b, param("BARO_BIAS")), 85700); }},
      {"calibrate airspeed", [=](Client& c) { return calibrate_command(c, o, calibrating("airspeed")); },
       [](Bench& b) { return near(real(b, param("DIFF_PRESS_BIAS")), 12); }},
      {"reboot", [=](Client& c) { return reboot_command(c, o); },
       [](Bench& b) { return b.firmware.clock_us() + 10'000'000 < b.now_us; }},
      {"mixer", [=](Client& c) { return mixer_command(c, o); }, always},
      {"test-outputs",
       [=](Client& c) {
         HardwareOptions h;
         h.propeller_off = true;
         return outputs_command(c, o, h);
       },
       [](Bench& b) { return b.firmware.commands() > 300; }},
  };
}

void prepare(Bench& bench, const Case& what) {
  bench.firmware.provision();
  bench.firmware.inputs.accel = {0.1, -0.2, -9.7};
  bench.firmware.inputs.gyro = {0.01, -0.02, 0.03};
  bench.firmware.inputs.pitot_pa = 12;
  bench.firmware.inputs.rc_us[0] = 1520;
  bench.idle(13'000'000);  // its own zeroing after boot is over
  if (what.prepare) what.prepare(bench);
}

TEST_CASE("every command through every fault succeeds truly or says that it did not") {
  int successes = 0;
  for (const Case& what : cases()) {
    for (const Named& fault : all_faults) {
      const std::string name = what.name, link = fault.name;
      CAPTURE(name);
      CAPTURE(link);
      Bench bench;
      prepare(bench, what);
      Client client = bench.client();
      client.connect();
      bench.faults = fault.faults;
      const std::int64_t before_us = bench.now_us;
      const Captured result([&] { return what.run(client); });
      CHECK(bench.now_us - before_us < 60'000'000);
      CAPTURE(result.out);
      CAPTURE(result.complaint);
      const bool good = result.code == 0 && result.complaint.empty();
      if (link == "none" || link == "drops 5 %" || link == "delays 50 ms") CHECK(good);
      bench.faults = {};
      bench.idle(1'000'000);
      if (good) {
        CHECK(what.done(bench));
        ++successes;
      } else if (result.complaint.empty()) {
        CHECK(result.code == 1);
      } else {
        CHECK(result.complaint.find('\n') == std::string::npos);
        CHECK(std::regex_match(result.complaint, std::regex("fcu\\.[a-z_]+(\\(.*\\))?")));
        CHECK(result.complaint.size() < 250);
      }
    }
  }
  MESSAGE(successes << " of " << cases().size() * all_faults.size() << " succeeded");
}

TEST_CASE("a device that comes through a fault is met, or its silence is told within 5 s") {
  for (const Named& fault : all_faults) {
    CAPTURE(fault.name);
    Bench bench;
    bench.firmware.provision();
    bench.faults = fault.faults;
    Client client = bench.client();
    const Captured result([&] {
      client.connect();
      return 0;
    });
    CHECK(bench.now_us < 5'000'000);
    CHECK(result.complaint.empty() == !fault.faults.mute);
  }
}

TEST_CASE("what moves or changes an armed aircraft is refused before anything is sent") {
  for (const Case& what : cases()) {
    const std::string name = what.name;
    if (name == "status" || name == "params list" || name == "params get" || name == "params save" ||
        name == "params diff" || name == "mixer")
      continue;
    CAPTURE(name);
    Bench bench;
    prepare(bench, what);
    bench.firmware.inputs.rc_us = {1500, 1500, 1000, 1500, 2000, 2000, 1000, 1000};
    bench.idle(2'000'000);
    REQUIRE(bench.firmware.armed());
    Client client = bench.client();
    client.connect();
    int sent = 0;
    bench.on_command = [&](Frame& f) {
      sent +=
          f.bytes[5] == RosflightCmd::id || f.bytes[5] == ParamSet::id || f.bytes[5] == OffboardControl::id;
    };
    const Captured result([&] { return what.run(client); });
    CHECK(sent == 0);
    CHECK(std::regex_search(result.complaint, std::regex("^fcu\\.(aircraft_armed|version_while_armed)")));
  }
}

}  // namespace

}  // namespace faults_test
