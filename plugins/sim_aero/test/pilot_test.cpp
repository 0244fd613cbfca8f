// SPDX-License-Identifier: BSD-3-Clause
// A transmitter that is connected to the aircraft: its receiver, the source of commands, and its loss.
#include "plugins/sim_aero/pilot.hpp"

#include <doctest/doctest.h>

#include "fly.hpp"
#include "fulmar/msg/fault_request.hpp"

namespace pilot_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

const Actuators cruise{0.57, 0.0041, 0.1212, 0};

struct Seen {
  unsigned rc = 0;
  Rc last;
  VehicleStatus status;
};

/// An aircraft in the air whose fourth switch overrides.
struct Flight {
  Bench<Aircraft> bench{1};
  Rc rc{0.5, 0.25, -0.125, 0.75, 0.1, 0.2, 0.3, -1, true};
  bool wired = true;

  Flight() {
    bench.params.airframe.value = anaconda();
    bench.params.start.start_height.value = 200;
    bench.params.sensors.value = SensorSet::perfect;
    bench.params.pilot.override_switch.value = 4;
  }
  Seen fly(double seconds, const Actuators* actuators = &cruise, double rc_age_s = 0) {
    Seen seen;
    for (int i = 0; i < std::lround(400 * seconds); ++i) {
      if (wired) bench.set(bench.in.pilot, rc, rc_age_s);
      pass(bench, actuators);
      seen.rc += bench.out.rc.written;
      if (bench.out.rc.written) seen.last = bench.out.rc.value;
      if (bench.out.status.written) seen.status = bench.out.status.value;
    }
    return seen;
  }
  Seen armed() {
    arm(bench);
    fly(5.1);
    return fly(0.2);
  }
  Deflections deflections() { return bench.component().plant().deflections(); }
};

}  // namespace

TEST_CASE(
    "the receiver says what the transmitter does, and the parameters of the pilot do not count any more") {
  Flight f;
  f.bench.params.sticks.stick_roll.value = -1;
  f.bench.params.sticks.aux1.value = -1;
  const Seen seen = f.armed();
  CHECK(seen.rc == 10);  // 0.2 s of 50 Hz
  CHECK(seen.last.roll_frac == 0.5);
  CHECK(seen.last.pitch_frac == 0.25);
  CHECK(seen.last.yaw_frac == -0.125);
  CHECK(seen.last.throttle_frac == 0.75);
  CHECK(seen.last.aux1_frac == 0.1);
  CHECK(seen.last.aux4_frac == -1);
  CHECK(seen.last.link);
  CHECK(seen.status.armed);
  CHECK(seen.status.in_control);
  CHECK_FALSE(seen.status.override);
}

TEST_CASE("the override switch gives the sticks the aircraft, and takes it back") {
  Flight f;
  f.armed();
  CHECK(f.deflections().aileron == Approx(cruise.aileron_rad).epsilon(1e-3));
  f.rc.aux4_frac = 0.5;  // the firmware's switch is on from 0.8 of 0 to 1, which is 0.6 here
  CHECK_FALSE(f.fly(0.2).status.override);
  f.rc.aux4_frac = 0.7;
  const Seen seen = f.fly(0.3);
  CHECK(seen.status.override);
  CHECK_FALSE(seen.status.in_control);
  CHECK_FALSE(seen.status.failsafe);
  CHECK(f.deflections().aileron == Approx(0.5 * anaconda().aileron.limit_rad).epsilon(1e-3));
  CHECK(f.deflections().elevator == Approx(-0.25 * anaconda().elevator.limit_rad).epsilon(1e-3));  // nose up
  CHECK(f.deflections().rudder == Approx(0.125 * anaconda().rudder.limit_rad).epsilon(1e-3));  // nose left
  CHECK(f.bench.component().plant().state().omega_b.x() > 0.5);
  f.rc.aux4_frac = -1;
  CHECK(f.fly(0.3).status.in_control);
  CHECK(f.deflections().aileron == Approx(cruise.aileron_rad).epsilon(1e-3));
}

TEST_CASE(
    "without frames, with frames that say so, that are old or no numbers, or with a broken radio: failsafe") {
  const auto lost = [](Flight& f, double age_s) {
    const Seen seen = f.fly(0.3, &cruise, age_s);
    CHECK(seen.rc <= 1);  // the last one from before
    CHECK(seen.status.failsafe);
    CHECK_FALSE(seen.status.in_control);
    CHECK(std::abs(f.deflections().elevator) < 1e-3);  // all commands 0, the computer's included
  };
  const auto back = [](Flight& f) {
    const Seen seen = f.fly(0.3);
    CHECK(seen.rc >= 14);  // 0.3 s of 50 Hz, the first of which may have come before
    CHECK(seen.status.in_control);
    CHECK_FALSE(seen.status.failsafe);
    CHECK(f.deflections().elevator == Approx(cruise.elevator_rad).epsilon(1e-3));
  };
  Flight f;
  f.armed();
  f.rc.link = false;
  lost(f, 0);
  f.rc.link = true;
  back(f);
  lost(f, 0.6);
  back(f);
  CHECK(f.fly(0.3, &cruise, 0.4).status.in_control);  // late is not lost
  f.rc.roll_frac = NAN;
  lost(f, 0);
  f.rc.roll_frac = 0;
  back(f);
  f.bench.push(f.bench.in.fault, FaultRequest{FaultTarget::radio, FaultKind::off});
  lost(f, 0);
  f.bench.push(f.bench.in.fault, FaultRequest{FaultTarget::radio, FaultKind::none});
  back(f);
  f.bench.params.rc_link.value = false;
  f.bench.retune();
  lost(f, 0);
}

TEST_CASE("a computer that is silent leaves the aircraft to the sticks") {
  Flight f;
  f.armed();
  const Seen seen = f.fly(0.3, nullptr);
  CHECK_FALSE(seen.status.in_control);
  CHECK_FALSE(seen.status.failsafe);
  CHECK(f.deflections().aileron == Approx(0.5 * anaconda().aileron.limit_rad).epsilon(1e-3));
}

TEST_CASE("sticks that the host passes on no more are lost after half a second, not frozen") {
  Flight f;
  PilotRadio radio;
  f.bench.set(f.bench.in.pilot, f.rc, 0);
  radio.hear(f.bench.in.pilot, true, 0);
  REQUIRE(radio.link());
  const Optional<Rc> nothing{};
  radio.hear(nothing, true, 400'000'000);
  CHECK(radio.link());
  radio.hear(nothing, true, 501'000'000);
  CHECK_FALSE(radio.link());
  CHECK(radio.wired());
  f.bench.set(f.bench.in.pilot, f.rc, 0);
  radio.hear(f.bench.in.pilot, true, 0);
  CHECK(radio.link());
}

TEST_CASE("nobody arms without a transmitter that is on") {
  Flight f;
  f.rc.link = false;
  CHECK_FALSE(f.armed().status.armed);
  f.rc.link = true;
  CHECK(f.fly(0.2).status.armed);
}

TEST_CASE("the arming switch arms when it is turned on, not when it is found on, and disarms") {
  Flight f;
  f.bench.params.pilot.arm_switch.value = 3;
  f.rc.aux3_frac = 1;
  CHECK_FALSE(f.fly(5.5).status.armed);
  f.rc.aux3_frac = -1;
  CHECK_FALSE(f.fly(0.2).status.armed);
  f.rc.aux3_frac = 1;
  CHECK(f.fly(0.2).status.armed);
  f.rc.aux3_frac = -1;
  CHECK_FALSE(f.fly(0.2).status.armed);
}

TEST_CASE("a transmitter that is not wired changes nothing: the parameters count, without frames too") {
  Flight f;
  f.wired = false;
  f.bench.params.sticks.aux1.value = 0.8;
  const Seen seen = f.armed();
  CHECK(seen.last.aux1_frac == 0.8);
  CHECK(seen.status.in_control);
  f.bench.params.rc_link.value = false;
  f.bench.retune();
  const Seen silent = f.fly(0.3);
  CHECK(silent.rc == 0);
  CHECK_FALSE(silent.status.failsafe);
}

}  // namespace pilot_test
