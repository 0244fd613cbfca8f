// SPDX-License-Identifier: BSD-3-Clause
// A failed calibration leaves the controller unchanged, or reports its former values.
#include "tools/fulmar_fcu/calibrate.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "captured.hpp"
#include "lossy_port.hpp"
#include "tools/fulmar_fcu/app.hpp"

namespace calibrate_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;
using fulmar::fcu::test::Captured;
using peer::param;

constexpr std::array<float, 3> accel_bias{-0.037f, -0.089f, -0.074f}, gyro_bias{0.008f, -0.002f, 0.001f};

/// A calibrated controller that is shaken.
struct Shaken : Bench {
  bool shaking = true;
  Shaken() {
    firmware.provision();
    for (std::size_t k = 0; k < 3; ++k) {
      firmware.params().set(param("ACC_X_BIAS") + k, accel_bias[k]);
      firmware.params().set(param("GYRO_X_BIAS") + k, gyro_bias[k]);
    }
    firmware.write_flash();
    idle(13'000'000);
    firmware.before_imu = [this] {
      const double phase = 1e-6 * 20 * static_cast<double>(now_us), amount = shaking ? 1 : 0;
      firmware.inputs.accel = {2 * amount * std::sin(phase), 0, -9.80665};
      firmware.inputs.gyro = {-0.0081 * amount, 0.3 * amount, 0};
    };
  }
  Captured calibrate(const char* what) {
    Client c = client();
    c.connect();
    HardwareOptions options;
    options.what = what;
    return Captured([&] { return calibrate_command(c, {}, options); });
  }
  bool as_before() {
    bool same = true;
    for (std::size_t k = 0; k < 3; ++k)
      same = same && firmware.params().f(param("ACC_X_BIAS") + k) == accel_bias[k] &&
             firmware.params().f(param("GYRO_X_BIAS") + k) == gyro_bias[k];
    return same;
  }
};

TEST_CASE(
    "after movement during the calibration of the IMU its six former biases are back, and that is told") {
  Shaken bench;
  const Captured result = bench.calibrate("imu");
  CHECK(result.code == 1);
  CHECK(result.says("fcu.calibration_failed(imu, Too much movement for IMU cal, "));
  CHECK(result.says(", fcu.values_restored)"));
  CHECK(bench.as_before());
  bench.idle(5'000'000);  // no message of the calibration follows
  CHECK(bench.as_before());
  bench.shaking = false;
  const Captured again = bench.calibrate("imu");
  CHECK(again.code == 0);
  CHECK(std::fabs(bench.firmware.params().f(param("ACC_Z_BIAS"))) < 1e-3f);
}

TEST_CASE("former biases that cannot be put back are named, each with its value") {
  for (const bool deaf : {false, true}) {
    CAPTURE(deaf);
    Shaken bench;
    bench.on_command = [&](Frame& frame) {
      if (frame.bytes[5] == ParamSet::id) (deaf ? bench.faults.mute : bench.faults.refuse) = true;
    };
    const Captured result = bench.calibrate("imu");
    CHECK(result.code == 1);
    CHECK(result.says("fcu.values_not_restored(fcu.calibration_failed(imu, "));
    for (const char* line : {"ACC_X_BIAS       -0.037", "ACC_Y_BIAS       -0.089", "ACC_Z_BIAS       -0.074",
                             "GYRO_X_BIAS      0.008", "GYRO_Y_BIAS      -0.002", "GYRO_Z_BIAS      0.001"})
      CHECK_MESSAGE(result.says(line), line);
  }
}

TEST_CASE("a calibration that is interrupted puts the former biases back as well") {
  Shaken bench;
  Client client = bench.client();
  client.connect();
  int asked = 0;
  client.cancelled = [&] { return bench.firmware.params().f(param("ACC_X_BIAS")) == 0 && ++asked > 20; };
  CHECK_THROWS_WITH(calibrate(client, *find_calibration("imu")), "Interrupted.fcu.values_restored");
  CHECK(bench.as_before());
}

TEST_CASE("a refused calibration changes nothing and promises nothing") {
  Shaken bench;
  Client client = bench.client();
  client.connect();
  bench.faults.refuse = true;
  try {
    calibrate(client, *find_calibration("imu"));
    FAIL("it succeeded");
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find("fcu.values_") == std::string::npos);
  }
  CHECK(bench.as_before());
}

/// A controller that zeroes barometer and airspeed while another calibration runs.
Captured just_booted(Bench& bench, std::int64_t up_us, const char* what) {
  bench.firmware.provision();
  bench.idle(up_us);
  Client client = bench.client();
  client.connect();
  HardwareOptions options;
  options.what = what;
  return Captured([&] { return calibrate_command(client, {}, options); });
}

TEST_CASE("the end of another calibration, good or bad, is not taken for the end of this one") {
  Bench booting;
  booting.firmware.inputs.pitot_pa = 3;
  const Captured baro = just_booted(booting, 4'000'000, "baro");  // airspeed is zeroed 7.7 s after the boot
  CHECK(baro.code == 0);
  CHECK(baro.says("-> 85700"));
  CHECK(booting.firmware.params().f(param("BARO_BIAS")) == doctest::Approx(85700).epsilon(1e-6));
  Bench windy;
  windy.firmware.inputs.accel = {0.1, 0, -9.8};
  windy.firmware.before_imu = [&] {
    windy.firmware.inputs.baro_pa = 85700 + 20 * std::sin(3e-6 * static_cast<double>(windy.now_us));
  };
  // the barometer's failure is reported after 10.2 s
  const Captured imu = just_booted(windy, 8'000'000, "imu");
  CHECK(imu.code == 0);
  CHECK(imu.complaint == "");
}

}  // namespace

}  // namespace calibrate_test
