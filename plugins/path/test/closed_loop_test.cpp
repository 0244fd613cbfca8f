// SPDX-License-Identifier: BSD-3-Clause
// Whole flights of a kinematic aircraft in wind: how closely plans are flown, and that any plan is flown at
// all.
#include <doctest/doctest.h>

#include "flight.hpp"
#include "fulmar/random.hpp"

namespace closed_loop_test {

using namespace fulmar;
using namespace fulmar::test;

namespace {

Plan random_plan(Random& rng) {
  Plan plan = plan_of({}, rng.uniform() < 0.3 ? PlanEnd::orbit : PlanEnd::circuit);
  const std::uint32_t n = 1 + static_cast<std::uint32_t>(rng.uniform(0, 8));
  const double reach = rng.uniform() < 0.5 ? 200 : 800;
  for (std::uint32_t i = 0; i < n; ++i) {
    Waypoint w = point(rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(40, 100));
    w.has_course = rng.uniform() < 0.3;
    w.course_rad = rng.uniform(-3, 3);
    if (i > 0 && rng.uniform() < 0.15) w.position_m = plan.waypoints[i - 1].position_m;
    if (i > 1 && rng.uniform() < 0.15) w.position_m = plan.waypoints[i - 2].position_m;
    plan.waypoints.push_back(w);
  }
  return plan;
}

}  // namespace

TEST_CASE("the hourglass in 5 m/s of wind is flown to a metre") {
  Flight flight(hourglass());
  flight.aircraft.wind_north = 3;
  flight.aircraft.wind_east = -4;
  CHECK(flight.fly(400, [&] { return flight.progress().circuits == 2; }));
  CHECK(flight.rms(flight.rms_north) < 1);
  CHECK(flight.rms(flight.rms_east) < 1);
  CHECK(flight.worst_m < 5);
  CHECK(flight.passed == std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 2, 3, 0});
  CHECK(flight.finite);
}

TEST_CASE("commanding the bank of a turn ahead of it is what keeps the aircraft from overshooting") {
  double worst[2];
  for (int i = 0; i < 2; ++i) {
    Flight flight(hourglass());
    flight.field.params.field.lead_time.value = i == 0 ? 0.0 : 0.5;
    flight.fly(300);
    worst[i] = flight.worst_m;
  }
  CHECK(worst[1] < 0.4 * worst[0]);
}

TEST_CASE("a plan of Dubins paths is flown to a few metres, and each waypoint is passed in its course") {
  Plan plan = plan_of({point(400, 0, 60), point(400, 400, 80), point(0, 400, 60), point(-100, 50, 70)});
  const double courses[] = {1.2, 2.8, -2.2, -0.4};
  for (std::uint32_t i = 0; i < 4; ++i) {
    plan.waypoints[i].has_course = true;
    plan.waypoints[i].course_rad = courses[i];
  }
  Flight flight(plan);
  flight.aircraft.wind_north = 3;
  flight.aircraft.wind_east = -4;
  int passed = 0;
  for (int i = 0; i < 40000 && flight.progress().circuits < 2; ++i) {
    const Progress before = flight.progress();
    flight.step();
    if (flight.progress().reached > before.reached) {
      const Waypoint& w = plan.waypoints[before.item];
      CHECK(flight.distance_to(w.position_m.north, w.position_m.east) < 6);
      CHECK(std::abs(wrap_pi(flight.aircraft.state().course_rad - w.course_rad)) < 0.25);
      if (passed > 0) CHECK(std::abs(flight.aircraft.height + w.position_m.down) < 3);
      ++passed;
    }
  }
  CHECK(passed == 9);
  CHECK(flight.finite);
}

TEST_CASE("heights change without a step along legs and corners") {
  Flight flight(plan_of({point(0, 0, 50), point(500, 0, 90), point(500, 500, 40), point(0, 500, 70)}));
  flight.fly(100, [&] { return flight.progress().reached == 1; });
  double before = 0;
  bool begun = false;
  for (int i = 0; i < 20000; ++i) {
    flight.step();
    const double height = flight.field.out.command.height_m;
    if (begun) CHECK(std::abs(height - before) < 0.1);
    begun = true;
    before = height;
  }
}

TEST_CASE("any plan is flown: finite outputs in every step, every waypoint in turn, never lost") {
  Random rng(101);
  for (int trial = 0; trial < 40; ++trial) {
    const Plan plan = random_plan(rng);
    Flight flight(plan);
    flight.aircraft.north = rng.uniform(-500, 500);
    flight.aircraft.east = rng.uniform(-500, 500);
    flight.aircraft.psi = rng.uniform(-3, 3);
    flight.aircraft.wind_north = rng.uniform(-5, 5);
    flight.aircraft.wind_east = rng.uniform(-5, 5);
    CAPTURE(trial);
    CAPTURE(plan.waypoints.count);
    const auto done = [&] { return flight.progress().circuits >= 1 || flight.progress().finished; };
    CHECK(flight.fly(1500, done));
    CHECK(flight.finite);
    CHECK(flight.worst_m < 60);
    const std::uint32_t n = plan.waypoints.count;
    if (!Route(plan).is_point()) {
      for (std::uint32_t i = 0; i < flight.passed.size(); ++i) CHECK(flight.passed[i] == i % n);
    }
  }
}

TEST_CASE("a plan that is changed again and again in flight never upsets its outputs") {
  Random rng(7);
  Flight flight(hourglass());
  std::uint32_t revision = 1, jumps = 1;
  for (int i = 0; i < 300; ++i) {
    Plan plan = rng.uniform() < 0.3 ? random_plan(rng) : flight.plan();
    if (plan.waypoints.count > 0 && rng.uniform() < 0.5) {
      plan.waypoints[static_cast<std::uint32_t>(rng.uniform(0, plan.waypoints.count))] =
          point(rng.uniform(-900, 900), rng.uniform(-900, 900));
    }
    if (rng.uniform() < 0.2) plan.waypoints.count = plan.waypoints.count / 2;
    if (rng.uniform() < 0.2) ++jumps;
    plan.revision = ++revision;
    plan.jumps = jumps;
    plan.jump_item = static_cast<std::uint32_t>(rng.uniform(0, 12));
    flight.change(plan);
    flight.fly(rng.uniform(0, 8));
    CHECK(flight.finite);
    CHECK(flight.progress().items == plan.waypoints.count);
    CHECK(flight.progress().item <= plan.waypoints.count);
  }
}

}  // namespace closed_loop_test
