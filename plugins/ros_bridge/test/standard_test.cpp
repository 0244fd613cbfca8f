// SPDX-License-Identifier: BSD-3-Clause
// The conversions against attitudes and vectors with an evident result, and against rotation matrices written
// by hand.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/ros_bridge/standard.hpp"

#include <doctest/doctest.h>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/testing.hpp"

namespace standard_test {

using namespace fulmar;
using namespace fulmar::ros_bridge;

namespace {

constexpr double pi = std::numbers::pi;

VehicleState flying(double roll, double pitch, double yaw) {
  VehicleState s;
  s.position_m = {100, 20, -70};
  s.height_m = 70;
  s.attitude = from_eigen(quaternion_from({roll, pitch, yaw}));
  s.attitude_valid = s.position_valid = s.height_valid = s.velocity_valid = true;
  return s;
}

RosOdometry odometry_of(const VehicleState& s) {
  Bench<Standard> bench;
  bench.set(bench.in.state, s);
  bench.step(0.01);
  REQUIRE(bench.out.odometry.written);
  return bench.out.odometry.value;
}

/// Where a body axis (forward, left, up) points in the world (east, north, up), by the textbook formula for a
/// rotated vector.
Eigen::Vector3d turned(const RosQuaternion& q, const Eigen::Vector3d& v) {
  const Eigen::Vector3d u(q.x, q.y, q.z);
  return 2 * u.dot(v) * u + (q.w * q.w - u.dot(u)) * v + 2 * q.w * u.cross(v);
}

void check_vector(const Eigen::Vector3d& v, double x, double y, double z) {
  CHECK(v.x() == doctest::Approx(x).epsilon(1e-9));
  CHECK(v.y() == doctest::Approx(y).epsilon(1e-9));
  CHECK(v.z() == doctest::Approx(z).epsilon(1e-9));
}

}  // namespace

TEST_CASE("north and level is a yaw of 90 degrees and nothing else; east and level is no rotation") {
  const RosQuaternion north = odometry_of(flying(0, 0, 0)).pose.pose.orientation;
  CHECK(north.w == doctest::Approx(std::sqrt(0.5)));
  CHECK(north.z == doctest::Approx(std::sqrt(0.5)));
  CHECK(std::abs(north.x) < 1e-12);
  CHECK(std::abs(north.y) < 1e-12);
  const RosQuaternion east = odometry_of(flying(0, 0, pi / 2)).pose.pose.orientation;
  CHECK(east.w == doctest::Approx(1));
}

TEST_CASE(
    "the aircraft is not upside down: up stays up, a climb points up, a right bank lowers the right wing") {
  const RosQuaternion level = odometry_of(flying(0, 0, 0.3)).pose.pose.orientation;
  check_vector(turned(level, {0, 0, 1}), 0, 0, 1);
  const RosQuaternion climb = odometry_of(flying(0, 0.2, 0)).pose.pose.orientation;
  check_vector(turned(climb, {1, 0, 0}), 0, std::cos(0.2), std::sin(0.2));
  const RosQuaternion bank =
      odometry_of(flying(0.5, 0, 0)).pose.pose.orientation;  // left wing up and to the west
  check_vector(turned(bank, {0, 1, 0}), -std::cos(0.5), 0, std::sin(0.5));
}

TEST_CASE("positions are east, north, up; speeds are forward, left, up") {
  VehicleState s = flying(0, 0, pi / 2);  // nose to the east
  s.velocity_mps = {1, 18, -2};           // it drifts north, to its left, and climbs
  s.rate_radps = {0.1, 0.2, 0.3};         // roll right, pitch up, yaw right
  const RosOdometry o = odometry_of(s);
  CHECK(o.pose.pose.position.x == 20);
  CHECK(o.pose.pose.position.y == 100);
  CHECK(o.pose.pose.position.z == 70);
  check_vector({o.twist.twist.linear.x, o.twist.twist.linear.y, o.twist.twist.linear.z}, 18, 1, 2);
  check_vector({o.twist.twist.angular.x, o.twist.twist.angular.y, o.twist.twist.angular.z}, 0.1, -0.2, -0.3);
  CHECK(o.header.frame_id.view() == "map");
  CHECK(o.child_frame_id.view() == "base_link");
}

TEST_CASE(
    "covariances stand in the order that ROS reads: x, y, z, then rotations, world for the pose, body for "
    "the twist") {
  VehicleState s = flying(0, 0, pi / 2);
  s.position_std_m = {1, 2, 3};
  s.attitude_std_rad = {0.1, 0.2, 0.3};
  s.velocity_std_mps = {0.5, 0.6, 0.7};
  const RosOdometry o = odometry_of(s);
  const double pose[6] = {4, 1, 9, 0.04, 0.01, 0.09};  // east, north, up; about east, north, up
  const double twist[3] = {0.36, 0.25, 0.49};          // the nose points east: forward is east, left is north
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(o.pose.covariance[6 * i + k] == doctest::Approx(i == k ? pose[i] : 0));
      if (i < 3 && k < 3) CHECK(o.twist.covariance[6 * i + k] == doctest::Approx(i == k ? twist[i] : 0));
    }
  CHECK(o.twist.covariance[21] == doctest::Approx(1e18));
}

TEST_CASE(
    "at rest an accelerometer shows gravity's reaction upwards, and without an attitude the orientation says "
    "so") {
  Bench<Standard> bench;
  bench.params.force_std.value = 0.2;
  Imu imu;
  imu.specific_force_mps2 = {0, 0, -9.81};
  imu.rate_radps = {0, 0, 0.5};
  bench.set(bench.in.imu, imu);
  bench.step(0.01);
  REQUIRE(bench.out.imu.written);
  const RosImu& m = bench.out.imu.value;
  CHECK(m.linear_acceleration.z == 9.81);
  CHECK(m.angular_velocity.z == -0.5);
  CHECK(m.orientation_covariance[0] == -1);
  CHECK(m.linear_acceleration_covariance[4] == doctest::Approx(0.04));
  CHECK(m.angular_velocity_covariance[0] == 0);
}

TEST_CASE(
    "tf tells the body, and the frames that point north and down, so that their axes come out as they are "
    "called") {
  Bench<Standard> bench;
  bench.params.world.value = "uav1/map";
  bench.set(bench.in.state, flying(0.1, 0.2, 0.3));
  bench.step(0.01);
  const RosTf& tf = bench.out.tf.value;
  REQUIRE(tf.transforms.count == 3);
  CHECK(tf.transforms[0].child_frame_id.view() == "base_link");
  CHECK(tf.transforms[0].transform.translation.z == 70);
  CHECK(tf.transforms[1].header.frame_id.view() == "uav1/map");
  CHECK(tf.transforms[1].child_frame_id.view() == "uav1/map_ned");
  check_vector(turned(tf.transforms[1].transform.rotation, {1, 0, 0}), 0, 1, 0);   // north, in east-north-up
  check_vector(turned(tf.transforms[1].transform.rotation, {0, 0, 1}), 0, 0, -1);  // down
  CHECK(tf.transforms[2].child_frame_id.view() == "base_link_frd");
  check_vector(turned(tf.transforms[2].transform.rotation, {0, 1, 0}), 0, -1, 0);  // right
}

TEST_CASE("stamps are UTC: from the epoch until a fix tells better, and then for good") {
  Bench<Standard> bench;
  bench.set(bench.in.state, flying(0, 0, 0));
  bench.step(1.25);
  CHECK(bench.out.pose.value.header.stamp.sec ==
        1767225600);  // 2026-01-01T00:00Z: the sample is of flight time 0
  Gnss gnss;
  gnss.fix = FixType::fix_3d;
  gnss.utc_ns = 1'800'000'000'250'000'000;
  bench.set(bench.in.gnss, gnss);  // of flight time 1.25 s
  bench.set(bench.in.state, flying(0, 0, 0));
  bench.step(0.5);
  CHECK(bench.out.pose.value.header.stamp.sec == 1'800'000'000);
  CHECK(bench.out.pose.value.header.stamp.nanosec == 250'000'000);
  gnss.utc_ns += 60'000'000'000;  // a receiver that changes its mind
  bench.set(bench.in.gnss, gnss);
  bench.set(bench.in.state, flying(0, 0, 0));
  bench.step(0.5);
  CHECK(bench.out.pose.value.header.stamp.sec == 1'800'000'000);
  CHECK(bench.out.pose.value.header.stamp.nanosec == 750'000'000);
}

TEST_CASE("fixes: altitude above the ellipsoid, covariance east north up, no fix told as such") {
  Bench<Standard> bench;
  bench.params.geoid_separation.value = -17;
  Gnss gnss;
  gnss.latitude_deg = 40.25;
  gnss.longitude_deg = -111.5;
  gnss.altitude_m = 1400;
  gnss.horizontal_std_m = 1.5;
  gnss.vertical_std_m = 3;
  gnss.fix = FixType::fix_3d;
  bench.set(bench.in.gnss, gnss);
  bench.step(0.01);
  RosNavSatFix fix = bench.out.fix.value;
  CHECK(fix.altitude == 1383);
  CHECK(fix.status.status == 0);
  CHECK(fix.position_covariance_type == 2);
  CHECK(fix.position_covariance[0] == 2.25);
  CHECK(fix.position_covariance[8] == 9);
  gnss.fix = FixType::none;
  gnss.horizontal_std_m = unknown_std;
  bench.set(bench.in.gnss, gnss);
  bench.step(0.01);
  fix = bench.out.fix.value;
  CHECK(int{fix.status.status} == -1);
  CHECK(fix.position_covariance_type == 0);
}

TEST_CASE(
    "the plan is drawn closed, the orbit round its centre, and nothing is said of a place that is not "
    "known") {
  Bench<Standard> bench;
  Plan plan;
  for (const double north : {0.0, 200.0}) {
    Waypoint w;
    w.position_m = {north, 50, -60};
    plan.waypoints.push_back(w);
  }
  Path orbit;
  orbit.kind = PathKind::orbit;
  orbit.origin_m = {10, 20, -70};
  orbit.radius_m = 50;
  VehicleState lost = flying(0, 0, 0);
  lost.position_valid = false;
  bench.set(bench.in.plan, plan);
  bench.set(bench.in.path, orbit);
  bench.set(bench.in.state, lost);
  bench.step(0.01);
  CHECK_FALSE(bench.out.pose.written);
  CHECK_FALSE(bench.out.tf.written);
  const auto& poses = bench.out.plan.value.poses;
  REQUIRE(poses.count == 3);
  CHECK(poses[1].pose.position.y == 200);
  CHECK(poses[1].pose.orientation.z == doctest::Approx(std::sqrt(0.5)));  // that leg points north
  CHECK(poses[2].pose.position.y == 0);
  const auto& round = bench.out.piece.value.poses;
  REQUIRE(round.count == 73);
  for (const RosPoseStamped& p : round)
    CHECK(std::hypot(p.pose.position.x - 20, p.pose.position.y - 10) == doctest::Approx(50));
  CHECK(round[18].pose.position.x ==
        doctest::Approx(70));  // to the right from the north: a quarter later in the east
}

TEST_CASE("a step allocates nothing") {
  Bench<Standard> bench;
  bench.step(0.01);
  bench.set(bench.in.state, flying(0.1, 0.2, 0.3));
  bench.set(bench.in.imu, Imu{});
  bench.set(bench.in.gnss, Gnss{});
  bench.set(bench.in.plan, Plan{});
  bench.set(bench.in.path, Path{});
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
  CHECK(bench.out.odometry.written);
}

TEST_CASE("a curve is drawn from end to end, each pose along it") {
  Bench<Standard> bench;
  Path path;
  set_curve(path, {{Vec3<Ned>{0, 0, -70}, {50, 0, -70}, {100, 50, -80}, {100, 100, -80}}}, 0.3);
  bench.set(bench.in.path, path);
  bench.step(0.01);
  const auto& poses = bench.out.piece.value.poses;
  REQUIRE(poses.count == 73);
  CHECK(poses[0].pose.position.z == doctest::Approx(70));
  CHECK(poses[0].pose.orientation.z == doctest::Approx(std::sqrt(0.5)));  // north
  CHECK(poses[36].pose.position.y == doctest::Approx((3 * 50 + 3 * 100 + 100) / 8.0));
  CHECK(poses[36].pose.position.x == doctest::Approx((3 * 50 + 100) / 8.0));
  CHECK(poses[72].pose.position.x == doctest::Approx(100));
  CHECK(poses[72].pose.position.z == doctest::Approx(80));
  CHECK(poses[72].pose.orientation.w == doctest::Approx(1));  // east
}

}  // namespace standard_test
