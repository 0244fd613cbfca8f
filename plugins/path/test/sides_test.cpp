// SPDX-License-Identifier: BSD-3-Clause
// Mirror images: results to the right and to the left, and an edit at the item of a jump.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/testing.hpp"
#include "plugins/path/manager.hpp"
#include "plugins/path/planner.hpp"
#include "plugins/path/vector_field.hpp"

namespace sides_test {

using namespace fulmar;

namespace {
VehicleState at(double north, double east, double course) {
  VehicleState s;
  s.position_m = {north, east, -50};
  s.height_m = 50;
  s.airspeed_mps = s.ground_speed_mps = 17;
  s.course_rad = s.yaw_rad = course;
  s.airspeed_valid = s.attitude_valid = s.velocity_valid = s.height_valid = s.position_valid = true;
  return s;
}
}  // namespace

TEST_CASE("a climbing arc, left or right, gives the height where the aircraft is") {
  for (const Turn turn : {Turn::left, Turn::right}) {
    const double side = turn == Turn::right ? 1 : -1, azimuth = side * 0.1;
    Path path;
    path.kind = PathKind::orbit;
    path.turn = turn;
    path.origin_m = {0, 0, -50};
    path.radius_m = 100;
    path.climb_ratio = 0.05;
    path.start_rad = -azimuth;  // 0.2 rad along the arc
    Bench<path::VectorField> bench;
    bench.set(bench.in.state,
              at(100 * std::cos(azimuth), 100 * std::sin(azimuth), azimuth + side * std::numbers::pi / 2));
    bench.set(bench.in.path, path);
    bench.step(0.01);
    CHECK(bench.out.command.height_m - 50 == doctest::Approx(0.05 * 100 * 0.2));
  }
}

TEST_CASE("blown off the way to the plan, to the left or to the right: a new one is drawn") {
  for (const double side : {-1.0, 1.0}) {
    Bench<path::Manager> bench;
    Plan plan;
    plan.revision = 1;
    plan.turn_radius_m = 50;
    for (const double north : {3000.0, 4000.0}) {
      Waypoint w;
      w.position_m = {north, 0, -50};
      plan.waypoints.push_back(w);
    }
    bench.set(bench.in.plan, plan);
    double off = 0;
    for (int i = 0; i < 1500; ++i) {
      const VehicleState s = at(0.12 * i, side * 0.12 * i, i == 0 ? 0 : side * std::numbers::pi / 4);
      bench.set(bench.in.state, s);
      bench.step(0.01);
      const Path& path = bench.out.path.value;
      const double n = s.position_m.north - path.origin_m.north, e = s.position_m.east - path.origin_m.east;
      off = path.kind == PathKind::line ? path.direction_ratio.north * e - path.direction_ratio.east * n
                                        : std::hypot(n, e) - path.radius_m;
    }
    CHECK(std::abs(off) < 60);
  }
}

TEST_CASE("removing the waypoint that is jumped to leads to the one behind it") {
  Bench<path::Planner> bench;
  for (const double north : {0.0, 300.0, 600.0}) {
    path::PlanFileWaypoint w;
    w.north_m = north;
    w.east_m = 100;
    w.up_m = 70;
    bench.params.plan.value.waypoints.push_back(w);
  }
  bench.step(0.01);
  const auto jump_to_and_remove = [&](std::uint32_t index) {
    PlanEdit edit;
    edit.kind = PlanEditKind::set_current;
    edit.index = index;
    bench.push(bench.in.edits, edit);
    edit.kind = PlanEditKind::remove;
    bench.push(bench.in.edits, edit);
    bench.step(0.01);
  };
  jump_to_and_remove(1);
  REQUIRE(bench.out.plan.value.jump_item == 1);
  CHECK(bench.out.plan.value.waypoints[1].position_m.north == 600);
  jump_to_and_remove(0);
  CHECK(bench.out.plan.value.jump_item == 0);
}

}  // namespace sides_test
