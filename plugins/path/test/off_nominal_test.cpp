// SPDX-License-Identifier: BSD-3-Clause
// Repeated actions, and geometry that is neither level nor symmetrical: exact values.
#include <doctest/doctest.h>

#include "flight.hpp"
#include "plugins/path/landing.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::path;
using namespace fulmar::test;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi;

/// A manager whose aircraft is put on circles of 50 m.
struct Rounds : Bench<Manager> {
  Plan plan = plan_of({point(0, 0)});
  double side = 1;

  void jump_to(double north, double east) {
    plan.waypoints[0].position_m = {north, east, -70};
    ++plan.revision;
    ++plan.jumps;
    set(in.plan, plan);
  }
  /// From azimuth `from`, so many radians to the `side`.
  const Progress& turn(double from, double angle) {
    const Vec3<Ned>& centre = plan.waypoints[0].position_m;
    for (double t = 0; t < angle; t += 0.05) {
      const double azimuth = from + side * t, course = azimuth + side * pi / 2;
      VehicleState s;
      s.position_m = {centre.north + 50 * std::cos(azimuth), centre.east + 50 * std::sin(azimuth), -70};
      s.velocity_mps = {17 * std::cos(course), 17 * std::sin(course), 0};
      s.height_m = 70;
      s.ground_speed_mps = s.airspeed_mps = 17;
      s.course_rad = s.yaw_rad = wrap_pi(course);
      s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
      set(in.state, s);
      REQUIRE(step(0.1) == Status::ok);
    }
    return out.progress;
  }
};

constexpr double runway_rad = 0.7;

/// On the slope that meets a runway at 100 m north, -150 m east, 20 m high, so far in front of it.
VehicleState on_final(double along_m, double course_rad) {
  VehicleState s;
  s.position_m = {100 - along_m * std::cos(runway_rad), -150 - along_m * std::sin(runway_rad),
                  -(20 + std::tan(0.07) * along_m)};
  s.height_m = -s.position_m.down;
  s.ground_speed_mps = s.airspeed_mps = 14;
  s.course_rad = course_rad;
  s.yaw_rad = runway_rad;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
  return s;
}

/// A waypoint that is passed in this course, with its own id.
Waypoint passed(std::uint32_t id, double north, double east, double course_rad) {
  Waypoint w = point(north, east);
  w.id = id;
  w.has_course = true;
  w.course_rad = course_rad;
  return w;
}

}  // namespace

TEST_CASE("a second orbit counts its own circles, not the rest of the first one, to either side") {
  for (const double side : {1.0, -1.0}) {
    Rounds r;
    r.side = side;
    r.jump_to(0, 0);
    r.turn(0.3, 5);
    CHECK(r.out.path.value.turn == (side > 0 ? Turn::right : Turn::left));
    r.jump_to(1000, 500);
    CHECK(r.turn(-2, 5).circuits == 0);
    CHECK(r.turn(-2 + side * 5, 1.5).circuits == 1);
    CHECK(r.turn(-2 + side * 6.5, 6).circuits == 1);
    CHECK(r.turn(-2 + side * 12.5, 0.5).circuits == 2);
  }
}

TEST_CASE("on the slope the climb rate is that of the way along it: half at 60 degrees to it, none across") {
  Bench<Landing> bench;
  Runway& runway = bench.params.runway.value;
  runway.up_m = 20;
  runway.heading_rad = runway_rad;
  runway.north_m = 100 - bench.params.pattern.aim * std::cos(runway_rad);
  runway.east_m = -150 - bench.params.pattern.aim * std::sin(runway_rad);
  runway.length_m = 400;
  bench.params.runway.is_given = true;
  FlightLimits& limits = bench.params.airframe.value.limits;
  limits.airspeed_min_mps = 12;
  limits.airspeed_cruise_mps = 17;
  bench.configure();
  bench.set(bench.in.state, on_final(450, runway_rad));
  bench.step(0.01);
  REQUIRE(bench.out.progress.stage == LandingStage::approach);
  for (const double off : {-pi / 3, -pi / 6, 0.0, pi / 4, pi / 3, pi / 2}) {
    CAPTURE(off);
    bench.set(bench.in.state, on_final(440, runway_rad + off));
    bench.step(0.01);
    REQUIRE(bench.out.progress.stage == LandingStage::approach);
    CHECK(std::abs(bench.out.command.climb_rate_mps + 14 * std::tan(0.07) * std::cos(off)) < 1e-9);
    CHECK(std::abs(bench.out.command.height_m - (20 + std::tan(0.07) * 440)) < 1e-9);
    CHECK(std::abs(angle_difference(bench.out.command.course_rad, runway_rad)) < 1e-9);
  }
}

TEST_CASE("a climbing line asks for the climb rate of the way along it and the height where it is closest") {
  for (const double course : {0.4, 2.5, -1.9})
    for (const double off : {-1.0, 0.0, 0.7}) {
      Path path;
      path.kind = PathKind::line;
      path.origin_m = {30, -40, -60};
      const double level = 1 / std::hypot(1, 0.1);
      path.direction_ratio = {level * std::cos(course), level * std::sin(course), -0.1 * level};
      path.airspeed_mps = 17;
      path.remaining_m = 1e3;
      VehicleState s = on_final(0, course + off);
      // 200 m along it, 12 m to its right
      s.position_m = {30 + 200 * std::cos(course) - 12 * std::sin(course),
                      -40 + 200 * std::sin(course) + 12 * std::cos(course), -70};
      s.height_m = 70;
      Bench<VectorField> field;
      field.set(field.in.path, path);
      field.set(field.in.state, s);
      field.step(0.01);
      CHECK(field.out.command.height_m == Approx(80));
      CHECK(field.out.command.climb_rate_mps / (1.4 * std::cos(off)) == Approx(1));
      CHECK(field.out.cross_track_m.value == Approx(12));
      CHECK(field.out.height_error_m.value == Approx(-10));
      CHECK(angle_difference(field.out.command.course_rad, course) < 0);
    }
}

TEST_CASE("a climbing circle asks for the height of its azimuth, to either side") {
  for (const double side : {1.0, -1.0})
    for (const double swept : {-1.2, 0.8, 2.0}) {
      Path path;
      path.kind = PathKind::orbit;
      path.turn = side > 0 ? Turn::right : Turn::left;
      path.origin_m = {10, 20, -60};
      path.radius_m = 80;
      path.start_rad = 0.9;
      path.climb_ratio = 0.05;
      path.airspeed_mps = 17;
      path.remaining_m = 1e3;
      const double azimuth = 0.9 + side * swept, course = azimuth + side * pi / 2;
      VehicleState s = on_final(0, wrap_pi(course));
      s.position_m = {10 + 80 * std::cos(azimuth), 20 + 80 * std::sin(azimuth), -60};
      Bench<VectorField> field;
      field.set(field.in.path, path);
      field.set(field.in.state, s);
      field.step(0.01);
      CHECK(field.out.command.height_m == Approx(60 + 0.05 * 80 * swept));
      CHECK(field.out.command.climb_rate_mps / (0.05 * 14) == Approx(1));
      CHECK(std::abs(angle_difference(field.out.command.course_rad, course)) < 1e-9);
    }
}

TEST_CASE(
    "the last leg meets the final circle as its tangent, from within it square to the way to the centre") {
  for (const double course : {0.0, 1.1, -2.2})
    for (const double before_m : {20.0, 49.0, 200.0}) {
      CAPTURE(course);
      CAPTURE(before_m);
      const double n = -before_m * std::cos(course), e = -before_m * std::sin(course);
      Plan plan = plan_of({point(n, e), point(0, 0)}, PlanEnd::orbit);
      plan.turn_radius_m = 50;
      const Route route(plan);
      const Pose end = route.leg(1).end;
      const double side = route.final_orbit().turn == Turn::right ? 1 : -1;
      CHECK(std::hypot(end.north_m, end.east_m) == Approx(50));
      // it goes on along the circle
      CHECK(std::abs(angle_difference(end.course_rad, std::atan2(end.east_m, end.north_m) + side * pi / 2)) <
            1e-9);
      if (before_m < 50) {
        const double along = std::cos(course) * end.north_m + std::sin(course) * end.east_m;
        CHECK(std::abs(along) < 1e-9);
        CHECK(std::abs(angle_difference(end.course_rad, course)) < 1e-9);
      } else {
        const double from_n = end.north_m - n, from_e = end.east_m - e;
        CHECK(std::abs(from_n * end.north_m + from_e * end.east_m) < 1e-6);
      }
    }
}

TEST_CASE("as far either way round: to the right; a hair nearer one way: that one") {
  for (const double course : {0.0, 1.3, -2.9}) {
    const auto turn = [&](double off_m) {  // 200 m before the centre, so far to the left of the way there
      const double n = -200 * std::cos(course) + off_m * std::sin(course),
                   e = -200 * std::sin(course) - off_m * std::cos(course);
      return min_turning({n, e, course}, 0, 0, 50);
    };
    CHECK(turn(0) == Turn::right);
    CHECK(turn(1) == Turn::right);
    CHECK(turn(-1) == Turn::left);
  }
}

TEST_CASE("on the way to the first waypoint another one is put in before it: the same goal, the next index") {
  Bench<Manager> manager;
  Plan plan = plan_of({passed(1, 600, 0, 0), passed(2, 1200, 300, 0.5), passed(3, 600, 900, -2)});
  const VehicleState s = Kinematic{}.state();
  const auto look = [&] {
    manager.set(manager.in.plan, plan);
    manager.set(manager.in.state, s);
    REQUIRE(manager.step(0.01) == Status::ok);
  };
  look();
  CHECK(manager.out.progress.item == 0);
  CHECK(manager.out.progress.joining);
  const Path before = manager.out.path.value;
  for (std::uint32_t i = 1; i <= 2; ++i) {
    for (std::uint32_t k = plan.waypoints.count++; k > 0; --k) plan.waypoints[k] = plan.waypoints[k - 1];
    plan.waypoints[0] = passed(3 + i, -500, 100.0 * i, 1);
    ++plan.revision;
    look();
    CHECK(manager.out.progress.item == i);
    CHECK(manager.out.progress.items == 3 + i);
    CHECK(manager.out.progress.joining);
    CHECK(manager.out.path.value.origin_m == before.origin_m);
  }
}

TEST_CASE("a waypoint that comes behind changes nothing of the piece that is flown, wherever on the leg") {
  bool line = false, arc = false;
  for (const double seconds : {0.5, 2.0, 5.0, 8.0}) {
    CAPTURE(seconds);
    Flight flight(hourglass());
    REQUIRE(flight.fly(200, [&] { return flight.progress().item == 2; }));
    flight.fly(seconds);
    REQUIRE(flight.progress().item == 2);
    const Path before = flight.path();
    Plan plan = flight.plan();
    plan.waypoints.push_back(point(800, 800));
    ++plan.revision;
    flight.change(plan);
    flight.step(1e-4);
    CHECK(flight.progress().item == 2);
    CHECK(flight.path().kind == before.kind);
    CHECK(std::hypot(flight.path().origin_m.north - before.origin_m.north,
                     flight.path().origin_m.east - before.origin_m.east) < 1e-6);
    line = line || before.kind == PathKind::line;
    arc = arc || before.kind == PathKind::orbit;
  }
  CHECK(line);
  CHECK(arc);
}

TEST_CASE("a leg climbs evenly, on its arcs as well: each piece has the slope of the whole") {
  Plan plan = plan_of({passed(0, 400, 0, 0), passed(0, 900, 500, 2), passed(0, 0, 700, -2)});
  for (std::uint32_t i = 0; i < 3; ++i) plan.waypoints[i].position_m.down = -(85 + 15.0 * i);
  Flight flight(plan);
  REQUIRE(flight.fly(200, [&] { return flight.progress().item == 1; }));
  const Route route(flight.plan());
  const RouteLeg leg = route.leg(1);
  bool arc = false;
  while (flight.progress().item == 1) {
    const Path& path = flight.path();
    const double slope =
        path.kind == PathKind::line
            ? -path.direction_ratio.down / std::hypot(path.direction_ratio.north, path.direction_ratio.east)
            : path.climb_ratio;
    REQUIRE(slope == Approx(15 / leg.length_m));
    arc = arc || path.kind == PathKind::orbit;
    flight.step(0.05);
  }
  CHECK(arc);
}

TEST_CASE(
    "the nearest point of a leg is that of a fine search, on lines, arcs of both turns and beyond their "
    "ends") {
  const Plan plan = plan_of({passed(0, 300, 0, 0.4), passed(0, 500, 400, 2.6), passed(0, -200, 300, -2)});
  const Route route(plan);
  for (std::uint32_t item = 0; item < 3; ++item) {
    const RouteLeg leg = route.leg(item);
    for (int k = 0; k < 200; ++k) {
      const double n = -400 + 1200 * std::fmod(0.618034 * k, 1.0), e = -300 + 6.0 * k;
      double best_m = 1e9;
      for (std::size_t i = 0; i < leg.count; ++i)
        for (double along = 0; along < leg[i].length_m; along += 0.5) {
          const RoutePiece& piece = leg[i];
          const double azimuth =
              piece.start_rad + (piece.turn == Turn::right ? 1 : -1) * along / piece.radius_m;
          const bool line = piece.kind == PathKind::line;
          const double at_n = piece.north_m +
                              (line ? along * piece.unit_north_ratio : piece.radius_m * std::cos(azimuth)),
                       at_e = piece.east_m +
                              (line ? along * piece.unit_east_ratio : piece.radius_m * std::sin(azimuth));
          best_m = std::min(best_m, std::hypot(n - at_n, e - at_e));
        }
      CAPTURE(item);
      CAPTURE(k);
      const RoutePoint found = nearest(leg, n, e);
      CHECK(std::abs(found.distance_m - best_m) < 0.5);
      CHECK(std::hypot(n - found.north_m, e - found.east_m) == Approx(found.distance_m));
    }
  }
}

TEST_CASE("from its first step on the field follows the path, also while the position is not valid") {
  Path path;
  path.kind = PathKind::line;
  path.origin_m = {0, 0, -80};
  path.direction_ratio = {0, 1, 0};
  path.airspeed_mps = 18;
  path.remaining_m = 1e3;
  VehicleState s = on_final(0, 0.2);
  s.position_valid = false;
  Bench<VectorField> field;
  field.set(field.in.path, path);
  field.set(field.in.state, s);
  CHECK(field.step(0.01) == Status::degraded);
  CHECK(field.out.command.airspeed_mps == 18);
  CHECK(field.out.command.height_m == Approx(80));
}

}  // namespace off_nominal_test
