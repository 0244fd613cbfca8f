// SPDX-License-Identifier: BSD-3-Clause
// The manager when the plan changes in flight.
#include <doctest/doctest.h>

#include "flight.hpp"
#include "plugins/path/planner.hpp"

namespace plan_changes_test {

using namespace fulmar;
using namespace fulmar::path;
using namespace fulmar::test;

TEST_CASE("a detour that is put in and taken out again does not keep the circuit from being complete") {
  Plan plan = hourglass();
  for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints[i].id = i + 1;
  Flight flight(plan);
  CHECK(flight.fly(100, [&] { return flight.progress().reached == 2; }));
  Plan longer =
      plan_of({plan.waypoints[0], plan.waypoints[1], point(-600, 200), point(-700, 100), point(-700, -100),
               point(-600, -200), point(-500, -400), plan.waypoints[2], plan.waypoints[3]});
  for (std::uint32_t i = 0; i < 5; ++i) longer.waypoints[2 + i].id = 11 + i;
  longer.revision = 2;
  longer.jumps = 2;
  longer.jump_item = 2;
  flight.change(longer);
  CHECK(flight.fly(300, [&] { return flight.progress().item == 7; }));
  CHECK(flight.progress().circuits == 0);
  Plan shorter = plan;
  shorter.revision = 3;
  shorter.jumps = longer.jumps;
  flight.change(shorter);
  flight.step();
  CHECK(flight.progress().item == 2);
  flight.passed.clear();
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 1; }));
  // The jump to the detour restarted the circuit, and the waypoint at its begin is gone.
  CHECK(flight.passed == std::vector<std::uint32_t>{2, 3, 0, 1, 2});
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 2; }));
  CHECK(flight.passed.size() == 9);
}

TEST_CASE("waypoints that are put in and taken out before the next do not count in the circuit") {
  Plan plan = hourglass();
  for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints[i].id = i + 1;
  Flight flight(plan);
  CHECK(flight.fly(100, [&] { return flight.progress().item == 1; }));
  Plan longer = plan_of(
      {plan.waypoints[0], plan.waypoints[1], point(-600, -100), plan.waypoints[2], plan.waypoints[3]});
  longer.waypoints[2].id = 11;
  longer.revision = 2;
  flight.change(longer);
  CHECK(flight.fly(200, [&] { return flight.progress().item == 3; }));
  plan.revision = 3;
  flight.change(plan);
  flight.passed.clear();
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 1; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{2, 3, 0});
}

TEST_CASE(
    "a plan that is cleared and loaded anew far away is flown from its beginning, and the old place is "
    "left") {
  Plan plan = hourglass();
  plan.waypoints[1].has_course = true;
  Flight flight(plan);
  flight.fly(120);
  CHECK(flight.progress().reached > 1);
  Plan empty = plan;
  empty.waypoints.clear();
  empty.revision = 2;
  empty.jumps = 2;
  flight.change(empty);
  flight.fly(5);
  CHECK(flight.path().kind == PathKind::orbit);
  Plan there = plan_of({point(3000, 3000), point(3600, 3000), point(3600, 3600)});
  for (Waypoint& w : there.waypoints) w.has_course = true;
  there.revision = 3;
  there.jumps = 2;
  flight.change(there);
  flight.passed.clear();
  double best_m = 1e9;
  bool back = false;
  const auto closing = [&] {
    const double d = flight.distance_to(3000, 3000);
    best_m = std::min(best_m, d);
    back = back || d > best_m + 150;  // no further back than a turn takes
    return flight.progress().reached > 0 && !flight.passed.empty();
  };
  CHECK(flight.fly(400, closing));
  CHECK_FALSE(back);
  CHECK(flight.fly(400, [&] { return flight.passed.size() == 4; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{0, 1, 2, 0});
  CHECK(flight.finite);
}

TEST_CASE("a change elsewhere in the plan leaves the aircraft on its leg") {
  Flight flight(hourglass());
  flight.fly(200, [&] {
    return flight.progress().item == 1 && flight.path().kind == PathKind::line &&
           flight.path().remaining_m < 400;
  });
  const double remaining_m = flight.path().remaining_m;
  Plan plan = flight.plan();  // one more before, one more behind
  plan.waypoints.clear();
  for (const Waypoint& w : {point(800, 800), point(400, -250), point(-400, -50), point(-400, -250),
                            point(400, -50), point(900, 100)})
    plan.waypoints.push_back(w);
  ++plan.revision;
  flight.change(plan);
  flight.step();
  CHECK(flight.progress().item == 2);
  CHECK_FALSE(flight.progress().joining);
  CHECK(flight.path().remaining_m == doctest::Approx(remaining_m).epsilon(0.01));
  CHECK(flight.progress().plan_revision == 2);
  // the waypoint that is flown to is taken away: the next one is flown to
  plan.waypoints[2] = plan.waypoints[3];
  plan.waypoints[3] = plan.waypoints[4];
  plan.waypoints[4] = plan.waypoints[5];
  --plan.waypoints.count;
  ++plan.revision;
  flight.change(plan);
  flight.step();
  CHECK(flight.progress().item == 2);
  CHECK(flight.progress().joining);
  CHECK(flight.fly(120, [&] { return flight.progress().item == 3; }));
}

TEST_CASE("the order to fly to a waypoint is followed at once") {
  Flight flight(hourglass());
  flight.fly(60);
  Plan plan = flight.plan();
  ++plan.revision;
  ++plan.jumps;
  plan.jump_item = 3;
  flight.change(plan);
  flight.passed.clear();
  flight.step();
  CHECK(flight.progress().item == 3);
  CHECK(flight.fly(200, [&] { return flight.passed.size() == 2; }));
  CHECK(flight.passed == std::vector<std::uint32_t>{3, 0});
}

TEST_CASE("a planner that begins again with the same plan does not disturb the flight") {
  Flight flight(hourglass());
  flight.fly(80);
  const Progress before = flight.progress();
  flight.change(flight.plan());  // the same revision, published once more
  flight.step();
  CHECK(flight.progress().item == before.item);
  CHECK(flight.progress().reached == before.reached);
  CHECK_FALSE(flight.progress().joining);
}

TEST_CASE("a plan that ended is flown on when a waypoint is appended") {
  Plan plan = plan_of({point(300, 0), point(600, 0)}, PlanEnd::orbit);
  Flight flight(plan);
  CHECK(flight.fly(200, [&] { return flight.progress().finished; }));
  flight.fly(20);
  plan.waypoints.push_back(point(600, 600));
  ++plan.revision;
  flight.change(plan);
  flight.step();
  CHECK_FALSE(flight.progress().finished);
  CHECK(flight.progress().item == 2);
  CHECK(flight.fly(200, [&] { return flight.progress().finished; }));
}

TEST_CASE("planner and manager together: edits in flight by request") {
  Bench<Planner> planner;
  for (const double north : {300.0, 600.0, 900.0}) {
    PlanFileWaypoint w;
    w.north_m = north;
    w.east_m = north == 600 ? 300 : 0;
    w.up_m = 70;
    planner.params.plan.value.waypoints.push_back(w);
  }
  planner.step(0.01);
  Flight flight(planner.out.plan.value);
  flight.fly(30);
  PlanEdit edit;
  edit.kind = PlanEditKind::set_current;
  edit.index = 2;
  planner.push(planner.in.edit, edit);
  planner.step(0.01);
  REQUIRE(planner.answer(planner.in.edit) == "accepted");
  flight.change(planner.out.plan.value);
  flight.step();
  CHECK(flight.progress().item == 2);
  edit.index = 9;
  planner.push(planner.in.edit, edit);
  planner.step(0.01);
  CHECK(planner.answer(planner.in.edit) != "accepted");
  CHECK_FALSE(planner.out.plan.written);
}

TEST_CASE("a single waypoint that is moved has not been reached yet, though the old one had been") {
  Plan plan = plan_of({point(300, 0)}, PlanEnd::orbit);
  Flight flight(plan);
  REQUIRE(flight.fly(100, [&] { return flight.progress().finished; }));
  plan.waypoints[0] = point(900, 0);
  plan.revision = 2;
  flight.change(plan);
  flight.step();
  CHECK_FALSE(flight.progress().finished);
  CHECK(flight.fly(100, [&] { return flight.progress().finished; }));
  CHECK(std::abs(flight.distance_to(900, 0) / 50 - 1) < 0.12);
}

}  // namespace plan_changes_test
