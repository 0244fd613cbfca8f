// SPDX-License-Identifier: BSD-3-Clause
// Steps of the state are counted and published with their size.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flight_bench.hpp"

namespace reset_test {

using namespace fulmar;
using namespace synthetic;
using fulmar::navigation::Navigator;
using fulmar::navigation::Params;

namespace {

/// A reset, with the states before and after it.
struct Reset {
  double t;
  VehicleState before, after;
};

std::vector<Reset> resets_of(Flown& f) {
  std::vector<Reset> resets;
  std::optional<VehicleState> before;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (before && s.reset_count != before->reset_count) resets.push_back({x.t, *before, s});
    before = s;
  };
  f.run();
  return resets;
}

/// Change of the state beyond its velocity.
Vector3d jump(const Reset& r, double dt) {
  return eigen(r.after.position_m) - eigen(r.before.position_m) - dt * eigen(r.after.velocity_mps);
}

constexpr double dt = 1.0 / 400, metres_per_degree = 111000;

}  // namespace

TEST_CASE("a flight from the ground, and one from the air, has no reset") {
  for (const Quality& quality : {rosflight, ublox})
    for (const double from : {0.0, 47.0, 62.0}) {
      Flown f{.quality = quality, .from_s = from};
      CHECK(resets_of(f).empty());
      CHECK(f.last.reset_count == 0);
      CHECK(eigen(f.last.reset_position_m).norm() == 0);
    }
}

TEST_CASE(
    "a receiver that is 200 m off and believed in the end is a reset of 200 m, and so is its way back") {
  Flown f{};
  f.plan.duration_s = 90;
  f.set = [](Ekf::Params& p) { p.gnss_reset_after.value = 4; };
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60 && x.t < 75) s.gnss->latitude_deg += 200 / metres_per_degree;
  };
  const std::vector<Reset> resets = resets_of(f);
  REQUIRE(resets.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const Reset& r = resets[i];  // a fix that was accepted once is down-weighted after 2 s
    CHECK(r.after.reset_count == i + 1);
    CHECK(r.t == doctest::Approx(i == 0 ? 64 : 77).epsilon(0.01));
    CHECK(r.after.reset_position_m.north == doctest::Approx(i == 0 ? 200 : -200).epsilon(0.03));
    CHECK((jump(r, dt) - eigen(r.after.reset_position_m)).norm() < 1);
    CHECK(eigen(r.after.reset_velocity_mps).norm() == 0);
    CHECK(r.after.reset_yaw_rad == 0);
  }
}

TEST_CASE("velocities rejected for long and accepted at last are a reset of the velocity") {
  Flown f{};
  f.plan.duration_s = 72;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->velocity_mps.north += 20;
  };
  const std::vector<Reset> resets = resets_of(f);
  REQUIRE(resets.size() == 1);
  const Reset& r = resets[0];
  CHECK(r.after.reset_velocity_mps.north > 10);
  CHECK((eigen(r.after.velocity_mps) - eigen(r.before.velocity_mps) - eigen(r.after.reset_velocity_mps))
            .norm() < 0.5);
}

TEST_CASE("a height that no flight resolves by degrees is a reset of the height") {
  Flown f{};
  f.plan.duration_s = 75;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->altitude_m += 150;
  };
  const std::vector<Reset> resets = resets_of(f);
  REQUIRE(resets.size() == 1);
  CHECK(resets[0].after.reset_position_m.down == doctest::Approx(-150).epsilon(0.1));
  CHECK(std::abs(resets[0].after.reset_position_m.north) < 0.5);
}

TEST_CASE("found again after a gap is one reset, from the state that stood in for it") {
  Flown f{};
  f.plan.duration_s = 65;
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t > 60 && x.t < 61.5) s.imu.rate_radps.x = std::numeric_limits<double>::quiet_NaN();
  };
  const std::vector<Reset> resets = resets_of(f);
  REQUIRE(resets.size() == 1);
  const Reset& r = resets[0];
  CHECK(r.t > 61.5);
  CHECK(eigen(r.after.reset_position_m).norm() > 15);  // it moved at 17 m/s
  CHECK((eigen(r.after.position_m) - eigen(r.before.position_m) - eigen(r.after.reset_position_m)).norm() <
        0.1);
  CHECK((eigen(r.after.velocity_mps) - eigen(r.before.velocity_mps) - eigen(r.after.reset_velocity_mps))
            .norm() < 0.1);
  CHECK(std::abs(wrap_pi(r.after.yaw_rad - r.before.yaw_rad - r.after.reset_yaw_rad)) < 0.01);
}

TEST_CASE("without a magnetometer the course of the take-off run resets the yaw") {
  Flown f{};
  f.plan.duration_s = 20;
  f.alter = [](const Truth&, Samples& s) { s.mag.reset(); };
  const std::vector<Reset> resets = resets_of(f);
  REQUIRE(resets.size() == 1);
  const Reset& r = resets[0];
  CHECK(std::abs(wrap_pi(r.after.yaw_rad - r.before.yaw_rad - r.after.reset_yaw_rad)) < 0.02);
  CHECK(std::abs(wrap_pi(r.after.yaw_rad - f.plan.initial_course_rad)) < 0.1);
}

TEST_CASE("after a switch the count continues") {
  VehicleState s;
  s.attitude_valid = s.velocity_valid = s.position_valid = true;
  s.reset_count = 3;
  s.reset_yaw_rad = 0.5;
  Navigator n;
  n.resume(s, Params{}, 10);
  CHECK(n.resets().count == 3);
  CHECK(n.resets().yaw_rad == 0.5);
}

}  // namespace reset_test
