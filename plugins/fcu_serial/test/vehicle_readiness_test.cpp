// SPDX-License-Identifier: BSD-3-Clause
// Decision to send commands: after gaps of the link, without a fix, without an attitude; and the reports to
// the pilot.
#include "flying.hpp"

namespace vehicle_readiness_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;

namespace {

VehicleState known(double speed_mps = 0) {
  VehicleState s;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = true;
  s.ground_speed_mps = speed_mps;
  return s;
}
VehicleState placeless() {
  VehicleState s = known();
  s.position_valid = false;
  return s;
}
VehicleState blind() { return {}; }

/// Armed, the pilot's switch on himself.
void armed_by_pilot(Flying& f) {
  f.fly(4);
  f.world.fcu.inputs.rc_us[4] = f.world.fcu.inputs.rc_us[5] = 2000;
  f.fly(1);
  REQUIRE(f.status.armed);
  REQUIRE(f.status.override);
  f.reported.clear();
}
void hand_over(Flying& f) { f.world.fcu.inputs.rc_us[5] = 1000; }
void take_back(Flying& f) { f.world.fcu.inputs.rc_us[5] = 2000; }
std::size_t sent_in(Flying& f, double seconds) {
  const std::size_t before = f.world.count<OffboardControl>();
  f.fly(seconds);
  return f.world.count<OffboardControl>() - before;
}
int times(const Flying& f, const std::string& words) {
  int n = 0;
  for (auto at = f.reported.find(words); at != std::string::npos; at = f.reported.find(words, at + 1)) ++n;
  return n;
}
/// In the air and flown by the host.
void cruising(Flying& f) {
  f.state = known();
  armed_by_pilot(f);
  hand_over(f);
  f.fly(1);
  REQUIRE(f.status.in_control);
  f.state = known(17);
  f.fly(1);
  f.reported.clear();
}

}  // namespace

TEST_CASE("after a gap of the link no command goes out before the attitude is known, and both are told") {
  for (const double gap_s : {0.4, 1.0, 5.0}) {
    CAPTURE(gap_s);
    Flying f;
    cruising(f);
    f.world.cut = true;
    f.state = blind();
    f.fly(gap_s);
    f.world.cut = false;
    CHECK(sent_in(f, 20) == 0);  // the pilot has it for as long as it takes
    CHECK_FALSE(f.status.in_control);
    CHECK(times(f, "fcu_serial.attitude_unknown") == 1);
    f.state = known(17);
    CHECK(sent_in(f, 1) > 50);
    CHECK(f.status.in_control);
    CHECK(times(f, "fcu_serial.attitude_known") == 1);
  }
}

TEST_CASE("a gap over which the attitude is carried takes the commands from nobody") {
  Flying f;
  cruising(f);
  f.world.cut = true;
  f.fly(0.25);
  f.world.cut = false;
  CHECK(sent_in(f, 1) > 50);
  CHECK(f.status.in_control);
  CHECK(times(f, "fcu_serial.attitude_") == 0);
}

TEST_CASE("an attitude that gets lost while the host flies is flown on: nobody else has the sticks") {
  Flying f;
  cruising(f);
  f.state = blind();
  CHECK(sent_in(f, 2) > 150);
  CHECK(f.status.in_control);
  SUBCASE("until the pilot takes over; then it is his") {
    take_back(f);
    f.fly(0.5);
    hand_over(f);
    CHECK(sent_in(f, 2) == 0);
  }
}

TEST_CASE("handed over without a fix: told at once and every 10 s; the fix alone does not start the motor") {
  Flying f;
  f.world.fcu.inputs.gnss.fix_type = 0;
  f.state = placeless();
  armed_by_pilot(f);
  hand_over(f);
  f.fly(0.5);
  CHECK(times(f, "fcu_serial.not_ready(missing.gnss_fix") == 1);
  CHECK(sent_in(f, 25) == 0);
  CHECK(times(f, "fcu_serial.not_ready(missing.gnss_fix") == 3);
  f.world.fcu.inputs.gnss.fix_type = 3;
  f.state = known();
  CHECK(sent_in(f, 15) == 0);
  CHECK(f.heard("fcu_serial.ready_switch_back"));
  take_back(f);
  f.fly(0.5);
  hand_over(f);
  CHECK(sent_in(f, 1) > 50);
  CHECK(f.status.in_control);
}

TEST_CASE("without any estimate, as an estimator is silent until it is aligned, the hand-over waits too") {
  Flying f;
  f.bench.params.needs_state.value = true;
  armed_by_pilot(f);
  hand_over(f);
  CHECK(sent_in(f, 5) == 0);
  CHECK(f.heard("fcu_serial.not_ready(missing.attitude"));
  f.state = known();
  CHECK(sent_in(f, 5) == 0);
}

TEST_CASE(
    "a host that has fallen silent, as after two signals, is not called blind: it has said what it does") {
  Flying f;
  f.bench.params.needs_state.value = true;
  cruising(f);
  f.state.reset();
  f.commands = false;
  for (const fulmar_input* input : {f.bench.in.state.input, f.bench.in.actuators.input})
    const_cast<fulmar_input*>(input)->data = nullptr;  // input of a silent host
  CHECK(sent_in(f, 15) == 0);
  CHECK(f.heard("fcu_serial.not_in_control"));
  CHECK_FALSE(f.heard("attitude"));
  CHECK_FALSE(f.heard("fcu_serial.not_ready"));
}

TEST_CASE("armed before the host was started and no attitude: it says why it does not begin") {
  Flying f;
  f.bench.params.needs_state.value = true;
  f.world.run(2'000'000'000, false);
  f.world.fcu.inputs.rc_us[4] = f.world.fcu.inputs.rc_us[5] = 2000;
  f.world.run(3'000'000'000, false);
  REQUIRE(f.world.fcu.armed());
  f.fly(0.5);
  hand_over(f);
  f.fly(4);
  REQUIRE(f.status.armed);
  CHECK(f.heard("fcu_serial.not_ready_armed_before(missing.attitude"));
  SUBCASE("in the air the estimate comes from two fixes, and the flight goes on") {
    f.state = known(17);
    CHECK(sent_in(f, 1) > 50);
  }
}

TEST_CASE("in the air it is taken back without a position: the estimate is reckoned on") {
  Flying f;
  cruising(f);
  take_back(f);
  f.fly(1);
  f.state = placeless();
  hand_over(f);
  CHECK(sent_in(f, 1) > 50);
}

TEST_CASE("before arming one line says what is missing, every 10 s, and once that nothing is") {
  Flying f;
  f.world.fcu.inputs.gnss.fix_type = 0;
  f.world.fcu.inputs.mag_works = false;
  f.state = placeless();
  f.fly(15);
  CHECK(times(f, "fcu_serial.not_ready(missing.gnss_fix, missing.magnetometer") == 2);
  f.world.fcu.inputs.gnss.fix_type = 3;
  f.world.fcu.inputs.mag_works = true;
  f.state = known();
  f.fly(30);
  CHECK(times(f, "fcu_serial.not_ready") == 2);
  CHECK(times(f, "fcu_serial.ready\n") == 1);
}

TEST_CASE("no magnetometer is said before arming, ready or not") {
  Flying f;
  f.world.fcu.inputs.mag_works = false;
  f.state = known();
  f.fly(15);
  CHECK(times(f, "fcu_serial.ready_but(missing.magnetometer") == 1);
}

TEST_CASE("a mission that flies along a path is not ready without one, and does not begin") {
  Flying f;
  f.bench.params.needs_path.value = true;
  f.state = placeless();
  f.fly(5);
  CHECK(times(f, "missing.path") == 0);  // which the manager publishes once there is a position
  f.state = known();
  f.fly(12);
  CHECK(times(f, "fcu_serial.not_ready(missing.path)\n") == 1);
  armed_by_pilot(f);
  hand_over(f);
  f.fly(0.1);
  CHECK(sent_in(f, 2) == 0);
  f.path = Path();
  f.fly(1);
  CHECK(f.heard("fcu_serial.ready_switch_back"));
  take_back(f);
  f.fly(0.5);
  hand_over(f);
  CHECK(sent_in(f, 1) > 50);
}

TEST_CASE("the airspeed's zero belongs to the line: not done yet, wrong, and good") {
  Flying booted{peer::Options{}};  // it zeroes in the first 12 s
  booted.state = known();
  booted.fly(9);
  CHECK(times(booted, "fcu_serial.ready_but(missing.airspeed_zero)") == 1);
  CHECK(times(booted, "fcu_serial.ready\n") == 0);
  booted.fly(21);
  CHECK(times(booted, "fcu_serial.ready_but(missing.airspeed_zero)") == 1);
  CHECK(times(booted, "fcu_serial.ready\n") == 1);

  Flying wrong;
  wrong.world.fcu.inputs.pitot_pa = 177;
  wrong.state = known();
  wrong.fly(7);
  CHECK(times(wrong, "fcu_serial.ready\n") == 1);
  wrong.fly(8);
  CHECK(times(wrong, "fcu_serial.ready_but(missing.right_airspeed_zero)\n") == 1);
  CHECK(times(wrong, "missing.pitot") == 0);  // it is there
  wrong.world.fcu.params().set(peer::param("DIFF_PRESS_BIAS"), 0.f);
  wrong.fly(5);
  CHECK(times(wrong, "fcu_serial.ready\n") == 2);

  Flying none;
  none.world.fcu.inputs.pitot_works = false;
  none.state = known();
  none.fly(5);
  CHECK(times(none, "fcu_serial.ready_but(missing.pitot)\n") == 1);
}

TEST_CASE("the loss of GNSS is told within 1 s, and its return") {
  for (const double hz : {10.0, 5.0}) {
    CAPTURE(hz);
    peer::Options options;
    options.rates.gnss = hz;
    Flying f(options);
    cruising(f);
    f.world.fcu.inputs.gnss_works = false;
    f.fly(1);
    CHECK(times(f, "fcu_serial.gnss_lost") == 1);
    f.fly(9.5);
    f.world.fcu.inputs.gnss_works = true;
    f.fly(1);
    CHECK(times(f, "fcu_serial.gnss_back(10.") == 1);
    CHECK(times(f, "gnss") == 2);
  }
}

TEST_CASE("send_attitude without an estimate is told once") {
  Flying f;
  f.bench.params.send_attitude.value = true;
  f.fly(25);
  CHECK(times(f, "fcu_serial.state_unwired") == 1);
}

TEST_CASE("after a landing it has not flown: handed over without a position it waits again") {
  Flying f;
  cruising(f);
  take_back(f);
  f.fly(0.5);
  f.world.fcu.inputs.rc_us[4] = 1000;
  f.fly(1);
  REQUIRE_FALSE(f.status.armed);
  f.state = placeless();
  armed_by_pilot(f);
  hand_over(f);
  CHECK(sent_in(f, 2) == 0);
}

TEST_CASE("inertial samples that stop, and no attitude after them: the pilot has it, though the link is up") {
  Flying f;
  cruising(f);
  f.world.lost = [](const Packet& p) { return p.is<SmallImu>(); };
  f.state = blind();
  f.fly(0.15);
  f.world.lost = [](const Packet&) { return false; };
  CHECK(sent_in(f, 2) == 0);
}

TEST_CASE("an estimate that nobody renews is none") {
  Flying f;
  cruising(f);
  f.state.reset();
  f.fly(0.6);
  take_back(f);
  f.fly(0.5);
  hand_over(f);
  CHECK(sent_in(f, 2) == 0);
}

TEST_CASE("a receiver with one fix in a second is not lost between two of them") {
  peer::Options options;
  options.rates.gnss = 1;
  Flying f(options);
  cruising(f);
  f.fly(10);
  CHECK(times(f, "gnss") == 0);
  f.world.fcu.inputs.gnss_works = false;
  f.fly(3);
  CHECK(times(f, "fcu_serial.gnss_lost") == 1);
}

TEST_CASE("the attitude goes to the controller at 50 Hz, however often it comes") {
  Flying f;
  f.bench.params.send_attitude.value = true;
  f.state = known();
  f.fly(2);
  const std::size_t before = f.world.count<ExternalAttitude>();
  f.fly(2);
  CHECK(f.world.count<ExternalAttitude>() - before > 90);
  CHECK(f.world.count<ExternalAttitude>() - before < 110);
}

TEST_CASE("without a link the line says that alone; with one, each sensor, and dots when it is too long") {
  Flying f;
  f.state = blind();
  f.fly(4);
  f.world.fcu.inputs.gnss_works = f.world.fcu.inputs.mag_works = f.world.fcu.inputs.baro_works =
      f.world.fcu.inputs.pitot_works = false;
  f.world.lost = [](const Packet& p) { return p.is<SmallImu>(); };
  f.reported.clear();
  f.fly(12);
  CHECK(f.heard(
      "fcu_serial.not_ready(missing.inertial_samples, missing.attitude, missing.gnss_fix, missing.m...\n"));
  f.world.cut = true;
  f.fly(1);
  f.reported.clear();
  f.fly(20);
  CHECK(times(f, "fcu_serial.not_ready(missing.link)\n") == 2);
  CHECK(times(f, "fcu_serial.not_ready") == 2);
}

TEST_CASE("a computer that stood still says so, and for how long") {
  Flying f;
  cruising(f);
  f.world.run(f.world.now_ns + 1'200'000'000, false);
  f.fly(1);
  CHECK(times(f, "fcu_serial.stood_still(1.2)") == 1);
  f.fly(5);
  CHECK(times(f, "fcu_serial.stood_still") == 1);
}

TEST_CASE("a computer that is too slow for its laws says so, again, and when it keeps up") {
  Flying f;
  cruising(f);
  const auto slow_for = [&f](double seconds, std::int64_t step_ns) {
    const std::int64_t end = f.world.now_ns + static_cast<std::int64_t>(seconds * 1e9);
    while (f.world.now_ns < end) {
      f.tick();
      f.world.run(f.world.now_ns + step_ns, false);  // the time of the laws: a sample arrives every 2.5 ms
    }
  };
  slow_for(5, 2'000'000);
  CHECK(f.reported.find("fcu_serial.computer_slow") == std::string::npos);
  slow_for(3.5, 5'000'000);
  CHECK(times(f, "fcu_serial.computer_slow(50)") + times(f, "fcu_serial.computer_slow(49)") == 1);
  slow_for(20, 30'000'000);
  CHECK(times(f, "fcu_serial.computer_slow") == 3);
  f.fly(3);
  CHECK(times(f, "fcu_serial.computer_fast_again") == 1);
  CHECK(times(f, "fcu_serial.stood_still") == 0);
  f.fly(10);
  CHECK(times(f, "fcu_serial.computer_slow") == 3);
}

TEST_CASE(
    "a fix that is lost on the ground is none, though the position is still known; in the air it goes on") {
  Flying f;
  f.state = known();
  f.fly(4);
  CHECK(times(f, "fcu_serial.ready\n") == 1);
  f.world.fcu.inputs.gnss_works = false;
  f.fly(1.5);
  CHECK(times(f, "fcu_serial.not_ready(missing.gnss_fix)\n") == 1);  // it is withdrawn
  armed_by_pilot(f);
  hand_over(f);
  f.fly(0.1);
  CHECK(sent_in(f, 2) == 0);
  CHECK(f.heard("fcu_serial.not_ready(missing.gnss_fix"));

  Flying air;
  cruising(air);
  air.world.fcu.inputs.gnss_works = false;
  air.fly(2);
  CHECK(sent_in(air, 2) > 100);
  take_back(air);
  air.fly(1);
  hand_over(air);
  CHECK(sent_in(air, 1) > 50);
}

}  // namespace vehicle_readiness_test
