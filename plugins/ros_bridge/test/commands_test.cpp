// SPDX-License-Identifier: BSD-3-Clause
// Goals and twists in the form in which a node of ROS sends them.
#include "plugins/ros_bridge/commands.hpp"

#include <doctest/doctest.h>

#include "fulmar/testing.hpp"

namespace commands_test {

using namespace fulmar;
using namespace fulmar::ros_bridge;

namespace {

RosPoseStamped goal(double east, double north, double up) {
  RosPoseStamped m;
  m.pose.position = {east, north, up};
  return m;
}

VehicleState cruising() {
  VehicleState s;
  s.height_m = 80;
  s.height_valid = true;
  s.course_rad = 1;
  s.airspeed_mps = 17;
  s.ground_speed_mps = 20;
  return s;
}

}  // namespace

TEST_CASE("a goal is the whole plan: the old one is cleared, the new point is north, east, down") {
  Bench<Goal> bench;
  bench.params.airspeed.value = 18;
  bench.push(bench.in.goal, goal(30, 400, 90));
  bench.step(0.02);
  REQUIRE(bench.out.edits.count == 2);
  CHECK(bench.out.edits.items[0].kind == PlanEditKind::clear);
  const PlanEdit& add = bench.out.edits.items[1];
  CHECK(add.kind == PlanEditKind::append);
  CHECK(add.waypoint.position_m == Vec3<Ned>{400, 30, -90});
  CHECK(add.waypoint.airspeed_mps == 18);
  CHECK_FALSE(add.waypoint.has_course);
}

TEST_CASE("a goal that the planner refuses leaves the plan as it was: clear and append are one group") {
  Bench<Goal> bench;
  std::uint32_t group = 0;
  for (int i = 0; i < 2; ++i) {
    bench.push(bench.in.goal, goal(30, 400 + i, 90));
    bench.step(0.02);
    REQUIRE(bench.out.edits.count == 2);
    const PlanEdit &clear = bench.out.edits.items[0], &add = bench.out.edits.items[1];
    CHECK(clear.group > group);
    CHECK(add.group == clear.group);
    CHECK(clear.group_size == 2);
    CHECK(add.group_size == 2);
    group = add.group;
  }
}

TEST_CASE(
    "a goal on the ground, as rviz sends it, is meant at the present height; its heading counts when asked "
    "for") {
  Bench<Goal> bench;
  bench.params.mode.value = GoalMode::append;
  bench.params.use_heading.value = true;
  bench.push(bench.in.goal, goal(30, 400, 0));
  bench.step(0.02);
  CHECK(bench.out.edits.count == 0);  // the height is unknown
  CHECK(bench.out.refused_ratio.value == 1);
  bench.set(bench.in.state, cruising());
  RosPoseStamped west = goal(30, 400, 0);
  west.pose.orientation = {0, 0, 1, 0};  // yaw 180 degrees from east
  bench.push(bench.in.goal, west);
  bench.step(0.02);
  REQUIRE(bench.out.edits.count == 1);
  CHECK(bench.out.edits.items[0].waypoint.position_m.down == -80);
  CHECK(std::abs(bench.out.edits.items[0].waypoint.course_rad) == doctest::Approx(std::numbers::pi / 2));
  CHECK(bench.out.edits.items[0].waypoint.course_rad < 0);
}

TEST_CASE("a goal that is no number is refused") {
  Bench<Goal> bench;
  bench.push(bench.in.goal, goal(std::nan(""), 0, 50));
  bench.step(0.02);
  CHECK(bench.out.edits.count == 0);
  CHECK(bench.out.refused_ratio.value == 1);
}

TEST_CASE("a twist to the left turns the course to the left at its rate, with the bank that the turn needs") {
  Bench<Velocity> bench;
  bench.set(bench.in.state, cruising());
  RosTwist twist;
  twist.linear.x = 19;
  twist.linear.z = 2;
  twist.angular.z = 0.2;
  bench.set(bench.in.twist, twist);
  bench.step(0.01);
  for (int i = 0; i < 100; ++i) {
    bench.set(bench.in.twist, twist);
    CHECK(bench.step(0.01) == Status::ok);
  }
  const GuidanceCommand& c = bench.out.command;
  CHECK(c.course_rad == doctest::Approx(0.8));
  CHECK(c.height_m == doctest::Approx(82));
  CHECK(c.climb_rate_mps == 2);
  CHECK(c.airspeed_mps == 19);
  CHECK(c.roll_feedforward_rad == doctest::Approx(-std::atan(20 * 0.2 / 9.80665)));
}

TEST_CASE("a twist that is old, absent or no number flies straight on and level") {
  Bench<Velocity> bench;
  bench.set(bench.in.state, cruising());
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK(bench.out.command.course_rad == 1);
  RosTwist twist;
  twist.linear.x = 99;
  twist.angular.z = 0.2;
  bench.set(bench.in.twist, twist);
  bench.step(0.01);
  CHECK(bench.out.command.airspeed_mps == 25);
  const double course = bench.out.command.course_rad;
  CHECK(bench.step(1) == Status::degraded);
  CHECK(bench.out.command.course_rad == course);
  CHECK(bench.out.command.roll_feedforward_rad == 0);
  twist.linear.x = std::nan("");
  bench.set(bench.in.twist, twist);
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK(bench.out.command.airspeed_mps == 25);
}

}  // namespace commands_test
