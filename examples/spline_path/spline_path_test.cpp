// SPDX-License-Identifier: BSD-3-Clause
// The curve against its conditions of smoothness; the follower against the closed form of its oscillator;
// both with plans of every size, and with plans that change.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>
#include <initializer_list>

#include "spline_follower.hpp"
#include "spline_manager.hpp"

namespace {

constexpr double pi = std::numbers::pi, Va = 17;

Plan plan_of(std::initializer_list<Vec3<Ned>> points, PlanEnd end = PlanEnd::circuit) {
  Plan plan;
  plan.revision = plan.jumps = 1;
  plan.end = end;
  plan.airspeed_mps = Va;
  for (const Vec3<Ned>& at : points) {
    Waypoint w;
    w.position_m = at;
    w.id = plan.waypoints.count + 1;
    plan.waypoints.push_back(w);
  }
  return plan;
}
Plan hourglass() { return plan_of({{400, -250, -70}, {-400, -50, -70}, {-400, -250, -90}, {400, -50, -70}}); }

/// A point that moves by its commanded acceleration in calm air, with manager and follower.
struct Flight {
  Bench<SplineManager> manager;
  Bench<SplineFollower> follower;
  Plan plan;
  double n = 0, e = 0, chi = 0.5, t = 0, worst_m = 0;
  std::vector<std::uint32_t> items;

  explicit Flight(const Plan& p) : plan(p) { manager.set(manager.in.plan, plan); }
  const Progress& progress() const { return manager.out.progress; }
  const Path& path() const { return manager.out.path.value; }

  VehicleState state() const {
    VehicleState s;
    s.position_m = {n, e, -70};
    s.height_m = 70;
    s.airspeed_mps = s.ground_speed_mps = Va;
    s.course_rad = s.yaw_rad = wrap_pi(chi);
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = true;
    return s;
  }
  void step(double dt = 0.02) {
    manager.set(manager.in.state, state());
    REQUIRE(allocations([&] { REQUIRE(manager.step(dt) == Status::ok); }) == 0);
    REQUIRE(manager.validation_error() == "");
    follower.set(follower.in.state, state());
    follower.set(follower.in.path, path());
    REQUIRE(allocations([&] { REQUIRE(follower.step(dt) == Status::ok); }) == 0);
    REQUIRE(follower.validation_error() == "");
    if (items.empty() || items.back() != progress().item) items.push_back(progress().item);
    if (progress().reached > 0) worst_m = std::max(worst_m, std::abs(follower.out.cross_track_m.value));
    chi += follower.out.command.lateral_acceleration_mps2 / Va * dt;
    n += Va * std::cos(chi) * dt;
    e += Va * std::sin(chi) * dt;
    t += dt;
  }
  template <class Until>
  bool fly(double seconds, Until until) {
    for (const double end = t + seconds; t < end;) {
      step();
      if (until()) return true;
    }
    return false;
  }
};

}  // namespace

TEST_CASE("legs meet in every waypoint, in one direction") {
  const Plan plan = hourglass();
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Curve in = SplineManager::leg(plan, i, 0), out = SplineManager::leg(plan, (i + 1) % 4, 0);
    CHECK(in.p[3] == plan.waypoints[i].position_m);
    CHECK(out.p[0] == plan.waypoints[i].position_m);
    CHECK(std::remainder(in.course_rad(1) - out.course_rad(0), 2 * pi) == doctest::Approx(0));
    CHECK(in.climb_ratio(1) == doctest::Approx(out.climb_ratio(0)));
  }
}

TEST_CASE("points on a straight line, however unevenly spaced, make a straight line without return") {
  const Plan plan = plan_of({{0, 0, -70}, {30, 40, -70}, {300, 400, -70}, {306, 408, -70}}, PlanEnd::orbit);
  for (std::uint32_t i = 1; i < 4; ++i) {
    const Curve leg = SplineManager::leg(plan, i, 0);
    for (double u = 0; u <= 1; u += 0.1) {
      CHECK(leg.point(u).north * 4 == doctest::Approx(leg.point(u).east * 3));
      CHECK(leg.slope(u).north > 0);
    }
  }
}

TEST_CASE(
    "between the corners of a square it bulges by the eighth that Catmull-Rom has; two waypoints are a "
    "circle") {
  const Plan square = plan_of({{100, 0, -70}, {0, 100, -70}, {-100, 0, -70}, {0, -100, -70}});
  const Plan two = plan_of({{100, 0, -70}, {-100, 0, -70}});
  const Vec3<Ned> middle = SplineManager::leg(square, 1, 0).point(0.5);  // (a + b)/2 + (m_a - m_b)/8
  CHECK(middle.north == doctest::Approx(62.5));
  CHECK(middle.east == doctest::Approx(62.5));
  for (double u = 0; u <= 1; u += 0.05) {
    const Vec3<Ned> at = SplineManager::leg(two, 1, 0).point(u);
    CHECK(std::hypot(at.north, at.east) == doctest::Approx(100).epsilon(0.03));
  }
}

TEST_CASE("with all tension legs are straight") {
  const Curve leg = SplineManager::leg(hourglass(), 2, 1);
  CHECK(leg.length_m() == doctest::Approx(200));
}

TEST_CASE("a circuit is flown in order and counted, and the curve is kept to") {
  Flight flight(hourglass());
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 2; }));
  CHECK(flight.items == std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 2, 3, 0, 1});
  CHECK(flight.progress().reached == 9);
  CHECK(flight.progress().miss_m < 1.5);
  CHECK(flight.worst_m < 1.5);
}

TEST_CASE("an open plan ends in an orbit round its last waypoint; one waypoint is an orbit, none is a hold") {
  Flight open(plan_of({{300, 0, -70}, {600, 200, -70}}, PlanEnd::orbit));
  CHECK(open.fly(200, [&] { return open.progress().finished; }));
  CHECK(open.path().kind == PathKind::orbit);
  CHECK(open.path().origin_m == Vec3<Ned>{600, 200, -70});
  CHECK(open.progress().item == 1);
  Flight one(plan_of({{300, 0, -70}}, PlanEnd::orbit));
  one.fly(150, [] { return false; });
  CHECK(std::hypot(one.n - 300, one.e) == doctest::Approx(50).epsilon(0.05));
  Flight none(plan_of({}));
  none.fly(60, [] { return false; });
  CHECK(std::hypot(none.n, none.e) == doctest::Approx(50).epsilon(0.05));
}

TEST_CASE(
    "a plan that changes elsewhere leaves the aircraft on its leg; an order to fly elsewhere is followed") {
  Flight flight(hourglass());
  flight.fly(200, [&] { return flight.progress().item == 2; });
  flight.fly(3, [] { return false; });
  Plan plan = flight.plan;
  plan.waypoints.push_back(plan.waypoints[0]);
  plan.waypoints[4].id = 9;
  plan.waypoints[4].position_m = {450, -150, -70};
  ++plan.revision;
  flight.manager.set(flight.manager.in.plan, plan);
  flight.step();
  CHECK(flight.progress().items == 5);
  CHECK(flight.progress().item == 2);
  CHECK_FALSE(flight.progress().joining);
  CHECK(flight.progress().plan_revision == 2);
  plan.jump_item = 0;
  ++plan.jumps;
  ++plan.revision;
  flight.manager.set(flight.manager.in.plan, plan);
  flight.step();
  CHECK(flight.progress().item == 0);
  CHECK(flight.progress().joining);
}

TEST_CASE("without a position no path is published at first, and no new one later") {
  Bench<SplineManager> manager;
  VehicleState lost;
  manager.set(manager.in.plan, hourglass());
  manager.set(manager.in.state, lost);
  CHECK(manager.step(0.02) == Status::degraded);
  CHECK_FALSE(manager.out.path.written);
}

TEST_CASE("near a line the follower is an oscillator over the length flown, of the damping asked for") {
  // d'' + 2 zeta a d' + a^2 d = 0 from d = 2, d' = 0; with a = 1/20 m and zeta = 0.8.
  const double a = 1.0 / 20, zeta = 0.8, w = a * std::sqrt(1 - zeta * zeta);
  for (const double side : {1.0, -1.0})
    for (const double course : {0.0, 2.2}) {
      Bench<SplineFollower> follower;
      Path path;
      path.origin_m = {50, -30, -70};
      path.direction_ratio = {std::cos(course), std::sin(course), 0};
      path.airspeed_mps = Va;
      double along = 0, d = 2 * side, theta = 0;
      for (int i = 0; i < 1500; ++i) {
        const double s = 0.005 * Va * i;
        const double wanted =
            side * 2 * std::exp(-zeta * a * s) * (std::cos(w * s) + zeta * a / w * std::sin(w * s));
        if (i % 100 == 0) CHECK(d == doctest::Approx(wanted).epsilon(0.01).scale(2));
        Flight at(plan_of({}));
        at.n = 50 + along * std::cos(course) - d * std::sin(course);
        at.e = -30 + along * std::sin(course) + d * std::cos(course);
        at.chi = course + theta;
        follower.set(follower.in.state, at.state());
        follower.set(follower.in.path, path);
        REQUIRE(follower.step(0.005) == Status::ok);
        theta += follower.out.command.lateral_acceleration_mps2 / Va * 0.005;
        along += Va * std::cos(theta) * 0.005;
        d += Va * std::sin(theta) * 0.005;
      }
    }
}

TEST_CASE("on a circle the follower pulls Vg^2/R, and rolls before the curvature changes") {
  for (const Turn turn : {Turn::right, Turn::left}) {
    const double side = turn == Turn::right ? 1 : -1;
    Bench<SplineFollower> follower;
    Path path;
    path.kind = PathKind::orbit;
    path.turn = turn;
    path.radius_m = 90;
    Flight at(plan_of({}));
    at.n = 90 * std::cos(2.0);
    at.e = 90 * std::sin(2.0);
    at.chi = 2.0 + side * pi / 2;
    follower.set(follower.in.state, at.state());
    follower.set(follower.in.path, path);
    follower.step(0.01);
    CHECK(follower.out.command.lateral_acceleration_mps2 == doctest::Approx(side * Va * Va / 90));
    path.remaining_m = 5;  // less than half a second
    path.next_curvature_ratio = -side / 60;
    follower.set(follower.in.path, path);
    follower.step(0.01);
    CHECK(follower.out.command.lateral_acceleration_mps2 == doctest::Approx(-side * Va * Va / 60));
  }
}
