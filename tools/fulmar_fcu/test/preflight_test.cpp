// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/preflight.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "captured.hpp"
#include "lossy_port.hpp"
#include "plugins/fcu_serial/firmware_version.hpp"
#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/mixer.hpp"
#include "tools/fulmar_fcu/radio.hpp"

namespace preflight_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;
using fulmar::fcu::test::Captured;
using peer::param;

/// A controller as it stands on the field, ready.
struct Ready : Bench {
  Ready() {
    firmware.params().set(param("MAG_X_BIAS"), 1e-6f);
    firmware.provision();
    firmware.inputs.rc_us = {1500, 1500, 1000, 1500, 1000, 2000, 1000, 1000};
    firmware.params().set(param("RC_OVRD_DEV"), 0.1f);
    firmware.inputs.battery_volt = 24;
    idle(15'000'000);
  }
  Facts facts() {
    Client c = client();
    c.connect();
    Facts f = gather(c, 921600);
    f.airframe = read_airframe("configs/airframes/anaconda.yaml");
    return f;
  }
};

Facts ready() {
  static const Facts facts = Ready().facts();
  return facts;
}

void set(Facts& f, const std::string& name, double value) {
  for (Param& p : f.params)
    if (p.name == name)
      p.bits = p.whole ? std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value))
                       : std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::string verdicts(const Facts& f, Verdict wanted) {
  std::string out;
  for (const Item& item : judge(f))
    if (item.verdict == wanted) out += item.name + ": " + item.text + "\n";
  return out;
}
bool fails(const Facts& f, const std::string& part) {
  return verdicts(f, Verdict::fail).find(part) != std::string::npos;
}
bool warns(const Facts& f, const std::string& part) {
  return verdicts(f, Verdict::warn).find(part) != std::string::npos;
}

TEST_CASE("a controller that is ready has neither a FAIL nor a WARN") {
  const Facts f = ready();
  CHECK(verdicts(f, Verdict::fail) == "");
  CHECK(verdicts(f, Verdict::warn) == "");
  CHECK(items_text(judge(f)).find("0 FAIL, 0 WARN") != std::string::npos);
  CHECK(f.imu_hz == doctest::Approx(400).epsilon(0.01));
  CHECK(f.rc_hz == doctest::Approx(111).epsilon(0.02));
  CHECK(f.bytes_per_s == doctest::Approx(48900).epsilon(0.02));
}

TEST_CASE("each thing that is wrong is told, with its parameter") {
  const auto with = [](const std::function<void(Facts&)>& change) {
    Facts f = ready();
    change(f);
    return f;
  };
  const auto param_is = [&](const char* name, double value) {
    return with([&](Facts& f) { set(f, name, value); });
  };
  CHECK(fails(param_is("FIXED_WING", 0), "aircraft: fcu.multirotor_configured"));
  CHECK(fails(with([](Facts& f) { f.attitude->q1 = std::nanf(""); }), "attitude: fcu.attitude_not_finite"));
  CHECK(fails(with([](Facts& f) { f.attitude->rollspeed = std::nanf(""); }), "attitude"));
  CHECK(fails(param_is("RC_F_AXIS", 2), "fcu.throttle_axis_invalid(2)"));
  CHECK(fails(param_is("PRIMARY_MIXER", 255), "fcu.mixer_missing(255)"));
  CHECK_FALSE(warns(with([](Facts& f) {  // one message is enough: without a mixer no surface follows
                      for (Param& p : f.params)
                        if (p.name.rfind("PRI_MIXER_", 0) == 0 || p.name.rfind("SEC_MIXER_", 0) == 0)
                          p.bits = 0;
                      set(f, "PRIMARY_MIXER", 255);
                    }),
                    "mixer"));
  CHECK(fails(param_is("PRIMARY_MIXER", 2), "fcu.mixer_of_multirotor(2)"));
  CHECK(fails(param_is("PRI_MIXER_OUT_4", 1), "fcu.output_kind_wrong(4, throttle, servo, 2)"));
  CHECK(fails(param_is("PRI_MIXER_OUT_1", 2), "fcu.output_kind_wrong(1, elevator, motor, 1)"));
  CHECK(fails(param_is("OFFBOARD_TIMEOUT", 50), "OFFBOARD_TIMEOUT is 50 ms: fcu.timeout_too_short"));
  CHECK(warns(param_is("OFFBOARD_TIMEOUT", 2000), "OFFBOARD_TIMEOUT is 2000 ms: fcu.timeout_too_long"));
  CHECK(fails(param_is("RC_ATT_OVRD_CHN", 2), "fcu.override_switch_missing(2, 7)"));
  CHECK(fails(param_is("RC_THR_OVRD_CHN", 8), "fcu.throttle_switch_missing(8, 7)"));
  CHECK(fails(param_is("RC_ARM_CHN", 5), "fcu.switch_shared"));
  CHECK(fails(param_is("RC_ARM_CHN", 9), "fcu.arm_channel_invalid(9, 7)"));
  CHECK(fails(param_is("RC_Y_CHN", 0), "fcu.sticks_on_one_channel(1)"));
  CHECK(warns(param_is("TAKE_MIN_THR", 1), "fcu.throttle_limited_by_pilot"));
  CHECK(warns(param_is("X_EQ_TORQUE", 0.5), "fcu.trim_too_large(X_EQ_TORQUE, 0.50)"));
  for (const double pascal : {177.0, -31.0})
    CHECK(warns(param_is("DIFF_PRESS_BIAS", pascal),
                "airspeed: fcu.pitot_zero_implausible(" + std::to_string(static_cast<int>(pascal)) + ")"));
  CHECK_FALSE(warns(param_is("DIFF_PRESS_BIAS", 29), "airspeed"));
  CHECK(fails(with([](Facts& f) { f.status.armed = 1; }), "disarmed: fcu.controller_armed"));
  CHECK(warns(with([](Facts& f) { f.version = ""; }), "fcu.version_withheld"));
  CHECK(fails(with([](Facts& f) { f.status.error_code = error_rc_lost; }), "radio lost"));
  CHECK(fails(with([](Facts& f) {
                for (const char* n : {"ACC_X_BIAS", "GYRO_X_BIAS"}) set(f, n, 0);
              }),
              "IMU: fcu.imu_not_calibrated"));
  CHECK(fails(with([](Facts& f) { f.rc_hz = 0; }), "radio: fcu.radio_frames_absent"));
  CHECK(warns(with([](Facts& f) { f.rc_hz = 20; }), "fcu.radio_rate_low(20)"));
  CHECK(fails(with([](Facts& f) { f.rc->chan5_raw = 2000; }), "arm switch: fcu.arm_switch_on"));
  CHECK(warns(with([](Facts& f) { f.rc->chan6_raw = 1000; }), "fcu.override_switch_off"));
  CHECK(warns(with([](Facts& f) { f.rc->chan3_raw = 1500; }), "fcu.throttle_stick_up(50)"));
  CHECK(fails(with([](Facts& f) { f.gnss->fix_type = 2; }), "GNSS: fcu.fix_missing(2D fix, "));
  CHECK(fails(with([](Facts& f) { f.gnss.reset(); }), "GNSS: fcu.receiver_silent"));
  CHECK(fails(with([](Facts& f) { f.battery->battery_voltage = 19; }), "fcu.battery_low(19.0, 24.0)"));
  CHECK(fails(with([](Facts& f) { f.loss_ratio = 0.1; }), "10.00 % of the frames lost: fcu.frame_loss_high"));
  CHECK(warns(with([](Facts& f) { f.baud = 460800; }), "106 % of 460800 baud: fcu.line_load_high"));
  CHECK(fails(with([](Facts& f) { f.round_trip_s.reset(); }), "round trip: fcu.round_trip_missing"));
  CHECK(warns(with([](Facts& f) { f.round_trip_s = 0.02; }), "20.00 ms: fcu.round_trip_long"));
  CHECK(fails(with([](Facts& f) { f.imu_hz = 50; }), "fcu.imu_rate_too_low(50)"));
}

TEST_CASE("gravity and rest are measured for 2 s, and what a failed calibration leaves is seen") {
  Ready bench;
  CHECK(verdicts(bench.facts(), Verdict::ok).find("IMU: fcu.imu_calibrated(9.81, 0.00)") !=
        std::string::npos);
  bench.firmware.inputs.gyro = {0.0161, 0, 0};  // the mean of shaken seconds was taken for its bias
  CHECK(warns(bench.facts(), "IMU: fcu.rotation_at_rest(0.92)"));
  bench.firmware.inputs.gyro = {0, 0.1, 0};
  CHECK(fails(bench.facts(), "IMU: fcu.rotation_at_rest(5.73)"));
  bench.firmware.inputs.gyro = {};
  bench.firmware.inputs.accel = {0, 0, -10.05};
  CHECK(warns(bench.facts(), "IMU: fcu.gravity_implausible(10.05)"));
  bench.firmware.inputs.accel = {3, 0, -11};
  CHECK(fails(bench.facts(), "IMU: fcu.gravity_implausible(11.40)"));
  bench.firmware.inputs.accel = {4.9033, 0, -8.4928};  // at rest, though not level
  CHECK(verdicts(bench.facts(), Verdict::ok).find("IMU: fcu.imu_calibrated(9.81, ") != std::string::npos);
}

TEST_CASE("an aircraft that is moved is told so, and not that it is uncalibrated") {
  Ready bench;
  bench.firmware.before_imu = [&] {
    const double phase = 2e-5 * static_cast<double>(bench.now_us);
    bench.firmware.inputs.accel = {4 * std::sin(phase), 0, -9.80665};
    bench.firmware.inputs.gyro = {0.5 * std::sin(phase), 0, 0};
  };
  const Facts f = bench.facts();
  CHECK(warns(f, "IMU: fcu.aircraft_in_motion(2.8, 20)"));
  CHECK(verdicts(f, Verdict::fail) == "");
}

TEST_CASE("three biases of exactly zero are a failed calibration, though the other three stand") {
  Facts f = ready();
  set(f, "ACC_X_BIAS", 0);
  CHECK(fails(f, "IMU: fcu.biases_zero(ACC_X_BIAS, ACC_Y_BIAS and ACC_Z_BIAS): fcu.imu_not_calibrated"));
  f = ready();
  set(f, "GYRO_X_BIAS", 0);
  CHECK(fails(f, "IMU: fcu.biases_zero(GYRO_X_BIAS, GYRO_Y_BIAS and GYRO_Z_BIAS): fcu.imu_not_calibrated"));
  set(f, "ARM_CAL_GYRO", 1);  // the firmware does it at each arming
  CHECK_FALSE(fails(f, "IMU"));
}

TEST_CASE("a firmware that was not tried is a WARN that names the one that was") {
  Facts f = ready();
  CHECK(verdicts(f, Verdict::ok).find("firmware: fcu.firmware_tested(v2.0.1-0-ge8cf6a0f)") !=
        std::string::npos);
  for (const char* version : {"v2.0.1", "2.0.1-12-gabcdef0", "v2.0.1-dirty"}) {
    f.version = version;
    CHECK_MESSAGE(verdicts(f, Verdict::warn) == "", version);
  }
  for (const char* version :
       {"v3.1", "v2.0.0", "v2.0.10", "v2.1.1", "2.0", "e8cf6a0", "undefined", "without a version"}) {
    f.version = version;
    CHECK_MESSAGE(warns(f, "firmware: fcu.firmware_untested(" + f.version + ", 2.0.1)"), version);
  }
}

TEST_CASE("the manual names the firmware that was tried") {
  std::ifstream file("docs/hardware.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  CHECK(manual.find("ROSflight firmware " + std::string(tried_firmware)) != std::string::npos);
}

TEST_CASE("a reversal counts once: in the firmware or in the airframe file") {
  Facts f = ready();
  set(f, "REV_ELEVATOR", 1);
  CHECK(verdicts(f, Verdict::fail) == "");
  CHECK(verdicts(f, Verdict::ok).find("elevator: reversed") != std::string::npos);
  f.airframe->elevator.reversed = true;
  CHECK(fails(f, "fcu.surface_reversed_twice(REV_ELEVATOR, elevator)"));
  set(f, "REV_ELEVATOR", 0);
  CHECK(warns(f, "fcu.reversal_in_file(elevator, REV_ELEVATOR)"));
}

TEST_CASE("the doubled gain of the secondary V-tail is seen") {
  Ready bench;
  bench.firmware.params().set(param("PRIMARY_MIXER"), 10);
  bench.firmware.params().set(param("SECONDARY_MIXER"), 10);
  const Facts f = bench.facts();
  CHECK(warns(f, ", fcu.v_tail_gain_doubled)"));
  bench.firmware.params().set(param("SECONDARY_MIXER"), 255);
  CHECK(verdicts(bench.facts(), Verdict::warn) == "");
  const Mixer m = mixer_of(bench.facts().params);
  CHECK(output_words(m, 0) == "aileron");
  CHECK(output_words(m, 1) == "elevator and rudder");
  CHECK(output_words(m, 2) == "elevator and rudder");
  CHECK(output_words(m, 4) == "motor");
  CHECK(output_words(m, 7) == "not used");
}

TEST_CASE("switches are on and off as the firmware has it") {
  RadioMap map;
  map.channels = 8;
  map.channel = {4, 5, 6};
  map.turned = {false, true, false};
  RcChannels rc;
  rc.chan5_raw = 1800;
  rc.chan6_raw = 1199;
  rc.chan7_raw = 1799;
  CHECK(map.on(RadioMap::arm, rc));
  CHECK(map.on(RadioMap::attitude_override, rc));
  CHECK_FALSE(map.on(RadioMap::throttle_override, rc));
  rc.chan6_raw = 1200;
  CHECK_FALSE(map.on(RadioMap::attitude_override, rc));
  map.channels = 4;
  CHECK_FALSE(map.on(RadioMap::arm, rc));
}

TEST_CASE("the command ends with 1 on a FAIL and with 0 without one") {
  Ready bench;
  Client client = bench.client();
  client.connect();
  HardwareOptions what;
  what.airframe = "configs/airframes/anaconda.yaml";
  CHECK(Captured([&] { return check_command(client, {}, what); }).code == 0);
  bench.firmware.inputs.gnss.fix_type = 0;
  const Captured bad([&] { return check_command(client, {}, what); });
  CHECK(bad.code == 1);
  CHECK(bad.says("FAIL  GNSS            fcu.fix_missing(no fix, 15)"));
  what.airframe = "configs/missions/hourglass.yaml";
  CHECK(Captured([&] { return check_command(client, {}, what); }).says("hourglass.yaml:"));
}

}  // namespace

}  // namespace preflight_test
