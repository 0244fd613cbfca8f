// SPDX-License-Identifier: BSD-3-Clause
// A sensor with constant readings for 40 s of flight, including climb and turns: the estimator learns nothing
// from it, and uses it again afterwards.
#include <doctest/doctest.h>

#include "flight_bench.hpp"

namespace stuck_test {

using namespace synthetic;

namespace {

constexpr double deg = std::numbers::pi / 180;

struct Worst {
  double level_m = 0, height_m = 0, velocity_mps = 0, tilt_rad = 0, yaw_rad = 0, airspeed_mps = 0;
  void see(const Truth& x, const VehicleState& s) {
    const Vector3d p = eigen(s.position_m) - x.p_n, v = eigen(s.velocity_mps) - x.v_n;
    const Euler e = euler_from(x.q_nb);
    const auto most = [](double& worst, double now) { worst = std::max(worst, std::abs(now)); };
    most(level_m, p.head<2>().norm());
    most(height_m, p.z());
    most(velocity_mps, v.norm());
    most(tilt_rad, std::hypot(wrap_pi(s.roll_rad - e.roll_rad), s.pitch_rad - e.pitch_rad));
    most(yaw_rad, wrap_pi(s.yaw_rad - e.yaw_rad));
    most(airspeed_mps, s.airspeed_mps - x.airspeed());
  }
};

/// Largest errors during the fault, and from ten seconds after it.
std::pair<Worst, Worst> fly_with(const std::function<void(Samples& now, const Samples& first)>& hold,
                                 double from_s = 20) {
  Flown f{.quality = ublox};
  f.plan.duration_s = from_s + 70;
  Samples kept;
  f.alter = [&](const Truth& x, Samples& s) {
    if (x.t < from_s || x.t > from_s + 40) return;
    if (s.gnss && !kept.gnss) kept.gnss = s.gnss;
    if (s.mag && !kept.mag) kept.mag = s.mag;
    if (s.baro && !kept.baro) kept.baro = s.baro;
    if (s.pitot && !kept.pitot) kept.pitot = s.pitot;
    hold(s, kept);
  };
  Worst during, after;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t > from_s && x.t <= from_s + 40) during.see(x, s);
    if (x.t > from_s + 50) after.see(x, s);
  };
  f.run();
  return {during, after};
}

}  // namespace

TEST_CASE("a receiver whose position is stuck does not hold the aircraft back") {
  const auto [during, after] = fly_with([](Samples& s, const Samples& first) {
    if (!s.gnss) return;
    s.gnss->latitude_deg = first.gnss->latitude_deg;
    s.gnss->longitude_deg = first.gnss->longitude_deg;
  });
  CHECK(during.level_m < 15);
  CHECK(during.velocity_mps < 1.5);
  CHECK(after.level_m < 8);
}

TEST_CASE("a receiver that is stuck as a whole is one that is not there") {
  const auto [stuck, stuck_after] = fly_with([](Samples& s, const Samples& first) {
    if (s.gnss) s.gnss = first.gnss;
  });
  const auto [gone, gone_after] = fly_with([](Samples& s, const Samples&) { s.gnss.reset(); });
  CHECK(stuck.level_m < 2 * gone.level_m + 20);
  CHECK(stuck.tilt_rad < 4 * deg);
  CHECK(stuck.height_m < 8);
  CHECK(stuck_after.level_m < 8);
  CHECK(stuck_after.velocity_mps < 1.5);
}

TEST_CASE("a barometer that is stuck in a climb does not hold the height") {
  const auto [during, after] = fly_with([](Samples& s, const Samples& first) {
    if (s.baro) s.baro = first.baro;
  });
  CHECK(during.height_m < 8);
  CHECK(after.height_m < 8);
}

TEST_CASE("a compass that is stuck in turns does not turn the estimate") {
  const auto [during, after] = fly_with([](Samples& s, const Samples& first) {
    if (s.mag) s.mag = first.mag;
  });
  CHECK(during.yaw_rad < 5 * deg);
  CHECK(after.yaw_rad < 5 * deg);
}

TEST_CASE("a tube that is stuck does not hold the airspeed") {
  const auto [during, after] = fly_with(
      [](Samples& s, const Samples& first) {
        if (s.pitot) s.pitot = first.pitot;
      },
      60);
  CHECK(during.airspeed_mps < 4);
  CHECK(after.airspeed_mps < 3);
}

}  // namespace stuck_test
