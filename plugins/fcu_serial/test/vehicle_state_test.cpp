// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "plugins/fcu_serial/greeting.hpp"
#include "plugins/fcu_serial/state.hpp"

namespace vehicle_state_test {

using namespace fulmar;
using namespace fulmar::fcu;

namespace {
constexpr std::int64_t ms = 1'000'000, now = 10'000 * ms;

/// Armed, offboard, everything fresh.
Heard flying() {
  Heard h;
  h.status.armed = h.status.offboard = 1;
  h.frame_ns = h.imu_ns = h.status_ns = h.rc_ns = h.command_ns = now - ms;
  h.frames_since_rc = frames_without_rc;  // it counts only once the radio is silent
  return h;
}

std::string reported(Reporter& reporter, const Heard& h, std::int64_t at = now) {
  Notices notices;
  reporter.report(evaluate(h, at), h, at, notices);
  std::string all;
  for (std::size_t i = 0; i < notices.size(); ++i) all += std::string(notices[i].text.view()) + "\n";
  return all;
}
}  // namespace

TEST_CASE("the host is in control when the controller says so in every respect") {
  const VehicleStatus s = evaluate(flying(), now);
  CHECK(s.armed);
  CHECK(s.offboard);
  CHECK(s.in_control);
  CHECK_FALSE(s.override);
  CHECK_FALSE(s.on_ground);
  CHECK(s.errors == 0);
  CHECK(s.health == Health::ok);
  CHECK(s.rc_age_s == doctest::Approx(0.001));
}

TEST_CASE("each single reason takes control away") {
  struct Row {
    const char* what;
    void (*change)(Heard&);
    bool override;
  };
  const Row rows[] = {
      {"disarmed", [](Heard& h) { h.status.armed = 0; }, false},
      {"failsafe", [](Heard& h) { h.status.failsafe = 1; }, false},
      {"no offboard", [](Heard& h) { h.status.offboard = 0; }, false},
      {"attitude switch", [](Heard& h) { h.status.rc_override = 0x001; }, true},
      {"throttle switch", [](Heard& h) { h.status.rc_override = 0x002; }, true},
      {"roll stick", [](Heard& h) { h.status.rc_override = 0x004; }, true},
      {"pitch stick", [](Heard& h) { h.status.rc_override = 0x008; }, true},
      {"yaw stick", [](Heard& h) { h.status.rc_override = 0x010; }, true},
      {"lower throttle", [](Heard& h) { h.status.rc_override = 0x020; }, true},
      {"x inactive", [](Heard& h) { h.status.rc_override = 0x040; }, false},
      {"y inactive", [](Heard& h) { h.status.rc_override = 0x080; }, false},
      {"z inactive", [](Heard& h) { h.status.rc_override = 0x100; }, false},
      {"throttle inactive", [](Heard& h) { h.status.rc_override = 0x200; }, false},
      {"old status", [](Heard& h) { h.status_ns = now - 600 * ms; }, false},
      {"no radio", [](Heard& h) { h.rc_ns = now - 600 * ms; }, false},
      {"no frames", [](Heard& h) { h.frame_ns = h.imu_ns = now - 250 * ms; }, false},
      {"no inertial samples", [](Heard& h) { h.imu_ns = now - 250 * ms; }, false},
      {"nothing sent", [](Heard& h) { h.command_ns = now - 150 * ms; }, false},
  };
  for (const Row& row : rows) {
    CAPTURE(row.what);
    Heard h = flying();
    row.change(h);
    const VehicleStatus s = evaluate(h, now);
    CHECK_FALSE(s.in_control);
    CHECK(s.override == row.override);
  }
}

TEST_CASE("a short gap is flagged, and takes nothing away") {
  Heard h = flying();
  h.frame_ns = h.imu_ns = now - 150 * ms;
  h.rc_ns = h.status_ns = now - 400 * ms;
  CHECK(evaluate(h, now).in_control);
  CHECK(evaluate(h, now).health == Health::degraded);
  h.frame_ns = h.imu_ns = now - 40 * ms;
  CHECK(evaluate(h, now).health == Health::ok);
}

TEST_CASE("the errors are the controller's own, and three of ours") {
  Heard h = flying();
  h.status.error_code = 0xa1;
  h.status.num_errors = 2;
  CHECK(evaluate(h, now).errors == (0xa1u | own_error_sensors_dead));
  CHECK(evaluate(h, now).health == Health::degraded);
  h.rc_ns = now - 501 * ms;
  CHECK(evaluate(h, now).errors == (0xa1u | own_error_sensors_dead | own_error_rc_silent));
  h.frame_ns = h.imu_ns = now - 201 * ms;
  CHECK((evaluate(h, now).errors & own_error_link_down) != 0);
  CHECK(evaluate(h, now).health == Health::failed);
  CHECK(evaluate(h, now).armed);  // last known state
}

TEST_CASE("a controller that is back is not told to have no radio before that could speak") {
  Heard h = flying();
  h.frame(now + 5000 * ms);
  CHECK((evaluate(h, now + 5010 * ms).errors & own_error_rc_silent) == 0);
  CHECK_FALSE(evaluate(h, now + 5010 * ms).in_control);
  h.frame(now + 5100 * ms);
  h.frame(now + 5200 * ms);
  h.frame(now + 5300 * ms);
  h.frame(now + 5400 * ms);
  h.frame(now + 5510 * ms);
  CHECK((evaluate(h, now + 5510 * ms).errors & own_error_rc_silent) != 0);
}

TEST_CASE("no radio is an error only after it had the time to speak") {
  Heard h;
  h.frames_since_rc = frames_without_rc;
  h.frame_ns = h.imu_ns = h.status_ns = 100 * ms;
  CHECK(evaluate(h, 100 * ms).errors == 0);
  CHECK(evaluate(h, 100 * ms).rc_age_s == 1e9);
  h.frame_ns = h.imu_ns = h.status_ns = 600 * ms;
  CHECK(evaluate(h, 600 * ms).errors == own_error_rc_silent);
}

TEST_CASE("each change is told once, in words") {
  Reporter reporter;
  Heard h = flying();
  h.status.armed = 0;
  CHECK(reported(reporter, h) == "");
  h.status.armed = 1;
  CHECK(reported(reporter, h) == "fcu_serial.armed\nfcu_serial.in_control\n");
  CHECK(reported(reporter, h) == "");
  h.status.rc_override = 0x001 | 0x010;
  CHECK(reported(reporter, h) ==
        "fcu_serial.pilot_flies(fcu_serial.attitude_switch, "
        "fcu_serial.yaw_stick)\nfcu_serial.not_in_control\n");
  h.status.rc_override = 0x010;
  CHECK(reported(reporter, h) == "");
  h.status.rc_override = 0;
  CHECK(reported(reporter, h) == "fcu_serial.pilot_hands_over\nfcu_serial.in_control\n");
  h.status.failsafe = 1;
  CHECK(reported(reporter, h).find("fcu_serial.failsafe_entered\n") == 0);
  h.status.failsafe = 0;
  CHECK(reported(reporter, h).find("fcu_serial.failsafe_over\n") == 0);
  h.status.armed = 0;
  CHECK(reported(reporter, h).find("fcu_serial.disarmed\n") == 0);
}

TEST_CASE("control that comes and goes on a bad line is told as that, not change by change") {
  Reporter reporter;
  Heard h = flying();
  std::string all;
  std::int64_t at = now;
  const auto pass = [&](int n, int period_ms) {
    for (int i = 0; i < n; ++i) {
      at += period_ms * ms;
      h.frame_ns = h.imu_ns = h.status_ns = h.rc_ns = at;
      h.command_ns = i % 2 == 0 ? at - 150 * ms : at;
      all += reported(reporter, h, at);
    }
  };
  CHECK(reported(reporter, h, at) == "fcu_serial.armed\nfcu_serial.in_control\n");
  pass(100, 60);  // 6 s of it, and it ends in control
  CHECK(std::count(all.begin(), all.end(), '\n') <= 4);
  CHECK(all.find("fcu_serial.control_unsteady\n") != std::string::npos);
  all.clear();
  for (int i = 0; i < 50; ++i) {
    at += 60 * ms;
    h.frame_ns = h.imu_ns = h.status_ns = h.rc_ns = h.command_ns = at;
    all += reported(reporter, h, at);
  }
  CHECK(all == "fcu_serial.in_control\n");  // as it has stayed for 2 s
  all.clear();
  h.command_ns = at - 150 * ms;
  CHECK(reported(reporter, h, at) == "fcu_serial.not_in_control\n");
}

TEST_CASE("error bits are told in words that say what to do, and when they go") {
  Reporter reporter;
  Heard h = flying();
  h.status.error_code = error_uncalibrated_imu | error_invalid_mixer;
  const std::string text = reported(reporter, h);
  CHECK(text.find("fcu_serial.error_reported(fcu_serial.mixer_invalid)\n") != std::string::npos);
  CHECK(text.find("fcu_serial.error_reported(fcu_serial.imu_uncalibrated)\n") != std::string::npos);
  h.status.error_code = error_invalid_mixer;
  CHECK(reported(reporter, h) == "fcu_serial.error_gone(fcu_serial.imu_uncalibrated)\n");
}

TEST_CASE("a radio that stops is told: the outputs are frozen") {
  Reporter reporter;
  Heard h = flying();
  reported(reporter, h);
  h.rc_ns = now - 600 * ms;
  CHECK(reported(reporter, h).find("fcu_serial.radio_frozen\n") != std::string::npos);
  CHECK(reported(reporter, h) == "");
  h.rc_ns = now;
  CHECK(reported(reporter, h).find("fcu_serial.radio_back\n") != std::string::npos);
}

TEST_CASE("a dead inertial unit is told, though nothing else says so") {
  Reporter reporter;
  Heard h = flying();
  reported(reporter, h);
  h.imu_ns = now - 300 * ms;
  CHECK(evaluate(h, now).errors == own_error_imu_silent);
  CHECK(evaluate(h, now).health == Health::failed);
  CHECK(reported(reporter, h).find("fcu_serial.imu_silent\n") != std::string::npos);
  h.imu_ns = now;
  CHECK(reported(reporter, h).find("fcu_serial.imu_back\n") != std::string::npos);
}

TEST_CASE("a controller that is lost is told once, and how long it was gone") {
  Reporter reporter;
  Heard h = flying();
  reported(reporter, h);
  h.open = false;
  CHECK(reported(reporter, h, now + 250 * ms) == "fcu_serial.device_gone\n");
  CHECK(reported(reporter, h, now + 350 * ms) == "");
  h.open = true;
  h.frame(now + 5000 * ms);
  h.imu_ns = h.status_ns = h.rc_ns = h.command_ns = now + 5000 * ms;
  CHECK(reported(reporter, h, now + 5000 * ms).find("fcu_serial.controller_back(5.0)\n") == 0);
  CHECK(reported(reporter, h, now + 5000 * ms) == "");
}

TEST_CASE("nothing is told of a controller that has said nothing yet") {
  Reporter reporter;
  CHECK(reported(reporter, Heard{}) == "");
}

TEST_CASE("texts of the controller are forwarded up to their end, with their severity") {
  Notices notices;
  Forwarder texts;
  Statustext m;
  m.severity = 2;
  m.text.fill('x');
  const char* words = "IMU offsets captured";
  std::copy_n(words, std::string_view(words).size() + 1, m.text.begin());
  texts.forward(m, now, notices);
  m.text.fill('y');  // no NUL at all
  m.severity = 6;
  texts.forward(m, now, notices);
  REQUIRE(notices.size() == 2);
  CHECK(notices[0].text.view() == "fcu_serial.controller_text(IMU offsets captured)");
  CHECK(notices[0].severity == fulmar::Severity::critical);
  CHECK(notices[1].text.view() == "fcu_serial.controller_text(" + std::string(50, 'y') + ")");
  CHECK(notices[1].severity == fulmar::Severity::info);
}

TEST_CASE("that there is no secondary mixer, as is recommended, is told without a fright") {
  Notices notices;
  Forwarder texts;
  Statustext m;
  m.severity = 3;
  std::copy_n("Invalid mixer selected for secondary mixer!", 44, m.text.begin());
  texts.forward(m, now, notices);
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].text.view() == "fcu_serial.secondary_mixer_unset");
  CHECK(notices[0].severity == fulmar::Severity::info);
}

TEST_CASE("what the controller repeats every second is told every ten") {
  Notices notices;
  Forwarder texts;
  Statustext m;
  std::copy_n("RC throttle is too high to arm", 31, m.text.begin());
  for (int i = 0; i < 25; ++i) texts.forward(m, now + i * 1000 * ms, notices);
  CHECK(notices.size() == 3);
  m.text[0] = 'X';
  texts.forward(m, now + 25000 * ms, notices);
  CHECK(notices.size() == 4);
}

TEST_CASE("a line is cut, never overrun, and stays printable") {
  Line line;
  for (int i = 0; i < 30; ++i) line << "0123456789";
  CHECK(line.view().size() == 95);
  CHECK((Line() << "a\x01z").view() == "a?z");
  CHECK(Line::of(fcu_serial_messages::param_changed, "a\x01z", -42).view() ==
        "fcu_serial.param_changed(a?z, -42)");
  CHECK(Line::of(fcu_serial_messages::gnss_back, tenths_s(12'389'000'000)).view() ==
        "fcu_serial.gnss_back(12.3)");
  const std::string long_text(300, 'x');
  CHECK(Line::of(fcu_serial_messages::controller_text, long_text).view() ==
        "fcu_serial.controller_text(" + std::string(65, 'x') + "...");
}

TEST_CASE("versions are read as git describes them") {
  CHECK(major_version("v2.0.1-3-gabc").value_or(-1) == 2);
  CHECK(major_version("2.0").value_or(-1) == 2);
  CHECK(major_version("v1.3.1").value_or(-1) == 1);
  CHECK(major_version("10.1").value_or(-1) == 10);
  CHECK_FALSE(major_version("8cf6a0f"));
  CHECK_FALSE(major_version(""));
  CHECK_FALSE(major_version("v"));
}

TEST_CASE("what is wrong with a device is one sentence that says what to do") {
  LinkState link;
  Greeting g;
  const auto why = [&] { return objection(g, link, "/dev/ttyACM0", 115200); };
  CHECK(why() == "fcu_serial.device_silent(/dev/ttyACM0)");
  link.bytes = 1000;
  link.text_bytes = 999;
  CHECK(why() == "fcu_serial.text_received(/dev/ttyACM0)");
  link.text_bytes = 400;
  CHECK(why() == "fcu_serial.frames_missing_at_baud(1000, /dev/ttyACM0, 115200)");
  link.modern = 5;
  CHECK(why() ==
        "fcu_serial.frames_missing_at_baud(1000, /dev/ttyACM0, 115200)");  // so many are there by chance
  link.modern = 20;
  CHECK(why() == "fcu_serial.mavlink_2(/dev/ttyACM0)");
  link.frames = 10;
  CHECK(why() == "fcu_serial.imu_missing(/dev/ttyACM0)");
  g.autopilot = 3;
  CHECK(why() == "fcu_serial.other_autopilot(/dev/ttyACM0, 3)");
  g.autopilot = 0;
  g.imu = true;
  CHECK(why() == "fcu_serial.version_missing(/dev/ttyACM0)");
  g.versioned = true;
  g.version = "v1.3.1";
  CHECK(why() == "fcu_serial.firmware_too_old(/dev/ttyACM0, v1.3.1)");
  g.version = "v2.0.1";
  CHECK(why() == "");
  g.parameters[0] = 0;
  CHECK(why() == "fcu_serial.not_fixed_wing(/dev/ttyACM0)");
  g.parameters[0] = 1;
  CHECK(why() == "");
  g.versioned = false;
  g.armed = true;
  CHECK(why() == "");
}

}  // namespace vehicle_state_test
