// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_report/judged.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/log/events.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "tools/fulmar_report/test/report_kit.hpp"

namespace report_test {

namespace {

const report::JudgedSeries& of(const std::vector<report::JudgedSeries>& all, const std::string& words) {
  for (const report::JudgedSeries& s : all)
    if (s.words == words) return s;
  FAIL(words << " is not there");
  return all.front();
}

}  // namespace

TEST_CASE("errors are estimate minus truth, with the reported standard deviation") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    for (int i = 0; i < 100; ++i) {  // north is 0.5 m off, one time in ten -2 m; 1 m is reported
      VehicleState s = state(1), truth = state(0);
      s.position_m.north = i % 10 == 3 ? -2 : 0.5;
      s.roll_rad = 0.01;
      truth.airspeed_valid = false;
      log.write("/vehicle/truth", i * 20 * ms, truth);
      log.write("/nav/state", i * 20 * ms, s);
    }
  }
  const auto all = report::judged_estimates(states::look_for_states(file));
  REQUIRE(all.size() == 1);
  CHECK(all[0].topic == "/nav/state");
  CHECK(all[0].reference == "/vehicle/truth");
  CHECK(all[0].truth);
  const report::JudgedSeries& north = of(all[0].series, "position north");
  CHECK(north.all.n == 100);
  CHECK(north.all.mean() == doctest::Approx(0.25));
  CHECK(north.all.rms() == doctest::Approx(std::sqrt((90 * 0.25 + 10 * 4) / 100)));
  CHECK(north.all.most == -2);
  CHECK(north.claimed.claim() == doctest::Approx(1));
  CHECK(north.claimed.share_1() == doctest::Approx(0.9));
  CHECK(north.claimed.share_2() == doctest::Approx(0.9));  // 2 is not within 2
  CHECK(north.columns.t[3] == 600);
  CHECK(north.columns.values[0][3] == -2.f);
  CHECK(north.columns.values[1][3] == 1.f);
  CHECK(of(all[0].series, "roll").all.rms() == doctest::Approx(0.5729578));
  CHECK(of(all[0].series, "gyro bias x").has_claim() == false);
  for (const report::JudgedSeries& s : all[0].series) CHECK(s.words != "airspeed");
  const nlohmann::json j = judged_json(all[0], 50);
  CHECK(j["truth"] == true);
  const nlohmann::json row = j["rows"][6];
  CHECK(row["words"] == "position north");
  CHECK(row["rows"] == 50);
  const report::Columns drawn = columns_of(row["data"], 50, 2);
  CHECK(std::count(drawn.values[0].begin(), drawn.values[0].end(), -2.f) == 10);
  CHECK(j["rows"][12].contains("claimed") == false);
}

TEST_CASE("without a truth the fixes of a receiver are the reference, marked as no truth") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap";
  {
    Log log(file);
    const LocalFrame frame(47, 8, 400);
    for (int i = 0; i < 50; ++i) {
      VehicleState s = state(1);
      s.origin_latitude_deg = 47;
      s.origin_longitude_deg = 8;
      s.origin_altitude_m = 400;
      s.position_m = {10, 20, -30};
      s.height_m = 30;
      log.write("/nav/state", i * 20 * ms, s);
      Gnss fix;
      const LocalFrame::Geodetic at = frame.from_ned({7, 20, -30});
      fix.latitude_deg = at.lat_deg;
      fix.longitude_deg = at.lon_deg;
      fix.altitude_m = at.alt_m;
      fix.fix = FixType::fix_3d;
      fix.horizontal_std_m = fix.vertical_std_m = fix.speed_std_mps = 1;
      log.write("/vehicle/gnss", i * 20 * ms, fix);
    }
  }
  const auto all = report::judged_estimates(states::look_for_states(file));
  REQUIRE(all.size() == 1);
  CHECK(all[0].reference == "/vehicle/gnss");
  CHECK_FALSE(all[0].truth);
  CHECK(of(all[0].series, "position north").all.mean() == doctest::Approx(3).epsilon(1e-4));
  CHECK(of(all[0].series, "position north").claimed.claim() == doctest::Approx(std::sqrt(2.0)));
  for (const report::JudgedSeries& s : all[0].series) CHECK(s.words != "roll");
}

TEST_CASE("a truth in place of an estimate and an estimate without a reference have no errors") {
  const Folder folder;
  const std::string same = folder.path / "same.mcap", alone = folder.path / "alone.mcap";
  {
    Log a(same), b(alone);
    for (int i = 0; i < 20; ++i) {
      a.write("/vehicle/truth", i * 20 * ms, state(0));
      a.write("/nav/state", i * 20 * ms, state(0));
      b.write("/nav/state", i * 20 * ms, state(1));
    }
  }
  CHECK(report::judged_estimates(states::look_for_states(same)).empty());
  CHECK(report::judged_estimates(states::look_for_states(alone)).empty());
}

TEST_CASE("a repeated innovation counts once; fixes are by axis if the filter reports axes") {
  const Folder folder;
  const std::string with = folder.path / "with.mcap", without = folder.path / "without.mcap";
  {
    Log a(with), b(without);
    for (int i = 0; i < 40; ++i) {
      NavigationHealth h;
      h.baro.accepted = static_cast<std::uint32_t>(i / 4 + 1);
      h.baro.innovation_ratio = i < 4 ? 3 : -0.5;
      h.gnss_height.refused = static_cast<std::uint32_t>(i + 1);
      h.gnss_height.innovation_ratio = 1.5;
      a.write("/nav/health", i * 100 * ms, h);
      b.write("/nav/health", i * 100 * ms, h);
      FilterCheck check;
      check.position_innovation_ratio = {0.5, -0.5, 2.5};
      a.write("/ekf/check", i * 100 * ms, check);
    }
  }
  const auto all = report::innovations(states::look_for_states(with));
  const report::JudgedSeries& baro = of(all, "barometer");
  CHECK(baro.all.n == 10);
  CHECK(baro.all.mean() == doctest::Approx((3 - 9 * 0.5) / 10));
  CHECK(baro.claimed.share_1() == doctest::Approx(0.9));
  CHECK(baro.columns.t[1] == 4000);
  CHECK(of(all, "GNSS position down").all.rms() == doctest::Approx(2.5));
  CHECK(of(all, "GNSS position down").claimed.share_2() == 0);
  CHECK(of(all, "GNSS position east").claimed.share_1() == 1);
  for (const report::JudgedSeries& s : all) CHECK(s.words != "GNSS height");
  for (const report::JudgedSeries& s : all) CHECK(s.words != "magnetometer");  // never measured
  CHECK(of(report::innovations(states::look_for_states(without)), "GNSS height").all.n == 40);
}

TEST_CASE("times between ticks: mean, the 99th percentile, the largest") {
  const Folder folder;
  const std::string file = folder.path / "a.mcap", none = folder.path / "none.mcap";
  {
    Log log(file), other(none);
    other.write("/nav/state", 0, state(1));
    for (int i = 0; i < 10; ++i) {
      core::Ticks ticks;
      ticks.first = static_cast<std::uint64_t>(10 * i);
      ticks.periods = ticks.hashes = 10;
      for (std::size_t k = 0; k < 10; ++k) ticks.period_ns[k] = 2'500'000;
      if (i == 0) ticks.period_ns[0] = 0;  // the first of the flight
      if (i == 7) ticks.period_ns[3] = 4'000'000;
      log.write_as(core::Ticks::topic, *core::host_type<core::Ticks>(), 100 * i * ms, &ticks);
    }
  }
  const nlohmann::json t = report::tick_times(file);
  CHECK(t["n"] == 99);
  CHECK(t["mean_ms"].get<double>() == doctest::Approx((98 * 2.5 + 4) / 99));
  CHECK(t["p99_ms"].get<double>() == 2.5);
  CHECK(t["max_ms"].get<double>() == 4);
  CHECK(report::tick_times(none).is_null());
}

}  // namespace report_test
