// SPDX-License-Identifier: BSD-3-Clause
// Routes: fillets by their geometry, joints by continuity, the closest point by brute force, and robustness
// against unusual plans.
#include "fulmar/flight/path/route.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <vector>

#include "fulmar/random.hpp"

namespace route_test {

using namespace fulmar;

namespace {

constexpr double pi = std::numbers::pi;

Waypoint point(double north, double east, double up = 70) {
  Waypoint w;
  w.position_m = {north, east, -up};
  return w;
}

Plan plan_of(std::initializer_list<Waypoint> waypoints, PlanEnd end = PlanEnd::circuit) {
  Plan plan;
  plan.end = end;
  for (const Waypoint& w : waypoints) plan.waypoints.push_back(w);
  return plan;
}

Plan random_plan(Random& rng, std::uint32_t n, double reach) {
  Plan plan;
  for (std::uint32_t i = 0; i < n; ++i) {
    Waypoint w = point(reach * rng.uniform(-1, 1), reach * rng.uniform(-1, 1), rng.uniform(40, 120));
    w.has_course = rng.uniform() < 0.3;
    w.course_rad = rng.uniform(-4, 7);
    if (i > 0 && rng.uniform() < 0.1) w.position_m = plan.waypoints[i - 1].position_m;  // duplicate
    if (i > 1 && rng.uniform() < 0.1) w.position_m = plan.waypoints[i - 2].position_m;  // back again
    if (i > 1 && rng.uniform() < 0.1)
      w.position_m =
          2.0 * plan.waypoints[i - 1].position_m - plan.waypoints[i - 2].position_m;  // straight on
    plan.waypoints.push_back(w);
  }
  plan.end = rng.uniform() < 0.3 ? PlanEnd::orbit : PlanEnd::circuit;
  return plan;
}

double distance(const Pose& a, const Pose& b) {
  return std::hypot(a.north_m - b.north_m, a.east_m - b.east_m);
}
double distance(const Pose& a, const Waypoint& w) {
  return std::hypot(a.north_m - w.position_m.north, a.east_m - w.position_m.east);
}

bool has_kind(const RouteLeg& leg, PathKind kind) {
  for (std::size_t i = 0; i < leg.count; ++i) {
    if (leg[i].kind == kind) return true;
  }
  return false;
}

/// Each piece starts at the end of the one before, in its direction and at its height.
void check_joints(const RouteLeg& leg) {
  for (std::size_t i = 0; i + 1 < leg.count; ++i) {
    const Pose end = leg[i].pose_at(leg[i].length_m), begin = leg[i + 1].pose_at(0);
    CHECK(distance(end, begin) < 1e-5);
    CHECK(std::abs(wrap_pi(end.course_rad - begin.course_rad)) < 1e-6);
    CHECK(std::abs(leg[i].height_at(leg[i].length_m) - leg[i + 1].height_m) < 1e-9);
  }
  const RoutePiece& last = leg[leg.count - 1];
  CHECK(distance(last.pose_at(last.length_m), leg.end) < 1e-5);
}

}  // namespace

TEST_CASE("a square corner is rounded by a quarter circle that touches both legs one radius away from it") {
  const Plan plan = plan_of({point(0, 0), point(400, 0), point(400, 400), point(0, 400)});
  const Route route(plan);
  const Passage corner = route.passage(1);
  CHECK(corner.turn_rad == doctest::Approx(pi / 2));
  CHECK(corner.entry.north_m == doctest::Approx(350));
  CHECK(corner.entry.east_m == doctest::Approx(0));
  CHECK(corner.exit.north_m == doctest::Approx(400));
  CHECK(corner.exit.east_m == doctest::Approx(50));
  CHECK(distance(corner.middle, plan.waypoints[1]) == doctest::Approx(50 * (std::sqrt(2) - 1)));
  // B&M (11.3): the centre is R / sin(rho / 2) from the corner, on the bisector
  const RouteLeg leg = route.leg(1);
  REQUIRE(leg.count == 3);
  CHECK(leg[2].north_m == doctest::Approx(350));
  CHECK(leg[2].east_m == doctest::Approx(50));
  CHECK(leg[2].turn == Turn::right);
}

TEST_CASE("a lap of the hourglass is as long as its legs less the cut corners") {
  Plan plan = plan_of({point(400, -250), point(-400, -50), point(-400, -250), point(400, -50)});
  const double turn = pi - std::atan2(800, 200), R = plan.turn_radius_m;  // turn at each corner
  const double expected = 2 * std::hypot(800, 200) + 2 * 200 + 4 * (R * turn - 2 * R * std::tan(turn / 2));
  double length = 0;
  const Route route(plan);
  for (std::uint32_t i = 0; i < 4; ++i) length += route.leg(i).length_m;
  CHECK(length == doctest::Approx(expected));
}

TEST_CASE("a fillet is used exactly while its tangent, R tan(turn / 2), fits on the leg") {
  const double turn = 2.0, tangent = 50 * std::tan(turn / 2);
  for (const double leg : {tangent * 0.99, tangent * 1.01}) {
    Plan plan = plan_of({point(-1000, 0), point(0, 0), point(leg * std::cos(turn), leg * std::sin(turn)),
                         point(-3000, 3000)});
    plan.waypoints[2].has_course = true;  // needs no length on the leg
    CHECK((Route(plan).passage(1).turn_rad != 0) == (leg > tangent));
  }
}

TEST_CASE(
    "fillets that would overlap on their common leg are not used, and both waypoints are passed through") {
  const auto zigzag = [](double spacing) {
    return plan_of({point(0, 0), point(600, 0), point(600, spacing), point(0, spacing)});
  };
  const Plan wide = zigzag(101), narrow = zigzag(99);
  CHECK(Route(wide).passage(1).turn_rad == doctest::Approx(pi / 2));
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Passage passage = Route(narrow).passage(i);
    CHECK(passage.turn_rad == 0);
    CHECK(distance(passage.middle, narrow.waypoints[i]) < 1e-9);
  }
  // the long legs stay straight lines; the turns are flown beyond them
  const RouteLeg leg = Route(narrow).leg(1);
  CHECK(leg.length_m == doctest::Approx(600));
  CHECK_FALSE(has_kind(leg, PathKind::orbit));
}

TEST_CASE("a waypoint with a course is passed in that course") {
  Plan plan = plan_of({point(0, 0), point(500, 100), point(0, 500)});
  plan.waypoints[1].has_course = true;
  plan.waypoints[1].course_rad = 1.15;
  const RouteLeg leg = Route(plan).leg(1);
  CHECK(distance(leg.end, plan.waypoints[1]) < 1e-9);
  CHECK(leg.end.course_rad == doctest::Approx(1.15));
  check_joints(leg);
}

TEST_CASE("collinear waypoints lie on one straight route, whatever the rounding") {
  Random rng(3);
  for (int i = 0; i < 2000; ++i) {
    const double n = rng.uniform(-900, 900), e = rng.uniform(-900, 900), k = rng.uniform(1.5, 4);
    if (std::hypot(n, e) < 100) continue;
    const Plan plan = plan_of({point(0, 0), point(n, e), point(k * n, k * e), point(-e, n)});
    const RouteLeg leg = Route(plan).leg(1);
    const Pose passage = Route(plan).passage(1).middle;
    CHECK(distance(passage, plan.waypoints[1]) < 1e-6);
    CHECK(std::isfinite(leg.length_m));
  }
}

TEST_CASE("two waypoints are flown there and back, through both, by turns that can be flown") {
  const Plan plan = plan_of({point(0, 0), point(300, 0)});
  const Route route(plan);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const RouteLeg leg = route.leg(i);
    CHECK(distance(leg.end, plan.waypoints[i]) < 1e-9);
    CHECK(leg.length_m > 300 + 50);
    CHECK(leg.length_m < 300 + 4 * pi * 50);
    check_joints(leg);
  }
}

TEST_CASE(
    "random plans with duplicates, reversals and courses: finite, joined without kink or step, of the plan's "
    "radius") {
  Random rng(17);
  for (int trial = 0; trial < 400; ++trial) {
    const std::uint32_t n = 2 + static_cast<std::uint32_t>(rng.uniform(0, 10));
    const Plan plan = random_plan(rng, n, trial % 3 == 0 ? 150 : 1500);
    const Route route(plan);
    if (route.is_point()) continue;
    for (std::uint32_t i = route.closed() ? 0 : 1; i < n; ++i) {
      const RouteLeg leg = route.leg(i), before = i > 1 || route.closed() ? route.leg(route.before(i)) : leg;
      REQUIRE(leg.count >= 1);
      REQUIRE(std::isfinite(leg.length_m));
      check_joints(leg);
      if (i > 1 || route.closed()) {
        const Pose begin = leg[0].pose_at(0);
        CHECK(distance(before.end, begin) < 1e-5);
        CHECK(std::abs(wrap_pi(before.end.course_rad - begin.course_rad)) < 1e-5);
      }
      for (std::size_t k = 0; k < leg.count; ++k)
        CHECK((leg[k].kind == PathKind::line || std::abs(leg[k].radius_m - 50) < 1e-9));
      const double slope = leg[0].climb_ratio;
      if (std::abs(slope) < 1 && leg.length_m > 0) {
        CHECK(leg[0].height_m == doctest::Approx(route.height_m(route.before(i))));
        CHECK(leg[leg.count - 1].height_at(leg[leg.count - 1].length_m) ==
              doctest::Approx(route.height_m(i)));
      }
    }
  }
}

TEST_CASE("the closest point of a leg is that of a search over points a centimetre apart") {
  Random rng(23);
  for (int trial = 0; trial < 60; ++trial) {
    const Plan plan = random_plan(rng, 4, 250);
    const Route route(plan);
    if (route.is_point()) continue;
    const RouteLeg leg = route.leg(2);
    for (int k = 0; k < 5; ++k) {
      const double north = rng.uniform(-400, 400), east = rng.uniform(-400, 400);
      double best = 1e9, height = 0;
      for (std::size_t i = 0; i < leg.count; ++i) {
        const int steps = 1 + static_cast<int>(leg[i].length_m * 100);
        for (int s = 0; s <= steps; ++s) {
          const double along = leg[i].length_m * s / steps;
          const Pose p = leg[i].pose_at(along);
          const double d = std::hypot(p.north_m - north, p.east_m - east);
          if (d < best) {
            best = d;
            height = leg[i].height_at(along);
          }
        }
      }
      const RoutePoint found = nearest(leg, north, east);
      CHECK(found.distance_m == doctest::Approx(best).epsilon(1e-2));
      CHECK(found.distance_m <= best + 1e-9);
      CHECK(std::hypot(found.north_m - north, found.east_m - east) == doctest::Approx(found.distance_m));
      if (std::abs(found.distance_m - best) < 1e-5) CHECK(std::abs(found.height_m - height) < 0.5);
    }
  }
}

TEST_CASE("a plan that ends in an orbit reaches it along a tangent, in the direction of the lesser turn") {
  const Plan plan = plan_of({point(0, 0), point(500, 0), point(500, 500)}, PlanEnd::orbit);
  const Route route(plan);
  const RouteOrbit orbit = route.final_orbit();
  const Pose entry = route.leg(2).end;
  CHECK(distance(entry, plan.waypoints[2]) == doctest::Approx(50));
  const double radial = std::atan2(entry.east_m - 500, entry.north_m - 500);
  CHECK(std::abs(std::cos(radial - entry.course_rad)) < 1e-9);
  CHECK(orbit.turn == Turn::right);  // after a right corner
  check_joints(route.leg(2));
}

TEST_CASE("the turn of the final orbit is that of the way to it, also when its last corner is there twice") {
  // eastwards, with the centre a little to the left
  const Plan once = plan_of({point(0, -300), point(0, 0), point(20, 300)}, PlanEnd::orbit),
             twice = plan_of({point(0, -300), point(0, 0), point(0, 0), point(20, 300)}, PlanEnd::orbit);
  CHECK(Route(once).final_orbit().turn == Turn::left);
  CHECK(Route(twice).final_orbit().turn == Turn::left);
}

TEST_CASE("the lesser turn onto a circle is the one whose tangent is closer in course") {
  Random rng(29);
  for (int i = 0; i < 1000; ++i) {
    const Pose from{rng.uniform(-500, 500), rng.uniform(-500, 500), rng.uniform(-7, 7)};
    const double d = std::hypot(from.north_m, from.east_m);
    if (d < 60) continue;
    // tangent point by Thales' theorem: at the angle acos(R / d) to either side of the line to the aircraft,
    // from the centre
    const double towards = std::atan2(from.east_m, from.north_m), half = std::acos(50 / d);
    double turning[2];
    for (int k = 0; k < 2; ++k) {
      const double azimuth = towards + (k == 0 ? half : -half), n = 50 * std::cos(azimuth),
                   e = 50 * std::sin(azimuth);
      const double course = std::atan2(e - from.east_m, n - from.north_m);
      // in that direction around the centre: right for a growing azimuth
      const bool right = std::cos(course - (azimuth + pi / 2)) > 0;
      turning[right ? 0 : 1] = std::abs(wrap_pi(course - from.course_rad));
    }
    if (std::abs(turning[0] - turning[1]) < 1e-6) continue;
    CHECK(min_turning(from, 0, 0, 50) == (turning[0] < turning[1] ? Turn::right : Turn::left));
  }
}

TEST_CASE(
    "joining a plan arrives as the route passes the waypoint, and does not descend below it on the way") {
  const Plan plan = plan_of({point(400, -250), point(-400, -50), point(-400, -250), point(400, -50)});
  const Route route(plan);
  const RouteLeg low = route.join({0, 0, 0}, 0, 0), high = route.join({0, 0, 0}, 200, 0);
  CHECK(distance(low.end, route.passage(0).middle) < 1e-9);
  CHECK(low[0].height_m == doctest::Approx(70));
  CHECK(high[0].height_m == doctest::Approx(200));
  CHECK(high[high.count - 1].height_at(high[high.count - 1].length_m) == doctest::Approx(70));
  check_joints(high);
}

TEST_CASE("waypoints within a metre are one place, and a plan in one place is a point") {
  CHECK(Route(plan_of({point(0, 0), point(0.5, 0), point(0.9, 0.1)})).is_point());
  const Plan plan = plan_of({point(0, 0), point(500, 0), point(500.4, 0.3), point(500, 500)});
  CHECK_FALSE(Route(plan).is_point());
  CHECK(Route(plan).leg(2).length_m < 1e-6);  // no loop for half a metre sideways
}

TEST_CASE("a hairpin has no fillet however long its legs are: it would stay far from the waypoint") {
  const auto turn_at = [](double degrees) {
    const double back = pi - degrees * pi / 180;
    const Plan plan =
        plan_of({point(0, 0), point(1000, 0), point(1000 - 1000 * std::cos(back), 1000 * std::sin(back))},
                PlanEnd::orbit);
    return Route(plan).passage(1).turn_rad;
  };
  CHECK(turn_at(145) / (145 * pi / 180) == doctest::Approx(1).epsilon(0.05));  // the next one is an orbit
  CHECK(turn_at(165) == 0);
}

}  // namespace route_test
