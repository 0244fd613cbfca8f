// SPDX-License-Identifier: BSD-3-Clause
// The software flight controller streams, arms, overrides and fails as ROSflight firmware 2.0.1 was measured
// to.
#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "companion.hpp"

namespace firmware_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::peer;

TEST_CASE("the streams have the rates of the hardware, and 48.9 kB/s in all") {
  Companion c;
  c.fcu.provision();
  c.wait(10);
  c.forget();
  c.wait(10);
  std::map<int, int> count;
  for (const Packet& p : c.packets) ++count[p.id];
  CHECK(count[SmallImu::id] == doctest::Approx(4000).epsilon(0.001));
  CHECK(count[AttitudeQuaternion::id] == count[SmallImu::id]);
  CHECK(count[RosflightOutputRaw::id] == doctest::Approx(500).epsilon(0.005));
  CHECK(count[SmallMag::id] == doctest::Approx(1000).epsilon(0.002));
  CHECK(count[SmallBaro::id] == doctest::Approx(500).epsilon(0.005));
  CHECK(count[DiffPressure::id] == doctest::Approx(1000).epsilon(0.002));
  CHECK(count[RosflightGnss::id] == doctest::Approx(100).epsilon(0.011));
  CHECK(count[RosflightBatteryStatus::id] == doctest::Approx(100).epsilon(0.011));
  CHECK(count[RcChannels::id] == doctest::Approx(1110).epsilon(0.001));
  CHECK(count[RosflightStatus::id] >= 100);
  CHECK(count[RosflightStatus::id] <= 103);
  CHECK(count[Heartbeat::id] == 10);
  CHECK(c.bytes / 10 == doctest::Approx(48900).epsilon(0.003));
}

TEST_CASE("a list of 333 parameters comes in 0.167 s, in the order of the firmware") {
  Companion c;
  c.wait(1);
  c.forget();
  c.send(ParamRequestList{});
  c.wait(0.166);
  CHECK(c.all<ParamValue>().size() < 333);
  c.wait(0.002);
  const auto values = c.all<ParamValue>();
  REQUIRE(values.size() == 333);
  for (std::size_t i = 0; i < 333; ++i) CHECK(values[i].param_index == i);
  CHECK(text(values[0].param_id) == "BAUD_RATE");
  CHECK(text(values[231].param_id) == "SYS_ID");
  CHECK(text(values[315].param_id) == "PRIMARY_MIXER");
  CHECK(text(values[328].param_id) == "OFFBOARD_TIMEOUT");
  CHECK(text(values[332].param_id) == "BATT_CURR_LPF");
  CHECK(text(values[31 + 10 * 4 + 3].param_id) == "PRI_MIXER_3_4");
  CHECK(std::bit_cast<std::int32_t>(values[298].param_value) == -1);  // RC_ATT_CTRL_CHN, no number as a float
  CHECK(std::isnan(std::bit_cast<float>(values[298].param_value)));
}

TEST_CASE("the fifo holds 256 packets and drops the newest") {
  Options fast;
  fast.rates.passes = 350000;
  Companion c(fast);
  c.wait(1);
  c.fcu.receive(encode(ParamRequestList{}, 0).view(), c.now_us);
  c.fcu.run(c.now_us + 2000);  // 700 passes without a reader
  CHECK(c.fcu.waiting() == 256);
  CHECK(c.fcu.dropped() > 70);
  Frame f;
  Packet last;
  Parser parser;
  while (c.fcu.take(f)) parser.feed(f.view(), [&](const Packet& p) { last = p; });
  REQUIRE(last.is<ParamValue>());
  CHECK(last.as<ParamValue>().param_index < 260);
}

TEST_CASE("ids are as odd as the real ones") {
  Companion c;
  c.wait(1);
  CHECK(c.texts().empty());  // none before the first heartbeat
  c.send(Heartbeat{});
  c.wait(0.1);
  bool foreign = false;
  for (const Packet& p : c.packets) {
    if (p.is<Statustext>())
      foreign |= p.system != 1;
    else
      CHECK(p.system == 1);
    CHECK(p.component == 250);
  }
  CHECK(foreign);
  CHECK(c.said("Booting"));
  c.forget();
  c.send(ParamRequestRead{.param_index = 5});
  REQUIRE(c.packets.size() == 1);
  CHECK(c.packets[0].component == 0);
  c.forget();
  c.send(RosflightCmd{11});
  REQUIRE(c.packets.size() == 1);
  CHECK(c.packets[0].system == companion_system);
  CHECK(c.last<RosflightCmdAck>().success == 0);
  CHECK(c.last<Heartbeat>().mavlink_version == 2);
}

TEST_CASE("factory settings: error 0xa1, no offboard 0x3c0, in the first second 0x3dc") {
  Companion c;
  c.wait(0.9);
  CHECK(c.last<RosflightStatus>().error_code == 0xa1);
  CHECK(c.last<RosflightStatus>().rc_override == 0x3dc);
  c.wait(1);
  CHECK(c.last<RosflightStatus>().rc_override == 0x3c0);
}

TEST_CASE("baro and airspeed zero themselves 10.1 s and 7.6 s after every boot") {
  Companion c;
  c.fcu.provision();
  c.fcu.inputs.pitot_pa = 198.4;  // 18 m/s: it was flying
  c.send(Heartbeat{});
  c.wait(7.5);
  CHECK(c.last<DiffPressure>().velocity == doctest::Approx(18).epsilon(0.001));
  c.wait(0.3);
  CHECK(std::abs(c.last<DiffPressure>().velocity) < 0.02);
  CHECK(c.said("Airspeed Cal Successful!"));
  CHECK(c.fcu.params().f(param("DIFF_PRESS_BIAS")) == doctest::Approx(198.4));
  CHECK_FALSE(c.said("Baro Cal"));
  c.wait(2.5);
  CHECK(c.said("Baro Cal successful!"));
  CHECK(c.fcu.params().f(param("BARO_BIAS")) == doctest::Approx(85700));
  CHECK(c.fcu.params().f(param("GROUND_LEVEL")) == doctest::Approx(1387.5).epsilon(0.005));
}

TEST_CASE("a computer's command moves the outputs, and 100 ms after the last one the pilot has them") {
  Companion c;
  arm(c);
  REQUIRE(c.fcu.armed());
  c.command(passed(0.5f, 0.2f, -0.4f, 0.6f), 0.5);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.6));
  CHECK(c.fcu.outputs()[1] == doctest::Approx(0.3));
  CHECK(c.fcu.outputs()[2] == doctest::Approx(0.8));
  CHECK(c.fcu.outputs()[4] == doctest::Approx(0.5));
  CHECK(c.last<RosflightStatus>().rc_override == 0);
  CHECK(c.last<RosflightStatus>().offboard == 1);
  CHECK(c.last<RosflightStatus>().control_mode == 0);
  c.send(passed(0.5f, 0.2f, -0.4f, 0.6f));
  double after = 0;
  while (c.fcu.outputs()[4] > 0.1f && after < 1) {
    c.wait(0.001);
    after += 0.001;
  }
  CHECK(after > 0.09);
  CHECK(after < 0.115);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5));
  CHECK(c.last<RosflightStatus>().rc_override == 0x3c0);
}

TEST_CASE("outputs move at frames of the radio only, and without them stay for ever") {
  Companion c;
  arm(c);
  c.command(passed(0.5f, 0.2f, 0, 0), 0.5);
  c.fcu.inputs.rc_frames = false;
  c.forget();
  c.command(passed(0.9f, -1, 0, 0), 3);
  CHECK(c.all<RcChannels>().empty());
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.6));
  CHECK(c.fcu.outputs()[4] == doctest::Approx(0.5));
  CHECK(c.last<RosflightStatus>().offboard == 1);
  CHECK(c.last<RosflightStatus>().error_code == 0);
  CHECK(c.last<RosflightStatus>().failsafe == 0);
  c.fcu.inputs.rc_frames = true;
  c.command(passed(0.9f, -1, 0, 0), 0.05);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0));
}

TEST_CASE("one NaN poisons every output, the motor's too") {
  Companion c;
  arm(c);
  c.command(passed(0.5f, NAN, 0, 0), 0.1);
  for (const std::size_t j : {0u, 1u, 2u, 4u}) CHECK(std::isnan(c.fcu.outputs()[j]));
}

TEST_CASE("modes 1 and 2 run the loops of a multirotor on a fixed wing; 3 to 5 are dropped") {
  Companion c;
  arm(c);
  OffboardControl m = passed(1, 0.5f, 0, 0);
  m.mode = 2;
  c.command(m, 0.2);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5 + 0.5 * 0.075).epsilon(0.001));
  CHECK(c.fcu.outputs()[4] == doctest::Approx(0.7));
  m.mode = 1;
  c.command(m, 0.2);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5 + 0.5 * 0.035).epsilon(0.001));
  m.mode = 3;
  c.command(m, 0.5);
  CHECK(c.last<RosflightStatus>().offboard == 0);
}

TEST_CASE("servos move while disarmed, the motor does not") {
  Companion c;
  c.fcu.provision();
  c.wait(1.2);
  c.command(passed(0.8f, 0.5f, 0, 0), 0.3);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.75));
  CHECK(c.fcu.outputs()[4] == 0);
}

TEST_CASE("the pilot's stick overrides for the lag time, counted from its first deviation") {
  Companion c;
  arm(c);
  c.fcu.params().set(param("RC_OVRD_DEV"), 0.1f);
  const auto m = passed(0.5f, 0.2f, 0, 0);
  c.command(m, 0.3);
  REQUIRE(c.last<RosflightStatus>().rc_override == 0);
  c.fcu.inputs.rc_us[0] = 1700;
  c.command(m, 0.2);
  CHECK(c.last<RosflightStatus>().rc_override == override_stick_x);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5 + 0.5 * 0.4));
  c.fcu.inputs.rc_us[0] = 1500;
  double after = 0;
  while (c.fcu.override_reasons() && after < 2) {
    c.command(m, 0.02);
    after += 0.02;
  }
  CHECK(after > 0.7);  // 1 s from the first deviation, which was 0.2 s ago
  CHECK(after < 0.85);
}

TEST_CASE("the radio's loss is a failsafe with everything neutral, and its return arms again") {
  Companion c;
  arm(c);
  const auto m = passed(0.5f, 0.2f, 0.1f, 0);
  c.command(m, 0.3);
  c.fcu.inputs.rc_lost = true;
  c.command(m, 0.2);
  CHECK(c.last<RosflightStatus>().failsafe == 1);
  CHECK(c.last<RosflightStatus>().armed == 1);
  CHECK(c.last<RosflightStatus>().error_code == error_rc_lost);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5));
  CHECK(c.fcu.outputs()[4] == 0);
  c.fcu.inputs.rc_lost = false;
  c.command(m, 0.2);
  CHECK(c.last<RosflightStatus>().failsafe == 0);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.6));
  c.fcu.inputs.rc_us[3] = 700;  // one channel far out of range
  c.command(m, 0.1);
  CHECK(c.last<RosflightStatus>().failsafe == 1);
}

TEST_CASE("arming wants no error, low throttle and the override switch") {
  Companion c;
  c.fcu.provision();
  c.send(Heartbeat{});
  c.wait(0.5);
  c.fcu.inputs.rc_us[4] = 2000;
  c.wait(0.1);
  const char* const firmware_text = "RC throttle override must be active to arm";
  CHECK(c.said(firmware_text));
  c.fcu.inputs.rc_us[5] = 2000;
  c.fcu.inputs.rc_us[2] = 1300;
  c.wait(1.1);
  CHECK_FALSE(c.fcu.armed());
  CHECK(c.said("throttle is too high"));
  c.fcu.inputs.rc_us[2] = 1000;
  c.wait(0.1);
  CHECK(c.fcu.armed());
  c.fcu.inputs.rc_us[4] = 1000;
  c.wait(0.1);
  CHECK_FALSE(c.fcu.armed());
}

TEST_CASE("without an arm switch the sticks arm after a second") {
  Companion c;
  c.fcu.provision();
  c.fcu.params().set(param("RC_ARM_CHN"), -1);
  c.fcu.params().set(param("TAKE_MIN_THR"), 1);
  c.wait(0.5);
  c.fcu.inputs.rc_us[3] = 1980;
  c.wait(0.95);
  CHECK_FALSE(c.fcu.armed());
  c.wait(0.1);
  CHECK(c.fcu.armed());
  c.fcu.inputs.rc_us[3] = 1020;
  c.wait(1.1);
  CHECK_FALSE(c.fcu.armed());
}

TEST_CASE("a crash in flight is told after the next heartbeat, and the aircraft is armed again") {
  Companion c;
  arm(c);
  c.fcu.crash(c.now_us);
  CHECK(c.fcu.clock_us() == 0);
  c.wait(0.5);
  CHECK(c.all<RosflightHardError>().empty());
  CHECK(c.fcu.armed());
  c.send(Heartbeat{});
  c.wait(0.1);
  REQUIRE(c.all<RosflightHardError>().size() == 1);
  CHECK(c.last<RosflightHardError>().doRearm == 1);
}

TEST_CASE("the controller's attitude follows a steady roll") {
  Companion c;
  c.fcu.provision();
  c.wait(4);
  const double phi = 0.5;
  c.fcu.before_imu = [&] {
    c.fcu.inputs.gyro = {0.25, 0, 0};
    c.fcu.inputs.accel = {0, 0, -25};
  };  // no gravity to go by
  c.wait(phi / 0.25);
  const auto m = c.last<AttitudeQuaternion>();
  CHECK(2 * std::atan2(m.q2, m.q1) == doctest::Approx(phi).epsilon(0.01).scale(0));
}

}  // namespace firmware_test
