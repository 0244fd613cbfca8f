// SPDX-License-Identifier: BSD-3-Clause
// The score where only a path is wired, on slopes and to either side.
#include <doctest/doctest.h>

#include "fulmar/testing.hpp"
#include "plugins/score/score.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::score;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi;

/// Of samples that stand `above_m` above and `right_m` to the right of the path, half of them with the
/// signs turned round.
template <class Place>
TrackingError score_of(const Path& path, const Place& place, double above_m, double right_m) {
  Bench<Score> bench;
  TrackingError error;
  for (int i = 0; i < 300; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    VehicleState s = place(0.01 * i, sign * right_m);
    s.position_m.down -= sign * above_m;
    s.height_m = -s.position_m.down;
    s.airspeed_mps = s.ground_speed_mps = 17;
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
    bench.set(bench.in.path, path);
    bench.set(bench.in.state, s);
    bench.step(0.01);
    if (bench.out.tracking.written) error = bench.out.tracking.value;
  }
  return error;
}

}  // namespace

TEST_CASE("a climb of 10 % exactly on a line has no error; beside it the error is what was put in") {
  for (const double course : {0.5, 2.0, -2.6}) {
    CAPTURE(course);
    Path path;
    path.kind = PathKind::line;
    path.origin_m = {100, -50, -60};
    const double level = 1 / std::hypot(1, 0.1);
    path.direction_ratio = {level * std::cos(course), level * std::sin(course), -0.1 * level};
    const auto place = [&](double t, double right) {
      VehicleState s;
      s.position_m = {100 + 17 * t * std::cos(course) - right * std::sin(course),
                      -50 + 17 * t * std::sin(course) + right * std::cos(course), -60 - 1.7 * t};
      return s;
    };
    CHECK(score_of(path, place, 0, 0).altitude_m < 1e-9);
    const TrackingError beside = score_of(path, place, 2, 3);
    CHECK(beside.altitude_m == Approx(2));
    CHECK(beside.north_m == Approx(3 * std::abs(std::sin(course))));
    CHECK(beside.east_m == Approx(3 * std::abs(std::cos(course))));
  }
}

TEST_CASE("a climbing circle has no error on it, to either side; above it the error is what was put in") {
  for (const double side : {1.0, -1.0}) {
    Path path;
    path.kind = PathKind::orbit;
    path.turn = side > 0 ? Turn::right : Turn::left;
    path.origin_m = {100, -50, -60};
    path.radius_m = 80;
    path.start_rad = 1.1;
    path.climb_ratio = 0.05;
    const auto place = [&](double t, double right) {
      const double azimuth = 1.1 + side * 17 * t / 80, R = 80 - side * right;
      VehicleState s;
      s.position_m = {100 + R * std::cos(azimuth), -50 + R * std::sin(azimuth), -60 - 0.05 * 17 * t};
      return s;
    };
    CHECK(score_of(path, place, 0, 0).altitude_m < 1e-9);
    const TrackingError beside = score_of(path, place, 2, 3);
    CHECK(beside.altitude_m == Approx(2));
    CHECK(std::hypot(beside.north_m, beside.east_m) == Approx(3));
  }
}

TEST_CASE("on the final circle the error is the way to it, off its middle by the radius, to the north") {
  for (const auto& [north, east, error_north, error_east] :
       {std::tuple{0.0, 0.0, 60.0, 0.0}, {70 * 0.6, 70 * 0.8, 6.0, 8.0}, {-50 * 0.8, 50 * 0.6, 8.0, 6.0}}) {
    Bench<Score> bench;
    Plan plan;
    plan.revision = 1;
    plan.end = PlanEnd::orbit;
    plan.turn_radius_m = 60;
    Waypoint w;
    w.position_m = {100, -50, -70};
    plan.waypoints.push_back(w);
    Progress progress;
    progress.items = progress.reached = 1;
    progress.plan_revision = 1;
    progress.finished = true;
    TrackingError error;
    for (int i = 0; i < 200; ++i) {
      VehicleState s;
      s.position_m = {100 + north, -50 + east, -70};
      s.height_m = 70;
      s.airspeed_mps = s.ground_speed_mps = 17;
      s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
      bench.set(bench.in.plan, plan);
      bench.set(bench.in.progress, progress);
      bench.set(bench.in.state, s);
      bench.step(0.01);
      if (bench.out.tracking.written) error = bench.out.tracking.value;
    }
    CHECK(error.north_m == Approx(error_north));
    CHECK(std::abs(error.east_m - error_east) < 1e-9);
  }
}

TEST_CASE("an estimate counts only while position, attitude and velocity are valid, all of them") {
  for (int invalid = 0; invalid <= 3; ++invalid) {
    Bench<Score> bench;
    bool counted = false;
    for (int i = 0; i < 2500; ++i) {
      VehicleState s;
      s.position_m = {0.2 * i, 0, -70};
      s.velocity_mps = {20, 0, 0};
      s.height_m = 70;
      s.airspeed_mps = s.ground_speed_mps = 20;
      s.origin_latitude_deg = 40;
      s.origin_valid = true;
      s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
      bench.set(bench.in.truth, s);
      if (invalid == 1) s.position_valid = false;
      if (invalid == 2) s.attitude_valid = false;
      if (invalid == 3) s.velocity_valid = false;
      bench.set(bench.in.state, s);
      bench.step(0.01);
      counted = counted || bench.out.estimation.written;
    }
    CHECK(counted == (invalid == 0));
  }
}

}  // namespace off_nominal_test
