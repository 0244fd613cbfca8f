// SPDX-License-Identifier: BSD-3-Clause
// Late, wrong or missing sensors, and courses through south.
#include <doctest/doctest.h>

#include <cmath>

#include "flight_bench.hpp"
#include "fulmar/flight/navigation/navigator.hpp"

namespace off_nominal_test {

using namespace synthetic;
using fulmar::navigation::Navigator;
using fulmar::navigation::Params;
using fulmar::navigation::Wander;

namespace {

constexpr double pi = std::numbers::pi;

/// Fixes of a receiver whose position moves north faster than its velocity by `extra_mps`; start and end of
/// its reported drift, s after the first fix.
struct Doubt {
  double from_s = -1, to_s = -1;
  bool wanders_at_the_end = false;
};
Doubt doubt(Wander& wander, double begin_s, double seconds, double extra_mps) {
  Doubt d;
  for (int i = 0; i <= std::lround(seconds * 5); ++i) {
    const double t = 0.2 * i;
    wander.fix({(17 + extra_mps) * t, 3 * t}, {17, 3}, 2, begin_s + t);
    if (wander.doubted() && d.from_s < 0) d.from_s = t;
    if (wander.doubted()) d.to_s = t;
  }
  d.wanders_at_the_end = wander.wanders();
  return d;
}

}  // namespace

TEST_CASE("a velocity that is believed after all is the one of when it was measured, in a turn, too") {
  Flown f{.quality = ublox};
  f.plan.duration_s = 73;
  double set_mps = 0;
  std::uint32_t count = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->velocity_mps.north += 20;
  };
  f.watch = [&](const Truth&, const VehicleState& s, Status) {
    if (s.reset_count == count) return;
    count = s.reset_count;
    set_mps = s.reset_velocity_mps.north;
  };
  f.run();
  REQUIRE(count == 1);
  CHECK(std::abs(set_mps - 20) < 0.5);
}

TEST_CASE("without a status and a fix a smooth flight is no rest when the tube feels air") {
  const auto speed_after = [](double airspeed_mps) {
    const Params p;
    VehicleState s;
    s.velocity_mps = {17, 0, 0};
    s.position_m = {0, 0, -70};
    s.origin_latitude_deg = 40.25;
    s.origin_longitude_deg = -111.65;
    s.origin_altitude_m = 1387;
    s.origin_valid = s.position_valid = true;
    Navigator n;
    n.resume(s, p, 10);
    const double rho = standard_air(1457).density_kgm3;
    for (int i = 1; i <= 1000; ++i) {  // 5 s
      n.imu(Vector3d::Zero(), Vector3d(0, 0, -isa::g0), 10 + 0.005 * i, p);
      if (i % 4 == 0) n.pitot(0.5 * rho * airspeed_mps * airspeed_mps, p);
    }
    return n.filter().state().v_n.norm();
  };
  CHECK(speed_after(17) > 15);
  CHECK(speed_after(1) < 2);  // a pitot without pressure shows rest
}

TEST_CASE(
    "the course stays within half a turn of north, through south both ways, and is that of the velocity") {
  Flown f{};
  f.plan.duration_s = 57;
  double most = 0, off = 0;
  bool south = false;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t < 12) return;
    most = std::max(most, std::abs(s.course_rad));
    off = std::max(off,
                   std::abs(wrap_pi(s.course_rad - std::atan2(s.velocity_mps.east, s.velocity_mps.north))));
    south = south || std::abs(s.course_rad) > 3;
  };
  f.run();
  CHECK(south);
  CHECK(most <= pi);
  CHECK(off < 1e-9);
}

TEST_CASE("without fixes the wind is no better known than the velocity over the ground") {
  Flown f{};
  f.plan.duration_s = 100;
  double min_ratio = 1e9, std_mps = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t > 60) s.gnss.reset();
  };
  f.watch = [&](const Truth&, const VehicleState& s, Status) {
    min_ratio = std::min({min_ratio, s.wind_std_mps.north / s.velocity_std_mps.north,
                          s.wind_std_mps.east / s.velocity_std_mps.east});
    std_mps = s.velocity_std_mps.north;
  };
  f.run();
  CHECK(std_mps > 0.5);
  CHECK(min_ratio >= 1);
}

TEST_CASE("a position that wanders is doubted for 30 s, then it is the velocity; the second time as well") {
  Wander wander;
  CHECK(doubt(wander, 0, 60, 0).from_s < 0);
  double begin = 60;
  for (int i = 0; i < 2; ++i) {
    CAPTURE(i);
    const Doubt d = doubt(wander, begin, 45, 5);
    CHECK(d.from_s > 0);
    CHECK(d.from_s < 5);
    CHECK(d.to_s - d.from_s == doctest::Approx(30).epsilon(0.02));
    CHECK(d.wanders_at_the_end);
    CHECK(doubt(wander, begin + 50, 10, 0).from_s < 0);
    begin += 70;
  }
}

}  // namespace off_nominal_test
