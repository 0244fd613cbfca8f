// SPDX-License-Identifier: BSD-3-Clause
// The resulting plan keeps clear of the zones, measured in steps of a metre along it. It is the same for the
// same seed.
#define FULMAR_COUNT_ALLOCATIONS
#include "detour.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "fulmar/testing.hpp"
#include "watch.hpp"

namespace detour_test {

using namespace fulmar;
using namespace fulmar::slow_planner;

namespace {

Waypoint point(double north, double east, double up = 70) {
  Waypoint w;
  w.position_m = {north, east, -up};
  return w;
}

Plan hourglass() {
  Plan plan;
  plan.revision = 1;
  plan.jumps = 1;
  plan.airspeed_mps = 17;
  for (const Waypoint& w : {point(400, -250), point(-400, -50, 110), point(-400, -250), point(400, -50)})
    plan.waypoints.push_back(w);
  return plan;
}

Zones crossing() {
  Zones zones;
  zones.zones.push_back({0, -150, 80});
  return zones;
}

/// Distance of the whole route from the rim of a zone, measured in steps of a metre.
double walked_clearance(const Plan& plan, const Zones& zones) {
  const Route route(plan);
  double least = 1e9;
  for (std::uint32_t i = route.closed() ? 0 : 1; i < route.size(); ++i) {
    const RouteLeg leg = route.leg(i);
    for (std::size_t k = 0; k < leg.count; ++k) {
      for (double s = 0; s <= leg[k].length_m; s += 1) {
        const Pose pose = leg[k].pose_at(s);
        for (const Zone& z : zones.zones)
          least = std::min(least, std::hypot(pose.north_m - z.north_m, pose.east_m - z.east_m) - z.radius_m);
      }
    }
  }
  return least;
}

struct Planning : Bench<Detour> {
  explicit Planning(const Plan& plan = hourglass(), std::uint64_t seed = 1) : Bench<Detour>(seed) {
    params.zones.value = crossing();
    params.iterations.value = 800;
    set(in.state, VehicleState{});
    set(in.plan, plan);
  }
  /// Steps until a plan is published, at most `steps` times.
  bool plans(int steps = 20) {
    for (int i = 0; i < steps; ++i) {
      REQUIRE(step(0.5) != Status::failed);
      if (out.plan.written) return true;
    }
    return false;
  }
  const Plan& plan() const { return out.plan.value; }
};

bool same_position(const Waypoint& a, const Waypoint& b) {
  const auto &p = a.position_m, &q = b.position_m;
  return p.north == q.north && p.east == q.east && p.down == q.down;
}

}  // namespace

TEST_CASE(
    "the plan that comes out keeps the margin from the zone and still leads over every waypoint, in order") {
  Planning planning;
  REQUIRE(walked_clearance(hourglass(), crossing()) < 0);  // the original plan crosses the zone
  CHECK(planning.step(0.5) == Status::degraded);           // one search is one leg; two legs cross the zone
  CHECK_FALSE(planning.out.plan.written);
  REQUIRE(planning.plans());
  const Plan& plan = planning.plan();
  CHECK(plan.waypoints.size() > 4);
  CHECK(walked_clearance(plan, crossing()) >= 19.9);
  CHECK(planning.out.clearance_m.value == doctest::Approx(walked_clearance(plan, crossing())).epsilon(0.05));
  std::size_t at = 0;
  const Plan before = hourglass();
  for (const Waypoint& w : before.waypoints) {
    while (at < plan.waypoints.size() && !same_position(plan.waypoints[at], w)) ++at;
    CHECK(at < plan.waypoints.size());
  }
}

TEST_CASE("a detour climbs evenly over its leg and keeps the leg's airspeed") {
  Plan before = hourglass();
  before.waypoints[1].airspeed_mps = 19;
  Planning planning(before);
  REQUIRE(planning.plans());
  const Plan& plan = planning.plan();
  std::size_t between = 0;
  double height_m = 70;
  for (std::size_t i = 1; !same_position(plan.waypoints[i], before.waypoints[1]);
       ++i, ++between) {  // 70 m to 110 m
    CHECK(-plan.waypoints[i].position_m.down > height_m);
    CHECK(plan.waypoints[i].airspeed_mps == 19);
    height_m = -plan.waypoints[i].position_m.down;
  }
  CHECK(between > 0);
  CHECK(height_m < 110);
}

TEST_CASE("one seed gives one plan, to the bit, and another seed another") {
  Planning a(hourglass(), 5), b(hourglass(), 5), c(hourglass(), 6);
  for (Planning* planning : {&a, &b, &c}) {
    for (int i = 0; i < 12; ++i) planning->step(0.5);
  }
  const auto same = [](const Plan& x,
                       const Plan& y) {  // field by field: padding bytes are undefined
    const auto as_one = [](const Waypoint& v, const Waypoint& w) {
      return same_position(v, w) && v.frame == w.frame && v.has_course == w.has_course &&
             v.course_rad == w.course_rad && v.airspeed_mps == w.airspeed_mps;
    };
    return x.revision == y.revision && x.end == y.end && x.turn_radius_m == y.turn_radius_m &&
           x.airspeed_mps == y.airspeed_mps &&
           std::equal(x.waypoints.begin(), x.waypoints.end(), y.waypoints.begin(), y.waypoints.end(), as_one);
  };
  CHECK(same(a.plan(), b.plan()));
  CHECK_FALSE(same(a.plan(), c.plan()));
}

TEST_CASE("further searches make the plan quicker, never slower") {
  Planning planning;
  planning.params.improvements.value = 10;
  REQUIRE(planning.plans());
  double last_s = planning.out.flight_s.value;
  const double first_s = last_s;
  for (int i = 0; i < 25; ++i) {
    planning.step(0.5);
    if (!planning.out.plan.written) continue;
    CHECK(planning.out.flight_s.value < last_s);
    CHECK(walked_clearance(planning.plan(), crossing()) >= 19.9);
    last_s = planning.out.flight_s.value;
  }
  CHECK(last_s <= first_s);
  // The tangents to a circle of 101 m round the zone and the arc between them are the shortest detour, on
  // each of two legs.
  const double D = std::hypot(400.0, 100.0), r = 101;
  const double longer_m =
      2 * std::sqrt(D * D - r * r) + r * (std::numbers::pi - 2 * std::acos(r / D)) - 2 * D;
  const Plan before = hourglass();
  double before_m = 0;
  for (std::uint32_t i = 0; i < 4; ++i) before_m += Route(before).leg(i).length_m;
  CHECK(longer_m == doctest::Approx(24.9).epsilon(0.01));
  CHECK(last_s > before_m / 17);
  CHECK(last_s < 1.02 * (before_m + 2 * longer_m) / 17);
}

TEST_CASE("the leg that is flown and the next one are left as they are") {
  Planning planning;
  planning.params.improvements.value = 1000;
  planning.params.iterations.value = 300;  // few, so that there is much to improve
  REQUIRE(planning.plans());
  Progress progress;
  progress.plan_revision = planning.plan().revision;
  progress.item = 0;  // on the way to the first waypoint; the next leg and the last one cross the zone
  const Plan first = planning.plan();
  Plan last = first;
  for (int i = 0; i < 40; ++i) {
    progress.plan_revision = last.revision;
    planning.set(planning.in.progress, progress);
    planning.step(0.5);
    if (planning.out.plan.written) last = planning.plan();
  }
  CHECK(last.revision > first.revision);  // the last leg was improved
  for (std::size_t i = 0; !same_position(first.waypoints[i], hourglass().waypoints[1]); ++i)
    CHECK(same_position(first.waypoints[i], last.waypoints[i]));
}

TEST_CASE(
    "a detour that bends the corner before it into another zone's margin is none: the next way is taken") {
  Plan square;
  square.revision = square.jumps = 1;
  square.airspeed_mps = 17;
  for (const Waypoint& w : {point(-400, 0), point(0, 0), point(0, 400), point(-400, 400)})
    square.waypoints.push_back(w);
  Zones zones;
  zones.zones.push_back({20, 200, 40});       // on the second leg; the route south of it is shorter
  zones.zones.push_back({-52.2, 26.6, 5.5});  // inside the corner before: clear of a turn of 90 degrees alone
  zones.zones.push_back({-122, 200, 40});  // leaves no room in the south beyond the clearance of one search
  REQUIRE(clearance(zones, Route(square).leg(1)) > 20);
  Planning planning(square);
  planning.params.zones.value = zones;
  REQUIRE(planning.plans());
  CHECK(walked_clearance(planning.plan(), zones) >= 19.9);
  CHECK(planning.plan().waypoints[2].position_m.north > 50);
}

TEST_CASE("a jump to a waypoint becomes a jump to the same waypoint") {
  Plan plan = hourglass();
  plan.jump_item = 2;
  Planning planning(plan);
  REQUIRE(planning.plans());
  REQUIRE(planning.plan().jump_item < planning.plan().waypoints.size());
  CHECK(same_position(planning.plan().waypoints[planning.plan().jump_item], plan.waypoints[2]));
}

TEST_CASE("a plan that cannot keep clear does not come out, and the next one that can does") {
  Plan inside = hourglass();
  inside.waypoints[1] = point(0, -150);
  Planning planning(inside);
  for (int i = 0; i < 6; ++i) {
    CHECK(planning.step(0.5) == Status::degraded);
    CHECK_FALSE(planning.out.plan.written);
  }
  Plan good = hourglass();
  good.revision = 2;
  planning.set(planning.in.plan, good);
  CHECK(planning.plans());
}

TEST_CASE("a plan far from the zones passes through at once, unchanged") {
  Plan plan = hourglass();
  for (Waypoint& w : plan.waypoints) w.position_m.east += 5000;
  Planning planning(plan);
  CHECK(planning.step(0.5) == Status::ok);
  REQUIRE(planning.out.plan.written);
  REQUIRE(planning.plan().waypoints.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(same_position(planning.plan().waypoints[i], plan.waypoints[i]));
}

#ifndef FULMAR_COUNTS_NOTHING  // The thread sanitizer replaces the allocation functions that count.
#define FULMAR_COUNTS_NOTHING false
#endif
TEST_CASE("it takes memory while it thinks: what it is made to show" * doctest::skip(FULMAR_COUNTS_NOTHING)) {
  Planning planning;
  planning.configure();
  CHECK(allocations([&] { planning.step(0.5); }) > 1000);
}

TEST_CASE("a zone without a radius is refused at set-up") {
  Planning planning;
  planning.params.zones.value.zones.push_back({0, 0, 0});
  CHECK(planning.configure() == Status::failed);
  CHECK(planning.error() == Detour::radius_missing(2));
}

TEST_CASE("the watch keeps the least distance from the rim") {
  Bench<Watch> bench;
  bench.params.zones.value = crossing();
  VehicleState state;
  state.position_valid = true;
  for (const double north : {300.0, 120.0, 200.0}) {
    state.position_m = {north, -150, -70};
    bench.set(bench.in.state, state);
    bench.step(0.01);
  }
  CHECK(bench.out.clearance.value.least_m == doctest::Approx(40));
  CHECK(bench.out.clearance.value.now_m == doctest::Approx(120));
}

TEST_CASE("a zone within the last orbit is clear of it, one on its rim is not") {
  Plan plan = hourglass();
  plan.end = PlanEnd::orbit;
  plan.turn_radius_m = 200;
  for (const bool on_rim : {false, true}) {
    Zones zones;
    zones.zones.push_back({400, -50 + (on_rim ? 200.0 : 100.0), 10});
    Planning planning(plan);
    planning.params.zones.value = zones;
    CHECK(planning.plans(3) == !on_rim);
    if (!on_rim) CHECK(planning.out.clearance_m.value > 20);
  }
}

}  // namespace detour_test
