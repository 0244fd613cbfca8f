// SPDX-License-Identifier: BSD-3-Clause
// Answers of the planner: results of edits, groups that take effect as a whole, waypoints by their ids, and
// settings of the plan.
#include <doctest/doctest.h>

#include "flight.hpp"
#include "fulmar/testing.hpp"
#include "plugins/path/planner.hpp"

namespace planner_answers_test {

using namespace fulmar;
using namespace fulmar::path;

namespace {

PlanEdit edit(PlanEditKind kind, std::uint32_t id, double north = 0) {
  PlanEdit e;
  e.kind = kind;
  e.id = id;
  e.waypoint.position_m = {north, 100, -70};
  return e;
}

PlanEdit of_group(PlanEdit e, std::uint32_t group, std::uint32_t size) {
  e.group = group;
  e.group_size = size;
  return e;
}

/// A planner with waypoints at 0, 300 and 600 m north, whose first plan is published.
struct Desk {
  Bench<Planner> bench;
  Plan plan;

  Desk() {
    for (const double north : {0.0, 300.0, 600.0}) {
      PlanFileWaypoint w;
      w.north_m = north;
      w.east_m = 100;
      w.up_m = 70;
      bench.params.plan.value.waypoints.push_back(w);
    }
    step();
  }
  void step(double dt_s = 0.02) {
    bench.step(dt_s);
    if (bench.out.plan.written) plan = bench.out.plan.value;
  }
  void push(const PlanEdit& e) {
    bench.push(bench.in.edits, e);
    step();
  }
  PlanEditResult result(std::uint32_t i = 0) {
    REQUIRE(i < bench.out.results.count);
    return bench.out.results.items[i];
  }
  std::vector<double> norths() const {
    std::vector<double> list;
    for (const Waypoint& w : plan.waypoints) list.push_back(w.position_m.north);
    return list;
  }
};

using Norths = std::vector<double>;

}  // namespace

TEST_CASE("who sends an edit learns by its number whether it was taken, and why not") {
  Desk desk;
  desk.push(edit(PlanEditKind::append, 41, 900));
  PlanEditResult r = desk.result();
  CHECK(r.id == 41);
  CHECK(r.accepted);
  CHECK(r.in_force);
  CHECK_FALSE(r.by_request);
  CHECK(r.waypoint_id == 4);
  CHECK(r.revision == desk.plan.revision);
  CHECK(desk.bench.out.notices.count == 0);
  desk.push(edit(PlanEditKind::append, 42, 900));
  r = desk.result();
  CHECK(r.id == 42);
  CHECK_FALSE(r.accepted);
  CHECK_FALSE(r.in_force);
  CHECK(r.waypoint_id == 0);
  CHECK(r.reason == "path.waypoint_before_close");
  CHECK_FALSE(desk.bench.out.plan.written);
  desk.bench.push(desk.bench.in.edit, edit(PlanEditKind::clear, 43));
  desk.step();
  CHECK(desk.result().by_request);
  CHECK(desk.result().id == 43);
  CHECK(desk.plan.waypoints.count == 0);
}

TEST_CASE(
    "a refused edit is told to people too, one and the same once a second, with how many there were "
    "between") {
  Desk desk;
  PlanEdit bad = edit(PlanEditKind::remove, 7);
  bad.index = 9;
  desk.push(bad);
  REQUIRE(desk.bench.out.notices.count == 1);
  CHECK(desk.bench.out.notices.items[0].text == "path.edit_refused(7, path.waypoint_index_unknown(9, 2))");
  CHECK(desk.bench.out.notices.items[0].severity == Severity::warning);
  int reported = 0;
  for (int i = 0; i < 49; ++i) {
    desk.push(bad);
    reported += static_cast<int>(desk.bench.out.notices.count);
  }
  CHECK(reported == 0);
  desk.push(bad);
  REQUIRE(desk.bench.out.notices.count == 1);
  CHECK(desk.bench.out.notices.items[0].text ==
        "path.edit_refused_again(7, path.waypoint_index_unknown(9, 2), 49)");
  CHECK(desk.bench.out.refused_ratio.value == 51);
  desk.push(of_group(edit(PlanEditKind::append, 0, 900), 3, 0));
  REQUIRE(desk.bench.out.notices.count == 1);  // another reason is reported at once
  CHECK(desk.bench.out.notices.items[0].text == "path.edit_without_id_refused(path.group_size_missing)");
}

TEST_CASE("a waypoint keeps its id whatever is edited around it, and an id is given once") {
  Desk desk;
  for (std::uint32_t i = 0; i < 3; ++i) CHECK(desk.plan.waypoints[i].id == i + 1);
  PlanEdit before = edit(PlanEditKind::insert, 1, 150);
  before.waypoint_id = 2;
  desk.push(before);
  CHECK(desk.result().waypoint_id == 4);
  CHECK(desk.norths() == Norths{0, 150, 300, 600});
  PlanEdit move = edit(PlanEditKind::replace, 2, 350);
  move.waypoint_id = 2;  // index is 0, and not looked at
  desk.push(move);
  CHECK(desk.result().waypoint_id == 2);
  CHECK(desk.norths() == Norths{0, 150, 350, 600});
  CHECK(desk.plan.waypoints[2].id == 2);
  PlanEdit go = edit(PlanEditKind::set_current, 3);
  go.waypoint_id = 3;
  desk.push(go);
  CHECK(desk.plan.jump_item == 3);
  PlanEdit away = edit(PlanEditKind::remove, 4);
  away.waypoint_id = 4;
  desk.push(away);
  CHECK(desk.norths() == Norths{0, 350, 600});
  desk.push(away);
  CHECK(desk.result().reason == "path.waypoint_id_unknown(4)");
  desk.push(edit(PlanEditKind::clear, 5));
  desk.push(edit(PlanEditKind::append, 6, 10));
  CHECK(desk.result().waypoint_id == 5);
}

TEST_CASE("a group takes effect with its last edit, in one plan") {
  Desk desk;
  const std::uint32_t revision = desk.plan.revision;
  desk.push(of_group(edit(PlanEditKind::clear, 1), 5, 3));
  CHECK(desk.result().accepted);
  CHECK_FALSE(desk.result().in_force);
  CHECK_FALSE(desk.bench.out.plan.written);
  desk.push(of_group(edit(PlanEditKind::append, 2, 50), 5, 3));
  CHECK_FALSE(desk.bench.out.plan.written);
  desk.push(of_group(edit(PlanEditKind::append, 3, 80), 5, 3));
  CHECK(desk.result().in_force);
  CHECK(desk.result().group == 5);
  CHECK(desk.norths() == Norths{50, 80});
  CHECK(desk.plan.revision == revision + 1);
  CHECK(desk.result().revision == revision + 1);
}

TEST_CASE("of a group with one fault nothing takes effect, and each of its edits is answered") {
  Desk desk;
  const Norths as_it_was = desk.norths();
  PlanEdit bad = edit(PlanEditKind::remove, 2);
  bad.waypoint_id = 77;
  for (const PlanEdit& e : {of_group(edit(PlanEditKind::clear, 1), 5, 3), of_group(bad, 5, 3),
                            of_group(edit(PlanEditKind::append, 3, 900), 5, 3)})
    desk.bench.push(desk.bench.in.edits, e);
  desk.step();
  REQUIRE(desk.bench.out.results.count == 3);
  CHECK(desk.result(0).accepted);
  CHECK(desk.result(1).reason == "path.waypoint_id_unknown(77)");
  CHECK(desk.result(2).reason == "path.group_refused");
  for (std::uint32_t i = 0; i < 3; ++i) CHECK_FALSE(desk.result(i).in_force);
  CHECK(desk.norths() == as_it_was);
  CHECK_FALSE(desk.bench.out.plan.written);
  desk.push(edit(PlanEditKind::append, 4, 900));  // the next is free
  CHECK(desk.result().in_force);
}

TEST_CASE("waypoints of a group may be anywhere on the way, but are apart at its end") {
  Desk desk;
  PlanEdit first = edit(PlanEditKind::replace, 1, 300), second = edit(PlanEditKind::replace, 2, 0);
  first.waypoint_id = 1;
  second.waypoint_id = 2;
  desk.push(first);
  CHECK(desk.result().reason == "path.waypoint_after_close");
  desk.push(of_group(first, 8, 2));
  desk.push(of_group(second, 8, 2));
  CHECK(desk.norths() == Norths{300, 0, 600});
  second.waypoint.position_m.north = 600;
  desk.push(of_group(second, 9, 1));
  CHECK(desk.result().reason == "path.waypoints_close(1, 2)");
  CHECK(desk.norths() == Norths{300, 0, 600});
}

TEST_CASE("a group that is not completed, or comes while the plan is changed, is refused") {
  Desk desk;
  desk.push(of_group(edit(PlanEditKind::append, 1, 900), 5, 2));
  desk.push(of_group(edit(PlanEditKind::append, 2, 1200), 6, 2));
  REQUIRE(desk.bench.out.results.count == 2);
  CHECK(desk.result(0).group == 5);
  CHECK(desk.result(0).id == 1);
  CHECK(desk.result(0).reason == "path.group_incomplete");
  CHECK(desk.result(1).accepted);
  desk.bench.push(desk.bench.in.edit, edit(PlanEditKind::append, 3, 1500));  // from the ground, meanwhile
  desk.step();
  CHECK(desk.result().in_force);
  desk.push(of_group(edit(PlanEditKind::append, 4, 1800), 6, 2));
  CHECK(desk.result().reason == "path.group_outdated");
  CHECK(desk.norths() == Norths{0, 300, 600, 1500});
  desk.push(of_group(edit(PlanEditKind::append, 5, 1800), 7, 0));
  CHECK(desk.result().reason == "path.group_size_missing");
  desk.push(of_group(edit(PlanEditKind::append, 6, 1800), 8, 2));
  desk.push(of_group(edit(PlanEditKind::append, 7, 2100), 8, 3));
  CHECK(desk.result().reason == "path.group_sizes_differ");
}

TEST_CASE("revisions grow by one, also when a group began in the step that published another edit") {
  Desk desk;
  const std::uint32_t revision = desk.plan.revision;
  desk.bench.push(desk.bench.in.edits, edit(PlanEditKind::append, 1, 900));
  desk.bench.push(desk.bench.in.edits, of_group(edit(PlanEditKind::append, 2, 1200), 4, 2));
  desk.step();
  CHECK(desk.plan.revision == revision + 1);
  desk.push(of_group(edit(PlanEditKind::append, 3, 1500), 4, 2));
  CHECK(desk.result().in_force);
  CHECK(desk.plan.revision == revision + 2);
}

TEST_CASE("end, radius and airspeed of the plan are edited, within their ranges") {
  Desk desk;
  PlanEdit end = edit_of(PlanSetting::end), radius = edit_of(PlanSetting::turn_radius),
           speed = edit_of(PlanSetting::airspeed);
  end.end = PlanEnd::orbit;
  radius.turn_radius_m = 80;
  speed.airspeed_mps = 21;
  for (const PlanEdit& e : {of_group(end, 1, 3), of_group(radius, 1, 3), of_group(speed, 1, 3)}) desk.push(e);
  CHECK(desk.plan.end == PlanEnd::orbit);
  CHECK(desk.plan.turn_radius_m == 80);
  CHECK(desk.plan.airspeed_mps == 21);
  CHECK(desk.plan.waypoints.count == 3);
  radius.turn_radius_m = 0.5;
  desk.push(radius);
  CHECK(desk.result().reason == "path.turn_radius_out_of_range(0.5)");
  speed.airspeed_mps = 1;
  desk.push(speed);
  CHECK(desk.result().reason == "path.airspeed_out_of_range(1)");
  CHECK(desk.plan.turn_radius_m == 80);
}

TEST_CASE("the manager goes on along its leg at once when radius, airspeed and end are edited") {
  Plan plan = test::hourglass();
  test::Flight flight(plan);
  REQUIRE(flight.fly(200, [&] { return flight.progress().reached == 2; }));
  flight.fly(3);
  const std::uint32_t item = flight.progress().item;
  plan.revision = 2;
  plan.turn_radius_m = 70;
  plan.airspeed_mps = 20;
  flight.change(plan);
  flight.step();
  CHECK_FALSE(flight.progress().joining);
  CHECK(flight.progress().item == item);
  CHECK(flight.path().airspeed_mps == 20);
  double radius = 0;
  REQUIRE(flight.fly(200, [&] {
    if (flight.path().kind == PathKind::orbit) radius = flight.path().radius_m;
    return flight.progress().reached == 4;
  }));
  CHECK(radius == doctest::Approx(70));
  CHECK(flight.worst_m < 5);
  plan.revision = 3;
  plan.end = PlanEnd::orbit;
  flight.change(plan);
  CHECK(flight.fly(200, [&] { return flight.progress().finished; }));
  CHECK(flight.finite);
}

TEST_CASE("an airspeed that is edited on the way to the plan, or around no plan, is flown at once") {
  Plan plan = test::hourglass();
  for (Waypoint& w : plan.waypoints) w.has_course = true;
  test::Flight joining(plan);
  joining.step();
  REQUIRE(joining.progress().joining);
  plan.revision = 2;
  plan.airspeed_mps = 21;
  plan.waypoints[1].position_m.east += 60;  // of the leg that comes after the way there
  joining.change(plan);
  joining.step();
  CHECK(joining.progress().joining);
  CHECK(joining.path().airspeed_mps == 21);
  joining.fly(200, [&] { return joining.progress().reached == 2; });
  CHECK(joining.progress().miss_m < 10);

  Plan none = test::plan_of({});
  test::Flight waiting(none);
  waiting.step();
  none.revision = 2;
  none.turn_radius_m = 90;
  waiting.change(none);
  waiting.step();
  CHECK(waiting.path().radius_m == 90);
}

TEST_CASE("a group is taken without allocation") {
  Desk desk;
  desk.bench.push(desk.bench.in.edits, of_group(edit(PlanEditKind::clear, 1), 5, 2));
  desk.bench.push(desk.bench.in.edits, of_group(edit(PlanEditKind::append, 2, 50), 5, 2));
  CHECK(allocations([&] { desk.bench.step(0.02); }) == 0);
  CHECK(desk.result(1).in_force);
}

}  // namespace planner_answers_test
