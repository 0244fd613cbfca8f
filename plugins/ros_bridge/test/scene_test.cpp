// SPDX-License-Identifier: BSD-3-Clause
// Data for viewers, against lengths, radii and places on the ellipsoid with closed forms.
#include "plugins/ros_bridge/scene.hpp"

#include <doctest/doctest.h>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/testing.hpp"

namespace scene_test {

using namespace fulmar;
using namespace fulmar::ros_bridge;

namespace {

constexpr double pi = std::numbers::pi;

VehicleState at(double north, double east, double up) {
  VehicleState s;
  s.position_m = {north, east, -up};
  s.attitude = from_eigen(quaternion_from({0, 0, pi / 2}));
  s.attitude_valid = s.position_valid = s.height_valid = s.origin_valid = true;
  s.origin_latitude_deg = 40;
  s.origin_longitude_deg = -111;
  s.origin_altitude_m = 1400;
  return s;
}

Plan plan_of(std::initializer_list<Vec3<Ned>> points, PlanEnd end = PlanEnd::circuit) {
  Plan plan;
  plan.end = end;
  for (const Vec3<Ned>& p : points) {
    Waypoint w;
    w.position_m = p;
    plan.waypoints.push_back(w);
  }
  return plan;
}

const std::initializer_list<Vec3<Ned>> square = {{0, 0, -70}, {400, 0, -70}, {400, 400, -90}, {0, 400, -90}};

double length_of(const RosRoute& route) {
  double sum = 0;
  for (std::uint32_t i = 1; i < route.poses.count; ++i) {
    const RosPoint &p = route.poses[i - 1].pose.position, &q = route.poses[i].pose.position;
    sum += std::hypot(q.x - p.x, q.y - p.y);
  }
  return sum;
}

double from(const RosPoseStamped& p, double north, double east) {
  return std::hypot(p.pose.position.x - east, p.pose.position.y - north);
}

struct Drawn : Bench<Scene> {
  RosRoute of(const Plan& plan) {
    set(in.plan, plan);
    int steps = 0;
    for (step(0.1); !out.route.written && steps < 100; ++steps) step(0.1);
    REQUIRE(out.route.written);
    return out.route.value;
  }
};

}  // namespace

TEST_CASE("the aircraft is where it is: a frame under the world, a pose, and a place on the ellipsoid") {
  Bench<Scene> bench;
  bench.params.geoid_separation.value = -17;
  bench.component().configure(bench.params);
  VehicleState s = at(1000, 500, 80);
  s.position_std_m = {1, 2, 3};
  bench.set(bench.in.state, s);
  bench.step(0.1);
  REQUIRE(bench.out.tf.value.transforms.count == 1);
  const RosTransformStamped& tf = bench.out.tf.value.transforms[0];
  CHECK(tf.header.frame_id.view() == "map");
  CHECK(tf.child_frame_id.view() == "base_link");
  CHECK(tf.header.stamp.sec == 1767225600);
  CHECK(tf.transform.translation.x == 500);
  CHECK(tf.transform.translation.y == 1000);
  CHECK(tf.transform.translation.z == 80);
  CHECK(tf.transform.rotation.w == doctest::Approx(1));  // nose to the east: no rotation in east-north-up
  CHECK(bench.out.pose.value.pose.position.y == 1000);
  // radii of curvature of the ellipsoid in the meridian and across it: M, N
  const double a = 6378137, e2 = 0.00669437999014, w2 = 1 - e2 * std::pow(std::sin(40 * pi / 180), 2);
  const double M = a * (1 - e2) / std::pow(w2, 1.5), N = a / std::sqrt(w2);
  const RosNavSatFix& fix = bench.out.fix.value;
  REQUIRE(bench.out.fix.written);
  CHECK((fix.latitude - 40) * pi / 180 * (M + 1480) == doctest::Approx(1000).epsilon(1e-4));
  CHECK((fix.longitude + 111) * pi / 180 * (N + 1480) * std::cos(fix.latitude * pi / 180) ==
        doctest::Approx(500).epsilon(1e-4));
  CHECK(fix.altitude - 1463 == doctest::Approx(1.25 / (2 * 6.37)).epsilon(0.02));  // the Earth falls off
  CHECK(fix.status.status == 0);
  CHECK(fix.position_covariance_type == 2);
  CHECK(fix.position_covariance[0] == 4);  // east first
}

TEST_CASE("an origin that moves is followed") {
  Bench<Scene> bench;
  bench.set(bench.in.state, at(0, 0, 0));
  bench.step(0.1);
  VehicleState s = at(0, 0, 0);
  s.origin_longitude_deg = -110;
  bench.set(bench.in.state, s);
  bench.step(0.1);
  CHECK(bench.out.fix.value.longitude == doctest::Approx(-110));
}

TEST_CASE("without a place of its own the aircraft is on the map where its receiver says, or nowhere") {
  Gnss gnss;
  gnss.latitude_deg = 47;
  gnss.longitude_deg = 8;
  gnss.altitude_m = 500;
  gnss.fix = FixType::fix_3d;
  Bench<Scene> bench;
  VehicleState s = at(1000, 0, 80);
  s.origin_valid = false;
  bench.set(bench.in.state, s);
  bench.step(0.1);
  CHECK(bench.out.tf.written);
  CHECK_FALSE(bench.out.fix.written);
  s.origin_valid = true;
  s.origin_latitude_deg = 95;  // no place at all
  bench.set(bench.in.state, s);
  bench.step(0.1);
  CHECK_FALSE(bench.out.fix.written);
  bench.set(bench.in.gnss, gnss);
  bench.step(0.1);
  REQUIRE(bench.out.fix.written);
  CHECK(bench.out.fix.value.latitude == 47);
  CHECK(bench.out.fix.value.status.status == 0);
  bench.set(bench.in.state, at(0, 0, 80));  // both from the estimate
  bench.set(bench.in.gnss, gnss);
  bench.step(0.1);
  CHECK(bench.out.fix.value.latitude == doctest::Approx(40));
  s = at(0, 0, 80);
  s.position_valid = false;  // lost
  bench.set(bench.in.state, s);
  bench.step(0.1);
  CHECK_FALSE(bench.out.tf.written);
  CHECK_FALSE(bench.out.pose.written);
  CHECK_FALSE(bench.out.fix.written);
}

TEST_CASE("nobody navigates and nobody plans: the aircraft is drawn, and nothing else is said") {
  Bench<Scene> bench;
  bench.step(0.1);
  CHECK_FALSE(bench.out.tf.written);
  CHECK_FALSE(bench.out.fix.written);
  CHECK_FALSE(bench.out.route.written);
  REQUIRE(bench.out.markers.written);
  CHECK(bench.out.markers.value.markers.count == 2);
}

TEST_CASE("a circuit is drawn with its fillets, closed, at the heights of its legs") {
  Drawn bench;
  const RosRoute route = bench.of(plan_of(square));
  // each corner of a radius of 50 m takes two tangents of 50 m and gives a quarter of a circle
  CHECK(length_of(route) == doctest::Approx(4 * 400 - 8 * 50 + 2 * pi * 50).epsilon(5e-4));
  const auto& poses = route.poses;
  CHECK(from(poses[0], poses[poses.count - 1].pose.position.y, poses[poses.count - 1].pose.position.x) <
        1e-6);
  CHECK(route.header.frame_id.view() == "map");
  double nearest = 1e9, lowest = 1e9, highest = 0;
  for (const RosPoseStamped& p : poses) {
    nearest = std::min(nearest, from(p, 400, 0));
    lowest = std::min(lowest, p.pose.position.z);
    highest = std::max(highest, p.pose.position.z);
  }
  CHECK(nearest == doctest::Approx(50 * (std::sqrt(2) - 1)).epsilon(1e-6));  // the middle of the fillet
  CHECK(lowest == doctest::Approx(70));
  CHECK(highest == doctest::Approx(90));
  // poses point along the route: a heading in the middle of the leg north is that of the tangent
  for (std::uint32_t i = 1; i + 1 < poses.count; ++i) {
    const RosPoint &p = poses[i - 1].pose.position, &q = poses[i + 1].pose.position;
    double course = 0;
    REQUIRE(course_of(poses[i].pose.orientation, course));
    const double along = (q.x - p.x) * std::sin(course) + (q.y - p.y) * std::cos(course);
    CHECK(along > 0.98 * std::hypot(q.x - p.x, q.y - p.y));
  }
}

TEST_CASE("arcs are round: no chord is longer than a tenth of a radian or two of them") {
  Drawn bench;
  const RosRoute route = bench.of(plan_of(square));
  std::uint32_t round = 0;
  for (const RosPoseStamped& p : route.poses)
    if (from(p, 350, 50) == doctest::Approx(50).epsilon(1e-6)) ++round;
  CHECK(round >= 10);  // of the fillet at 400 north, 0 east: a quarter, every 9 or 10 degrees
}

TEST_CASE("a plan that ends in an orbit begins at its first waypoint and goes once round its last") {
  Drawn bench;
  const RosRoute route = bench.of(plan_of({{0, 0, -70}, {300, 0, -70}, {300, 300, -80}}, PlanEnd::orbit));
  const auto& poses = route.poses;
  CHECK(from(poses[0], 0, 0) < 1e-9);
  for (std::uint32_t i = poses.count - 37; i < poses.count; ++i) {
    CHECK(from(poses[i], 300, 300) == doctest::Approx(50));
    CHECK(poses[i].pose.position.z == doctest::Approx(80));
  }
  const RosPoint& end = poses[poses.count - 38].pose.position;  // the leg ends where the orbit begins
  CHECK(from(poses[poses.count - 37], end.y, end.x) < 1e-6);
}

TEST_CASE("one waypoint is a circle, none is an empty path that takes the old one away") {
  Drawn bench;
  const RosRoute circle = bench.of(plan_of({{100, 20, -60}}));
  REQUIRE(circle.poses.count == 37);
  for (const RosPoseStamped& p : circle.poses) {
    CHECK(from(p, 100, 20) == doctest::Approx(50));
    double course = 0;
    REQUIRE(course_of(p.pose.orientation, course));
    const double east = p.pose.position.x - 20, north = p.pose.position.y - 100;
    // clockwise along the circle: to the right of the way outwards
    CHECK(std::sin(course) * north - std::cos(course) * east == doctest::Approx(50));
  }
  CHECK(bench.of(Plan{}).poses.count == 0);
}

TEST_CASE("route and markers are told when the plan changes, and once a minute") {
  Bench<Scene> bench;
  Plan plan = plan_of(square);
  bench.set(bench.in.plan, plan);
  bench.step(0.1);
  CHECK(bench.out.route.written);
  CHECK(bench.out.markers.written);
  int again = 0;
  for (int i = 0; i < 598; ++i) {
    plan.revision++;
    plan.jumps++;  // the drawn parts are the same
    bench.set(bench.in.plan, plan);
    bench.step(0.1);
    again += bench.out.route.written || bench.out.markers.written;
  }
  CHECK(again == 0);
  bench.step(0.3);
  CHECK(bench.out.route.written);
  CHECK(bench.out.markers.written);
  plan.waypoints[2].position_m.down = -91;
  bench.set(bench.in.plan, plan);
  bench.step(0.1);
  CHECK(bench.out.route.written);
  CHECK(bench.out.markers.written);
  plan.turn_radius_m = 60;
  bench.set(bench.in.plan, plan);
  bench.step(0.1);
  CHECK(bench.out.route.written);
  bench.step(0.1);
  CHECK_FALSE(bench.out.route.written);
}

TEST_CASE("the largest plan takes its steps, has room, and leads past every waypoint") {
  Drawn bench;
  Plan plan;
  for (std::uint32_t i = 0; i < 1024; ++i) {
    Waypoint w;
    w.position_m = {300.0 * (i / 32), 300.0 * (i / 32 % 2 ? 31 - i % 32 : i % 32), -70};
    plan.waypoints.push_back(w);
  }
  bench.set(bench.in.plan, plan);
  std::uint64_t allocated = 0;
  int steps = 0;
  do {
    allocated += allocations([&] { bench.step(0.1); });
    ++steps;
  } while (!bench.out.route.written && steps < 100);
  CHECK(allocated == 0);
  CHECK(steps == 32);
  const auto& poses = bench.out.route.value.poses;
  CHECK(poses.count >= 1025);
  CHECK(poses.count <= 2048 - 37);
  std::uint32_t passed = 0, at_pose = 0;
  for (const Waypoint& w : plan.waypoints) {
    while (at_pose < poses.count && from(poses[at_pose], w.position_m.north, w.position_m.east) > 25)
      ++at_pose;
    passed += at_pose < poses.count;
  }
  CHECK(passed >= 1023);  // the first one of a circuit is where it ends
}

TEST_CASE("the aircraft is as wide as its wing, the same on both sides, and goes with its frame") {
  Bench<Scene> bench;
  Airframe airframe;
  airframe.wing.span_m = 2.5;
  airframe.wing.chord_m = 0.3;
  bench.params.airframe.value = airframe;
  bench.params.magnify.value = 4;
  bench.step(0.1);
  const auto& markers = bench.out.markers.value.markers;
  REQUIRE(markers.count == 2);
  CHECK(markers[0].action == 3);
  const RosMarker& m = markers[1];
  CHECK(m.header.frame_id.view() == "base_link");
  CHECK(m.frame_locked);
  CHECK(m.type == 11);
  CHECK(m.color.a == 1);
  REQUIRE(m.points.count > 0);
  CHECK(m.points.count % 3 == 0);
  double left = 0, right = 0, front = 0, back = 0, sum_y = 0, up = 0;
  for (const RosPoint& p : m.points) {
    left = std::max(left, p.y);
    right = std::min(right, p.y);
    front = std::max(front, p.x);
    back = std::min(back, p.x);
    up = std::max(up, p.z);
    sum_y += p.y;
  }
  CHECK(left == doctest::Approx(5));
  CHECK(right == doctest::Approx(-5));
  CHECK(std::abs(sum_y) < 1e-9);
  CHECK(front > 0);
  CHECK(-back > front);       // the tail is the long end
  CHECK(up > 0.1 * 2.5 * 4);  // a fin, upwards
}

TEST_CASE("every waypoint has its ball, the first ones their index, and none is left of the plan before") {
  Drawn bench;
  Plan plan;
  for (int i = 0; i < 1024; ++i) {
    Waypoint w;
    w.position_m = {10.0 * i, 5, -70};
    plan.waypoints.push_back(w);
  }
  bench.set(bench.in.plan, plan);
  bench.step(0.1);
  const auto& markers = bench.out.markers.value.markers;
  REQUIRE(bench.out.markers.written);
  CHECK(markers[0].action == 3);
  std::uint32_t balls = 0, labels = 0;
  for (const RosMarker& m : markers) {
    if (m.type == 7) balls += m.points.count;
    if (m.type != 9) continue;
    CHECK(m.text.view() == std::to_string(labels));
    CHECK(m.pose.position.y == 10.0 * labels);
    CHECK(m.pose.position.z > 70);
    ++labels;
  }
  CHECK(balls == 1024);
  CHECK(labels == 32);
  plan.waypoints.count = 2;
  bench.set(bench.in.plan, plan);
  bench.step(0.1);
  CHECK(markers.count == 2 + 1 + 2);
}

TEST_CASE("a step of the scene allocates nothing") {
  Bench<Scene> bench;
  bench.step(0.1);
  bench.set(bench.in.state, at(10, 20, 30));
  bench.set(bench.in.plan, plan_of(square));
  CHECK(allocations([&] { bench.step(0.1); }) == 0);
  CHECK(bench.out.fix.written);
  CHECK(bench.out.route.written);
}

}  // namespace scene_test
