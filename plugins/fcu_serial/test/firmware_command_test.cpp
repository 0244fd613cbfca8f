// SPDX-License-Identifier: BSD-3-Clause
// The software flight controller answers, echoes, keeps silent and calibrates as ROSflight firmware 2.0.1
// does.
#include <doctest/doctest.h>

#include <cmath>

#include "companion.hpp"

namespace firmware_command_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::peer;

namespace {
ParamSet whole(std::string_view name, std::int32_t value) {
  return {std::bit_cast<std::uint32_t>(value), 1, 0, field<16>(name), param_int32};
}
ParamSet real(std::string_view name, float value) {
  return {std::bit_cast<std::uint32_t>(value), 1, 0, field<16>(name), param_real32};
}
bool acknowledged(const Companion& c, Command command) {
  const auto ack = c.last<RosflightCmdAck>();
  return ack.command == static_cast<std::uint8_t>(command) && ack.success == 1;
}
RosflightCmd order(Command command) { return {static_cast<std::uint8_t>(command)}; }
}  // namespace

TEST_CASE("time is answered at once with the controller's clock, and an answer is not answered") {
  Options o;
  o.first_clock_us = 5000000;
  Companion c(o);
  c.wait(2);
  c.forget();
  c.send(Timesync{0, 123456789});
  REQUIRE(c.all<Timesync>().size() == 1);
  CHECK(c.last<Timesync>().ts1 == 123456789);
  CHECK(c.last<Timesync>().tc1 == 7000000000);
  c.send(Timesync{1, 1});
  CHECK(c.all<Timesync>().size() == 1);
}

TEST_CASE("a crystal that runs 50 ppm fast gains 50 us per second") {
  Options o;
  o.clock_ppm = 50;
  Companion c(o);
  c.wait(10);
  CHECK(c.fcu.clock_us() - 10000000 == doctest::Approx(500).epsilon(0.01));
}

TEST_CASE(
    "a parameter is echoed only when it changes; unknown names, wrong types and foreign systems are met with "
    "silence") {
  Companion c;
  c.wait(0.5);
  c.forget();
  c.send(real("PID_ROLL_RATE_P", 0.08f));
  REQUIRE(c.all<ParamValue>().size() == 1);
  CHECK(std::bit_cast<float>(c.last<ParamValue>().param_value) == 0.08f);
  c.send(real("PID_ROLL_RATE_P", 0.08f));
  c.send(whole("PID_ROLL_RATE_P", 1));
  c.send(whole("NO_SUCH_PARAM", 1));
  auto foreign = whole("RC_TYPE", 1);
  foreign.target_system = 2;
  c.send(foreign);
  c.send(ParamRequestRead{-1, 1, 0, field<16>("NO_SUCH_PARAM")});
  c.send(ParamRequestRead{333, 1, 0, {}});
  CHECK(c.all<ParamValue>().size() == 1);
  c.send(ParamRequestRead{-1, 1, 0, field<16>("RC_ARM_THRESHOLD")});  // 16 characters, no NUL
  CHECK(c.last<ParamValue>().param_index == 327);
}

TEST_CASE("choosing a mixer writes its matrix, and says so value by value") {
  Companion c;
  c.wait(0.5);
  c.forget();
  c.send(whole("PRIMARY_MIXER", 10));
  CHECK(c.all<ParamValue>().size() > 20);
  CHECK(c.fcu.params().f(c.fcu.params().find("PRI_MIXER_4_1")) == -0.5f);
  CHECK(c.fcu.params().f(c.fcu.params().find("SEC_MIXER_4_1")) == -0.5f);
  c.send(whole("SECONDARY_MIXER", 10));
  CHECK(c.fcu.params().f(c.fcu.params().find("SEC_MIXER_4_1")) == -1);  // pseudo-inverted by mistake
  CHECK((c.fcu.errors() & error_invalid_mixer) == 0);
  c.send(whole("PRIMARY_MIXER", 77));
  CHECK((c.fcu.errors() & error_invalid_mixer) != 0);
}

TEST_CASE("a canned V-tail in the secondary has twice its gain, and the mirrored one has not") {
  Companion c;
  arm(c);
  c.send(whole("PRIMARY_MIXER", 10));
  c.command(passed(0, 0, 0.4f, 0), 0.2);
  CHECK(c.fcu.outputs()[1] == doctest::Approx(0.5 - 0.5 * 0.2));
  CHECK(c.fcu.outputs()[2] == doctest::Approx(0.5 + 0.5 * 0.2));
  CHECK(c.fcu.deflected().elevator == doctest::Approx(0.4));
  CHECK(c.fcu.deflected().rudder == doctest::Approx(0));
  c.send(whole("SECONDARY_MIXER", 10));
  c.command(passed(0, 0, 0.4f, 0), 0.2);
  CHECK(c.fcu.outputs()[2] == doctest::Approx(0.5 + 0.5 * 0.4));
}

TEST_CASE("reversed surfaces are reversed before the mixer") {
  Companion c;
  arm(c);
  c.send(whole("REV_ELEVATOR", 1));
  c.command(passed(0, 0.3f, 0.4f, 0), 0.2);
  CHECK(c.fcu.deflected().elevator == doctest::Approx(-0.4));
  CHECK(c.fcu.deflected().aileron == doctest::Approx(0.3));
}

TEST_CASE("every command is refused while armed, the version's too") {
  Companion c;
  arm(c);
  for (std::uint8_t k = 0; k <= 10; ++k) {
    c.forget();
    c.send(RosflightCmd{k});
    REQUIRE(c.all<RosflightCmdAck>().size() == 1);
    CHECK(c.last<RosflightCmdAck>().success == 0);
    CHECK(c.all<RosflightVersion>().empty());
  }
  c.send(real("PID_ROLL_RATE_P", 0.5f));  // but parameters may change
  CHECK(c.fcu.params().f(param("PID_ROLL_RATE_P")) == 0.5f);
}

TEST_CASE("the version has garbage behind its NUL") {
  Companion c;
  c.send(order(Command::send_version));
  const auto m = c.last<RosflightVersion>();
  CHECK(text(m.version) == "v2.0.1-0-ge8cf6a0f");
  CHECK(m.version[49] != 0);
  CHECK(acknowledged(c, Command::send_version));
}

TEST_CASE("an IMU calibration acknowledges at once and ends 2.5 s later with its biases") {
  Companion c;
  c.send(Heartbeat{});
  c.fcu.inputs.gyro = {0.01, -0.02, 0.03};
  c.fcu.inputs.accel = {0.3, 0.1, -9.80665 - 0.2};
  c.wait(0.5);
  CHECK((c.fcu.errors() & error_uncalibrated_imu) != 0);
  c.send(order(Command::accel_calibration));
  CHECK(acknowledged(c, Command::accel_calibration));
  c.wait(2.4);
  CHECK_FALSE(c.said("IMU offsets captured"));
  c.wait(0.2);
  CHECK(c.said("IMU offsets captured"));
  CHECK((c.fcu.errors() & error_uncalibrated_imu) == 0);
  CHECK(c.last<SmallImu>().xacc == doctest::Approx(0).epsilon(1e-5));
  CHECK(c.last<SmallImu>().zacc == doctest::Approx(-9.80665));
  CHECK(c.last<SmallImu>().zgyro == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("an IMU calibration on a moving aircraft is rejected") {
  Companion c;
  c.send(Heartbeat{});
  int k = 0;
  c.fcu.before_imu = [&] { c.fcu.inputs.accel = {++k % 2 ? 1.0 : -1.0, 0, -9.8}; };
  c.send(order(Command::accel_calibration));
  c.wait(2.6);
  const char* const firmware_text = "Too much movement for IMU cal";
  CHECK(c.said(firmware_text));
  CHECK((c.fcu.errors() & error_uncalibrated_imu) != 0);
}

TEST_CASE("flash keeps what was written, over a reboot that takes 20 ms; the rest is lost") {
  Companion c;
  c.send(whole("RC_TYPE", 1));
  c.send(order(Command::write_params));
  CHECK(acknowledged(c, Command::write_params));
  c.send(real("PID_ROLL_RATE_P", 0.5f));
  c.wait(1);
  c.send(order(Command::reboot));
  CHECK(acknowledged(c, Command::reboot));
  const auto before = c.fcu.boots();
  c.wait(0.018);
  CHECK(c.fcu.boots() == before);
  c.wait(0.01);
  CHECK(c.fcu.boots() == before + 1);
  CHECK(c.fcu.clock_us() < 10000);
  CHECK(c.fcu.params().i(param("RC_TYPE")) == 1);
  CHECK(c.fcu.params().f(param("PID_ROLL_RATE_P")) == 0.07f);
}

TEST_CASE("default parameters are announced by nobody, and modules keep the old ones") {
  Companion c;
  c.fcu.provision();
  c.wait(1);
  c.forget();
  c.send(order(Command::set_param_defaults));
  CHECK(acknowledged(c, Command::set_param_defaults));
  CHECK(c.all<ParamValue>().empty());
  CHECK((c.fcu.errors() & error_invalid_mixer) == 0);
  c.send(order(Command::read_params));
  CHECK(c.all<ParamValue>().empty());
  CHECK(c.fcu.params().i(param("PRIMARY_MIXER")) == 9);
}

TEST_CASE("auxiliary outputs take what the mixer does not own, and keep it when disabled") {
  Companion c;
  c.fcu.provision();
  RosflightAuxCmd m;
  m.aux_cmd_array[0] = 1;
  m.type_array[0] = 1;  // the mixer's
  m.aux_cmd_array[10] = 0.5f;
  m.type_array[10] = 1;
  m.aux_cmd_array[11] = 0.5f;
  m.type_array[11] = 2;  // a motor, disarmed
  c.send(m);
  c.wait(0.05);
  CHECK(c.fcu.outputs()[0] == doctest::Approx(0.5));
  CHECK(c.fcu.outputs()[10] == doctest::Approx(0.75));
  CHECK(c.fcu.outputs()[11] == 0);
  m.type_array[10] = 0;
  c.send(m);
  c.wait(0.05);
  CHECK(c.fcu.outputs()[10] == doctest::Approx(0.75));
  m.type_array[13] = 3;
  m.type_array[10] = 1;
  m.aux_cmd_array[10] = -1;
  c.send(m);  // dropped whole
  c.wait(0.05);
  CHECK(c.fcu.outputs()[10] == doctest::Approx(0.75));
}

}  // namespace firmware_command_test
