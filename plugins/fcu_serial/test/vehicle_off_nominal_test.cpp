// SPDX-License-Identifier: BSD-3-Clause
// Numbers that pass through, each distinct, and a controller that boots just after it was disarmed.
#include "flying.hpp"

namespace vehicle_off_nominal_test {

using namespace fulmar;
using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;
using doctest::Approx;

namespace {

/// Disarmed in flight, and rebooted so long after that.
void disarm_and_reboot(Flying& f, double after_s) {
  f.arm();
  f.world.fcu.inputs.rc_us[5] = 2000;
  f.fly(0.1);
  f.world.fcu.inputs.rc_us[4] = 1000;
  while (f.status.armed) f.fly(0.01);
  f.fly(after_s);
  f.reported.clear();
  f.world.fcu.reboot(f.world.now_ns / 1000);
  f.world.happen(LinkEvent::rebooted);
  f.fly(1);
}

}  // namespace

TEST_CASE("volts are volts and amperes are amperes") {
  Flying f;
  f.arm();
  f.world.lost = [](const Packet& p) { return p.is<RosflightBatteryStatus>(); };
  for (const auto& [volt, amp] : {std::pair{23.1f, 12.5f}, {21.4f, 0.75f}}) {
    f.world.inject(RosflightBatteryStatus{volt, amp});
    f.fly(1.5);
    CHECK(f.status.battery_volt == Approx(volt));
    CHECK(f.status.battery_amp == Approx(amp));
  }
}

TEST_CASE("a reboot just after the controller was disarmed may be one in the air, a later one is not") {
  Flying soon;
  disarm_and_reboot(soon, 0.5);
  CHECK(soon.heard("fcu_serial.rebooted_armed"));
  CHECK(soon.heard("fcu_serial.pitot_zeroed_in_flight"));
  const int before = soon.published["pitot"];
  soon.fly(1);
  CHECK(soon.published["pitot"] == before);
  Flying late;
  disarm_and_reboot(late, 1.5);
  CHECK_FALSE(late.heard("fcu_serial.rebooted_armed"));
  CHECK(late.heard("fcu_serial.rebooted\n"));
}

}  // namespace vehicle_off_nominal_test
