// SPDX-License-Identifier: BSD-3-Clause
// The circle at the end of a plan against a search over all of its tangents, from any side.
#include <doctest/doctest.h>

#include <cmath>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/random.hpp"

namespace final_orbit_test {

using namespace fulmar;

namespace {

struct Tangent {
  double north_m = 0, east_m = 0, turn_rad = 10;  ///< where it touches, and the turning that it takes
};

/// The azimuth whose tangent comes from (n, e) along the direction of flight.
Tangent tangent(const RouteOrbit& o, Turn turn, double n, double e, double from_n, double from_e) {
  const double side = turn == Turn::right ? 1 : -1;
  Tangent best;
  double least = 1;
  for (double azimuth = -3.14159265; azimuth < 3.14159265; azimuth += 1e-4) {
    const double tn = o.north_m + o.radius_m * std::cos(azimuth),
                 te = o.east_m + o.radius_m * std::sin(azimuth);
    const double wn = tn - n, we = te - e, way = std::hypot(wn, we);
    const double along = side * (-std::sin(azimuth) * wn + std::cos(azimuth) * we) / way;  // 1: tangent to it
    if (1 - along >= least) continue;
    least = 1 - along;
    const double turned =
        std::acos(std::clamp((from_n * wn + from_e * we) / (way * std::hypot(from_n, from_e)), -1.0, 1.0));
    best = {tn, te, turned};
  }
  return best;
}

}  // namespace

TEST_CASE(
    "the final circle is flown round by the tangent that takes the lesser turn, and begins where it "
    "touches") {
  Random rng(5);
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    Plan plan;
    plan.end = PlanEnd::orbit;
    plan.turn_radius_m = rng.uniform(40, 90);
    Vec3<Ned> at[3];
    for (Vec3<Ned>& point : at) {
      point = {rng.uniform(-600, 600), rng.uniform(-600, 600), -rng.uniform(40, 90)};
      Waypoint w;
      w.position_m = point;
      plan.waypoints.push_back(w);
    }
    const auto &p = at[0], &q = at[1], &c = at[2];
    if (std::hypot(c.north - q.north, c.east - q.east) < 1.2 * plan.turn_radius_m) continue;
    const Route route(plan);
    const RouteOrbit orbit = route.final_orbit();
    CHECK(orbit.north_m == c.north);
    CHECK(orbit.east_m == c.east);
    CHECK(orbit.height_m == -c.down);
    CHECK(orbit.radius_m == plan.turn_radius_m);
    const double un = q.north - p.north, ue = q.east - p.east;
    const Tangent right = tangent(orbit, Turn::right, q.north, q.east, un, ue),
                  left = tangent(orbit, Turn::left, q.north, q.east, un, ue);
    if (std::abs(right.turn_rad - left.turn_rad) < 0.02) continue;
    ++judged;
    CHECK((orbit.turn == Turn::right) == (right.turn_rad < left.turn_rad));
    const Tangent& taken = orbit.turn == Turn::right ? right : left;
    const RouteLeg leg = route.leg(2);
    CHECK(std::hypot(leg.end.north_m - taken.north_m, leg.end.east_m - taken.east_m) < 0.1);
  }
  CHECK(judged > 30);
}

}  // namespace final_orbit_test
