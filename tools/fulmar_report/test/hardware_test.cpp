// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_report/hardware.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "plugins/fcu_serial/reports.hpp"
#include "tools/fulmar_report/test/report_kit.hpp"

namespace report_test {

namespace {

VehicleStatus status(bool armed, bool override, bool in_control, double volt, double amp, double rc_age_s) {
  VehicleStatus s;
  s.armed = armed;
  s.override = override;
  s.in_control = in_control;
  s.battery_volt = volt;
  s.battery_amp = amp;
  s.rc_age_s = rc_age_s;
  return s;
}

fcu::ControllerParameter parameter(const char* name, const char* value) {
  fcu::ControllerParameter p;
  p.name = name;
  p.value = value;
  return p;
}

}  // namespace

TEST_CASE("a log of hardware has the flight controller and the times in control") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    Notice hello;
    hello.text = "connected: ROSflight v2.0.1";
    log.write("/vehicle/notices", 0, hello);
    log.write("/fcu/parameters", 100 * ms, parameter("ACC_X_BIAS", "0.25"));
    log.write("/fcu/parameters", 110 * ms, parameter("RC_NUM_CHN", "8"));
    log.write("/fcu/parameters", 900 * ms, parameter("RC_NUM_CHN", "6"));
    log.write("/vehicle/status", 0, status(false, true, false, 25, 0, 1e9));
    log.write("/vehicle/status", 1000 * ms, status(true, true, false, 24.5, 3, 0.01));
    log.write("/vehicle/status", 4000 * ms, status(true, false, true, 23, 31, 0.4));
    log.write("/vehicle/status", 9000 * ms, status(true, false, false, 23.5, 2, 0.1));
    log.write("/vehicle/status", 9500 * ms, status(false, true, false, 24, 0, 30));
    fcu::LinkStatus link;
    link.frames = 1000;
    link.missing = 7;
    link.worst_gap_s = 0.25;
    log.write("/fcu/link", 9000 * ms, link);
  }
  const nlohmann::json h = report::hardware_of(file);
  CHECK(h["firmware"] == "ROSflight v2.0.1");
  CHECK(h["calibration"] == nlohmann::json{{"ACC_X_BIAS", "0.25"}});
  CHECK(h["parameters_changed"] == 1);
  CHECK(h["who_flew_s"]["disarmed"].get<double>() == doctest::Approx(1));
  CHECK(h["who_flew_s"]["pilot"].get<double>() == doctest::Approx(3));
  CHECK(h["who_flew_s"]["computer"].get<double>() == doctest::Approx(5));
  CHECK(h["who_flew_s"]["neither"].get<double>() == doctest::Approx(0.5));
  CHECK(h["battery"]["first_volt"] == 25);
  CHECK(h["battery"]["least_volt"] == 23);
  CHECK(h["battery"]["last_volt"] == 24);
  CHECK(h["battery"]["most_amp"] == 31);
  CHECK(h["radio_age_max_s"] == 0.4);  // disarmed it may be off
  CHECK(h["link"]["missing"] == 7);
  CHECK(h["link"]["worst_gap_s"] == 0.25);
}

TEST_CASE("a log of simulation has no controller, and missing figures are null") {
  const Folder folder;
  const std::string sim = folder.path / "sim.mcap", bare = folder.path / "bare.mcap";
  {
    Log log(sim);
    log.write("/vehicle/status", 0, status(true, false, true, 25, 1, 0));
  }
  {
    Log log(bare);
    log.write("/fcu/link", 0, fcu::LinkStatus{});
  }
  CHECK(report::hardware_of(sim).is_null());
  const nlohmann::json h = report::hardware_of(bare);
  for (const char* key : {"firmware", "calibration", "battery", "radio_age_max_s", "who_flew_s"}) {
    CAPTURE(key);
    CHECK(h[key].is_null());
  }
}

}  // namespace report_test
