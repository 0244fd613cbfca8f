// SPDX-License-Identifier: BSD-3-Clause
// The manager on plans of every size, and step by step.
#include <doctest/doctest.h>

#include "flight.hpp"

namespace manager_test {

using namespace fulmar;
using namespace fulmar::path;
using namespace fulmar::test;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE(
    "with no waypoint the place where the flight began is orbited, not lower than the hold height, from the "
    "first step on") {
  Flight flight(plan_of({}));
  flight.aircraft.north = 1000;
  flight.aircraft.east = -2000;
  flight.aircraft.height = 5;
  flight.step();
  CHECK(flight.path().kind == PathKind::orbit);
  CHECK(flight.path().origin_m == Vec3<Ned>{1000, -2000, -50});
  CHECK(flight.path().airspeed_mps == 17);
  flight.fly(120);
  CHECK(flight.finite);
  CHECK(flight.distance_to(1000, -2000) == doctest::Approx(50).epsilon(0.1));
  CHECK(flight.aircraft.height == doctest::Approx(50).epsilon(0.02));
  CHECK(flight.progress().reached == 0);
}

TEST_CASE("one waypoint is orbited in the direction of the lesser turn, and each circle counts") {
  for (const double course : {0.5, -0.5}) {  // passing left of it, passing right of it
    Flight flight(plan_of({point(500, 0)}));
    flight.aircraft.psi = course;
    flight.step();
    CHECK(flight.path().turn == (course > 0 ? Turn::left : Turn::right));
    const Turn turn = flight.path().turn;
    flight.fly(150);
    CHECK(flight.path().turn == turn);
    CHECK(flight.finite);
    CHECK(flight.distance_to(500, 0) == doctest::Approx(50).epsilon(0.02));
    CHECK(flight.progress().reached == 1);
    const std::uint32_t before = flight.progress().circuits;
    flight.fly(10 * 2 * pi * 50 / 17);
    CHECK(flight.progress().circuits - before >= 9);
    CHECK(flight.progress().circuits - before <= 10);
  }
}

TEST_CASE("a plan that ends in an orbit ends in an orbit, be it of one, two or three waypoints") {
  for (std::uint32_t n = 1; n <= 4; ++n) {
    Plan plan = hourglass();
    plan.end = PlanEnd::orbit;
    plan.waypoints.count = n;
    const Vec3<Ned> last = plan.waypoints[n - 1].position_m;
    Flight flight(plan);
    flight.aircraft.wind_north = 3;
    flight.aircraft.wind_east = -4;
    CAPTURE(n);
    CHECK(flight.fly(300, [&] { return flight.progress().finished; }));
    flight.fly(120);
    for (int i = 0; i < 30; ++i) {
      flight.fly(1);
      CHECK(std::abs(flight.distance_to(last.north, last.east) - 50) < 5);
    }
    CHECK(flight.finite);
    CHECK(flight.progress().finished);
    CHECK(flight.progress().circuits == 1);
    CHECK(flight.progress().reached == n);
    CHECK(flight.progress().item == n - 1);
  }
}

TEST_CASE("two waypoints are flown back and forth") {
  Flight flight(plan_of({point(0, 300), point(400, 300)}));
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 3; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{0, 1, 0, 1, 0, 1, 0});
  CHECK(flight.finite);
}

TEST_CASE("the first leg leads to the first waypoint, and no leg is left out") {
  Plan plan = hourglass();
  plan.waypoints[2].has_course = true;  // mixed
  plan.waypoints[2].course_rad = -pi / 2;
  Flight flight(plan);
  flight.step();
  CHECK(flight.progress().item == 0);
  CHECK(flight.progress().joining);
  CHECK(flight.fly(40, [&] { return flight.progress().reached == 1; }));
  CHECK_FALSE(flight.progress().joining);
  CHECK(flight.fly(200, [&] { return flight.progress().circuits == 1; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{0, 1, 2, 3, 0});
  CHECK(flight.progress().miss_m < 3);
}

TEST_CASE(
    "a flight that begins with a later waypoint joins there, and goes through the list from it; a change in "
    "flight is a jump") {
  Flight flight(hourglass());
  flight.manager.params.first_item.value = 2;
  flight.step();
  CHECK(flight.progress().item == 2);
  CHECK(flight.progress().joining);
  CHECK(flight.fly(200, [&] { return flight.progress().circuits == 1; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{2, 3, 0, 1, 2});
  flight.manager.params.first_item.value = 0;
  flight.manager.retune();
  flight.step();
  CHECK(flight.progress().item == 0);
  flight.manager.params.first_item.value = 9;  // the plan is shorter
  flight.manager.retune();
  flight.step();
  CHECK(flight.progress().item == 3);
  flight.manager.retune();  // for another parameter's sake
  CHECK(flight.fly(100, [&] { return flight.progress().item == 0; }));
}

TEST_CASE("collinear and reversing legs are passed") {
  Flight collinear(plan_of({point(0, 0), point(230, -55), point(690, -165), point(690, 400)}));
  CHECK(collinear.fly(300, [&] { return collinear.progress().circuits == 1; }));
  CHECK(collinear.finite);
  Flight reversing(plan_of({point(0, 0), point(500, 0), point(200, 0), point(800, 0)}));
  CHECK(reversing.fly(400, [&] { return reversing.progress().circuits == 1; }));
  CHECK(reversing.finite);
  Flight twice(plan_of({point(0, 0), point(500, 0), point(500, 0), point(500, 500), point(0, 0)}));
  CHECK(twice.fly(400, [&] { return twice.progress().circuits == 1; }));
  CHECK(twice.finite);
}

TEST_CASE("without a position nothing is published at first, and later the old path stays in force") {
  Bench<Manager> manager;
  manager.set(manager.in.plan, hourglass());
  VehicleState state = Kinematic{}.state();
  state.position_valid = false;
  manager.set(manager.in.state, state);
  CHECK(manager.step(0.01) == Status::degraded);
  CHECK_FALSE(manager.out.path.written);
  state.position_valid = true;
  manager.set(manager.in.state, state);
  CHECK(manager.step(0.01) == Status::ok);
  CHECK(manager.out.path.written);
  CHECK(manager.out.progress.items == 4);
}

TEST_CASE(
    "without a fix the plan goes on as long as the reckoned position is good enough, and is told degraded") {
  Bench<Manager> manager;
  manager.set(manager.in.plan, hourglass());
  VehicleState state = Kinematic{}.state();
  state.attitude_valid = true;
  manager.set(manager.in.state, state);
  REQUIRE(manager.step(0.01) == Status::ok);
  state.position_valid = false;
  state.position_std_m = {40, 40, 5};
  manager.set(manager.in.state, state);
  CHECK(manager.step(0.01) == Status::degraded);
  CHECK(manager.out.path.written);
  state.position_std_m = {60, 40, 5};
  manager.set(manager.in.state, state);
  CHECK(manager.step(0.01) == Status::degraded);
  CHECK_FALSE(manager.out.path.written);
}

TEST_CASE("a way to the plan that is not followed is drawn anew from where the aircraft is") {
  // an aircraft that flies straight on after take-off, for any guidance
  Bench<Manager> manager;
  manager.set(manager.in.plan, hourglass());
  Kinematic aircraft;
  aircraft.height = 0;
  aircraft.psi = pi / 2;
  for (int i = 0; i < 1500; ++i) {
    aircraft.east = 0.17 * i;
    manager.set(manager.in.state, aircraft.state());
    manager.step(0.01);
  }
  const Path& path = manager.out.path.value;
  const double n = aircraft.north - path.origin_m.north, e = aircraft.east - path.origin_m.east;
  const double off = path.kind == PathKind::line
                         ? path.direction_ratio.north * e - path.direction_ratio.east * n
                         : std::hypot(n, e) - path.radius_m;
  CHECK(std::abs(off) < 60);
  CHECK(manager.out.progress.item == 0);
}

TEST_CASE("the distance to the next change of curvature falls evenly to nothing") {
  Flight flight(hourglass());
  flight.fly(60, [&] { return flight.progress().reached == 1; });
  double before = flight.path().remaining_m;
  int changes = 0;
  Kinematic last = flight.aircraft;
  for (int i = 0; i < 15000; ++i) {
    flight.step();
    const double now = flight.path().remaining_m,
                 step = std::hypot(flight.aircraft.north - last.north, flight.aircraft.east - last.east);
    last = flight.aircraft;
    if (now > before + 1) {
      CHECK(before < 0.5);
      ++changes;
    } else {
      CHECK(before - now < 2 * step + 0.01);
    }
    before = now;
  }
  CHECK(changes >= 8);
}

TEST_CASE("1024 waypoints are managed as quickly as four: a step neither allocates nor walks the list") {
  Plan plan = plan_of({});
  for (int i = 0; i < 1024; ++i)
    plan.waypoints.push_back(point(120.0 * (i % 32), 150.0 * (i / 32), 50 + i % 7));
  Flight flight(plan);
  flight.fly(300);
  CHECK(flight.finite);
  CHECK(flight.progress().reached > 20);
  CHECK(flight.progress().items == 1024);
  std::uint64_t count = 0;
  for (int i = 0; i < 2000; ++i) {
    flight.manager.set(flight.manager.in.state, flight.aircraft.state());
    count += allocations([&] { flight.manager.step(0.01); });
    flight.field.set(flight.field.in.path, flight.path());
    count += allocations([&] { flight.field.step(0.01); });
    flight.aircraft.step(flight.field.out.command, 0.01);
  }
  CHECK(count == 0);
}

TEST_CASE("the miss of a waypoint is that of this one, not the least of all so far") {
  Bench<Manager> manager;
  manager.set(manager.in.plan, plan_of({point(300, 0), point(600, 0), point(900, 0)}, PlanEnd::orbit));
  Kinematic aircraft;
  std::vector<double> misses;
  for (int i = 0; i < 400; ++i) {
    aircraft.north = 2 * i;
    aircraft.east = aircraft.north < 400 ? 0 : 10;
    manager.set(manager.in.state, aircraft.state());
    manager.step(0.1);
    if (manager.out.progress.reached > misses.size()) misses.push_back(manager.out.progress.miss_m);
  }
  REQUIRE(misses.size() >= 2);
  CHECK(misses[0] < 2.1);
  CHECK(misses[1] == doctest::Approx(10).epsilon(0.05));
}

TEST_CASE("nothing to fly: it circles at its height, and not below the least one") {
  for (const double height : {20.0, 120.0}) {
    Bench<Manager> manager;
    manager.set(manager.in.plan, Plan{});
    Kinematic aircraft;
    aircraft.height = height;
    manager.set(manager.in.state, aircraft.state());
    manager.step(0.01);
    REQUIRE(manager.out.path.written);
    CHECK(manager.out.path.value.origin_m.down == -std::max(height, 50.0));
  }
}

TEST_CASE("a parameter that is changed in flight leaves the aircraft on its leg") {
  Flight flight(hourglass());
  REQUIRE(flight.fly(200, [&] { return flight.progress().item == 2 && !flight.progress().joining; }));
  flight.manager.params.rejoin_distance.value = 40;
  flight.manager.retune();
  flight.step();
  CHECK(flight.progress().item == 2);
  CHECK_FALSE(flight.progress().joining);
}

TEST_CASE("the next piece that is told is the one that is published when the curvature changes") {
  for (const Plan& plan :
       {hourglass(), plan_of({point(300, 0, 60), point(300, 200, 90), point(0, 200, 70)}, PlanEnd::orbit)}) {
    Flight flight(plan);
    Path before = {};
    int changes = 0;
    const auto kappa_of = [](const auto& piece) {
      return piece.kind == PathKind::line ? 0 : sign_of(piece.turn) / piece.radius_m;
    };
    flight.fly(600, [&] {
      const Path& now = flight.path();
      if (before.has_next) {
        CHECK(kappa_of(before.next) == doctest::Approx(before.next_curvature_ratio));
        CHECK(std::abs(kappa_of(before.next) - kappa_of(before)) > 1e-9);
      }
      const bool changed = std::abs(kappa_of(now) - kappa_of(before)) > 1e-9;
      if (changed && before.has_next && before.remaining_m < 1) {
        ++changes;
        const PathPiece& reported = before.next;
        CHECK(reported.kind == now.kind);
        CHECK(reported.airspeed_mps == now.airspeed_mps);
        CHECK(reported.origin_m.north == doctest::Approx(now.origin_m.north));
        CHECK(reported.origin_m.east == doctest::Approx(now.origin_m.east));
        if (reported.kind == PathKind::line) {
          CHECK(reported.direction_ratio == now.direction_ratio);
          CHECK(reported.origin_m.down == now.origin_m.down);
        } else {
          CHECK(reported.turn == now.turn);
          CHECK(reported.radius_m == now.radius_m);
          CHECK(std::abs(reported.origin_m.down - now.origin_m.down) < 0.2);
          const Vec3<Ned> begin{reported.origin_m.north + reported.radius_m * std::cos(reported.start_rad),
                                reported.origin_m.east + reported.radius_m * std::sin(reported.start_rad), 0};
          CHECK(flight.distance_to(begin.north, begin.east) < 3);
        }
        if (reported.length_m < 1e6) {
          CHECK(now.remaining_m <= reported.length_m);
          CHECK(now.remaining_m > reported.length_m - 1);
        }
      }
      before = now;
      return flight.progress().circuits >= 1 &&
             (flight.progress().finished || flight.progress().circuits >= 2);
    });
    CHECK(changes >= (plan.end == PlanEnd::circuit ? 15 : 4));
    if (plan.end == PlanEnd::orbit) CHECK_FALSE(flight.path().has_next);
  }
}

TEST_CASE("a piece ends where the next one begins, and in its direction") {
  Flight flight(hourglass());
  int lines = 0;
  flight.fly(120, [&] {
    const Path& path = flight.path();
    if (path.kind != PathKind::line || !path.has_next || flight.progress().joining) return false;
    REQUIRE(path.next.kind == PathKind::orbit);
    const Vec3<Ned>& q = path.direction_ratio;
    const double level = std::hypot(q.north, q.east), q_n = q.north / level, q_e = q.east / level;
    const double n = flight.aircraft.north - path.origin_m.north,
                 e = flight.aircraft.east - path.origin_m.east;
    // the manager has measured before the aircraft moved on: 0.2 m
    const double s = n * q_n + e * q_e + path.remaining_m, side = sign_of(path.next.turn);
    const double end_n = path.origin_m.north + s * q_n, end_e = path.origin_m.east + s * q_e;
    const double azimuth = path.next.start_rad;
    CHECK(std::abs(path.next.origin_m.north + path.next.radius_m * std::cos(azimuth) - end_n) < 0.25);
    CHECK(std::abs(path.next.origin_m.east + path.next.radius_m * std::sin(azimuth) - end_e) < 0.25);
    CHECK(std::abs(angle_difference(azimuth + side * std::numbers::pi / 2, std::atan2(q_e, q_n))) < 1e-9);
    ++lines;
    return false;
  });
  CHECK(lines > 100);
}

}  // namespace manager_test
