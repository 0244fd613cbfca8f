// SPDX-License-Identifier: BSD-3-Clause
// Correct reports: after a gap of the link, on a bad line, after a pause of the computer, in a rejected
// hand-over, and for an intermittent fault.
#include "flying.hpp"

namespace vehicle_words_test {

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
void switch_to(Flying& f, bool pilot) { f.world.fcu.inputs.rc_us[5] = pilot ? 2000 : 1000; }
void cruising(Flying& f) {
  f.state = known();
  f.fly(4);
  f.world.fcu.inputs.rc_us[4] = 2000;
  switch_to(f, true);
  f.fly(1);
  switch_to(f, false);
  f.fly(1);
  REQUIRE(f.status.in_control);
  f.state = known(17);
  f.fly(1);
  f.reported.clear();
}
int times(const Flying& f, const std::string& words) {
  int n = 0;
  for (auto at = f.reported.find(words); at != std::string::npos; at = f.reported.find(words, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a gap of the link is no loss of GNSS, however long it lasts; a fix that stays away after it is") {
  for (const double gap_s : {0.5, 2.0, 10.0}) {
    CAPTURE(gap_s);
    Flying f;
    cruising(f);
    f.world.cut = true;
    f.fly(gap_s);
    f.world.cut = false;
    f.fly(2);
    CHECK(times(f, "gnss") == 0);
    f.world.cut = true;
    f.fly(gap_s);
    f.world.fcu.inputs.gnss_works = false;
    f.world.cut = false;
    f.fly(2);
    CHECK(times(f, "fcu_serial.gnss_lost") == 1);
  }
}

TEST_CASE("a computer that stood still blames nobody else") {
  for (const std::int64_t stop_ns :
       {std::int64_t{250'000'000}, std::int64_t{700'000'000}, std::int64_t{3'000'000'000}}) {
    CAPTURE(stop_ns);
    Flying f;
    cruising(f);
    f.world.stands_ns = stop_ns;
    f.fly(static_cast<double>(stop_ns) * 1e-9 + 2);
    CHECK(times(f, "fcu_serial.stood_still") == (stop_ns > 300'000'000 ? 1 : 0));
    for (const char* part : {"controller_silent", "device_gone", "missing.link", "gnss", "radio", "failsafe",
                             "imu_silent", "missing.inertial_samples"}) {
      CAPTURE(part);
      CHECK(times(f, part) == 0);
    }
    CHECK(f.status.in_control);
    f.world.cut = true;  // silence from then on is reported as usual
    f.fly(0.5);
    CHECK(times(f, "fcu_serial.controller_silent") == 1);
  }
}

TEST_CASE("a line that loses nearly everything says nothing of the radio; a radio that stops is told on it") {
  Flying f;
  cruising(f);
  std::uint32_t dice = 1;
  f.world.lost = [&dice](const Packet&) { return (dice = dice * 1664525 + 1013904223) >> 24 >= 8; };  // 97 %
  f.fly(20);
  CHECK(times(f, "fcu_serial.radio_frozen") == 0);
  f.world.fcu.inputs.rc_frames = false;
  f.fly(10);
  CHECK(times(f, "fcu_serial.radio_frozen") == 1);
  f.world.lost = [](const Packet&) { return false; };
  f.world.fcu.inputs.rc_frames = true;
  f.fly(2);
  CHECK(times(f, "fcu_serial.radio_back") == 1);
}

TEST_CASE("a hand-over that is refused is never called control") {
  Flying f;
  f.state = known();
  f.state->position_valid = false;
  f.world.fcu.inputs.gnss.fix_type = 0;
  f.fly(4);
  f.world.fcu.inputs.rc_us[4] = 2000;
  switch_to(f, true);
  f.fly(1);
  REQUIRE(f.status.armed);
  f.reported.clear();
  for (int i = 0; i < 5; ++i) {
    switch_to(f, false);
    for (int tick = 0; tick < 400; ++tick) {
      f.tick();
      CHECK_FALSE(f.status.in_control);
    }
    switch_to(f, true);
    f.fly(1);
  }
  CHECK(times(f, "in_control") == 0);
  CHECK(times(f, "fcu_serial.not_ready") >= 5);  // each hand-over is answered
}

TEST_CASE("what makes it ready and comes and goes is told less and less often") {
  Flying f;
  f.state = known();
  f.fly(4);
  f.reported.clear();
  for (int i = 0; i < 60; ++i) {
    f.state->position_valid = i % 2 != 0;
    f.world.fcu.inputs.gnss.fix_type = i % 2 != 0 ? 3 : 0;
    f.fly(1);
  }
  const int lines = times(f, "ready");
  CHECK(lines >= 4);   // each of them is 10 s old at most
  CHECK(lines <= 12);  // of 60 changes
  CHECK(times(f, "fcu_serial.gnss_lost") >= 4);
  CHECK(times(f, "fcu_serial.gnss_lost") <= 12);
  CHECK(times(f, "fcu_serial.gnss_back") == times(f, "fcu_serial.gnss_lost"));
  f.reported.clear();
  f.state->position_valid = true;
  f.world.fcu.inputs.gnss.fix_type = 3;
  f.fly(11);
  CHECK(times(f, "fcu_serial.not_ready") == 0);
}

TEST_CASE("an attitude that is lost while the computer flies calls the pilot, once") {
  Flying f;
  cruising(f);
  f.state->attitude_valid = false;
  f.fly(0.25);
  CHECK(times(f, "fcu_serial.attitude_lost") == 0);
  f.fly(3);
  CHECK(times(f, "fcu_serial.attitude_lost") == 1);
  f.state->attitude_valid = true;
  f.fly(1);
  CHECK(times(f, "fcu_serial.attitude_valid") == 1);
  // while the pilot flies he is not called
  switch_to(f, true);
  f.fly(1);
  f.state->attitude_valid = false;
  f.fly(3);
  CHECK(times(f, "fcu_serial.attitude_lost") == 1);
  // an estimate that is not renewed is lost too
  Flying silent;
  cruising(silent);
  silent.state.reset();
  silent.fly(3);
  CHECK(times(silent, "fcu_serial.attitude_lost") == 1);
}

}  // namespace vehicle_words_test
