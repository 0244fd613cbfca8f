// SPDX-License-Identifier: BSD-3-Clause
// The geofence of a plan: waypoints of the file and of edits in flight.
#include <doctest/doctest.h>

#include "fulmar/testing.hpp"
#include "plugins/path/planner.hpp"

namespace plan_fence_test {

using namespace fulmar;
using namespace fulmar::path;

namespace {

PlanFileWaypoint local(double north, double east, double up) {
  PlanFileWaypoint w;
  w.north_m = north;
  w.east_m = east;
  w.up_m = up;
  return w;
}

/// The answer to an edit that places a waypoint.
std::string place(Bench<Planner>& bench, PlanEditKind kind, double north) {
  PlanEdit e;
  e.kind = kind;
  e.index = 1;
  e.waypoint.position_m = {north, 100, -50};
  bench.push(bench.in.edit, e);
  bench.step(0.01);
  return bench.answer(bench.in.edit);
}

void fenced(Bench<Planner>& bench) {
  for (const double north : {0.0, 300.0, 600.0})
    bench.params.plan.value.waypoints.push_back(local(north, 100, 70));
  safety::Fence& fence = bench.params.fence.value;
  for (const auto& [n, e] : {std::pair{-200.0, -200.0}, {1000.0, -200.0}, {1000.0, 400.0}, {-200.0, 400.0}}) {
    safety::FencePoint corner;
    corner.north_m = n;
    corner.east_m = e;
    fence.corners.push_back(corner);
  }
  fence.floor_m = 30;
  fence.ceiling_m = 120;
  bench.params.fence.is_given = true;
}

}  // namespace

TEST_CASE("a waypoint outside the fence, above its ceiling or below its floor is refused by its number") {
  const auto refusal = [](double north, double up) {
    Bench<Planner> bench;
    fenced(bench);
    bench.params.plan.value.waypoints.push_back(local(north, 100, up));
    return bench.configure() == Status::failed ? std::string(bench.error()) : std::string();
  };
  CHECK(refusal(900, 119) == "");
  CHECK(refusal(3700, 70) == "plan.waypoints[3]: path.waypoint_outside_fence(2700)");
  CHECK(refusal(900, 121) == "plan.waypoints[3]: path.waypoint_above_ceiling(121.0, 120)");
  CHECK(refusal(900, 29) == "plan.waypoints[3]: path.waypoint_below_floor(29.0, 30)");
}

TEST_CASE("an edit in flight does not place a waypoint outside the fence") {
  Bench<Planner> bench;
  fenced(bench);
  bench.step(0.01);
  CHECK(place(bench, PlanEditKind::append, 900) == "accepted");
  CHECK(place(bench, PlanEditKind::append, 3700).find("path.waypoint_outside_fence(2700)") !=
        std::string::npos);
  CHECK(place(bench, PlanEditKind::replace, 1010).find("path.waypoint_outside_fence(10)") !=
        std::string::npos);
}

}  // namespace plan_fence_test
