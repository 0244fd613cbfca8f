// SPDX-License-Identifier: BSD-3-Clause
// ROSplane's messages, out and in, against the conventions of each field.
#include <doctest/doctest.h>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/testing.hpp"
#include "plugins/ros_bridge/rosplane_in.hpp"

namespace rosplane_test {

using namespace fulmar;
using namespace fulmar::ros_bridge;

namespace {

constexpr double pi = std::numbers::pi;

Airframe anaconda() {
  Airframe a;
  a.aileron.limit_rad = 0.4;
  a.elevator.limit_rad = 0.5;
  a.rudder.limit_rad = 0.3;
  return a;
}

VehicleState flying() {
  VehicleState s;
  s.position_m = {1, 2, -70};
  s.height_m = 70;
  s.roll_rad = 0.1;
  s.pitch_rad = 0.05;
  s.yaw_rad = pi / 2;
  s.attitude = from_eigen(quaternion_from({0, 0, pi / 2}));  // nose to the east
  s.velocity_mps = {3, 17, 0.5};
  s.rate_radps = {0.1, 0.2, 0.3};
  s.course_rad = 1.4;
  s.airspeed_mps = 16;
  s.alpha_rad = 0.04;
  s.beta_rad = -0.01;
  s.wind_mps = {3, -4, 0};
  s.origin_latitude_deg = 40.25;
  s.origin_longitude_deg = -111.5;
  s.origin_altitude_m = 1387;
  s.attitude_valid = s.position_valid = s.height_valid = s.velocity_valid = true;
  return s;
}

}  // namespace

TEST_CASE("estimated_state: NED and FRD, speeds in body axes, the quaternion's scalar last") {
  Bench<Rosplane> bench;
  bench.set(bench.in.state, flying());
  bench.step(0.01);
  REQUIRE(bench.out.estimated_state.written);
  const RosplaneState& m = bench.out.estimated_state.value;
  CHECK(m.p_n == 1.0f);
  CHECK(m.p_e == 2.0f);
  CHECK(m.p_d == -70.0f);
  CHECK(m.v_x == doctest::Approx(17));  // forward is east
  CHECK(m.v_y == doctest::Approx(-3));  // north is left
  CHECK(m.v_z == doctest::Approx(0.5));
  CHECK(m.q == 0.2f);
  CHECK(m.phi == 0.1f);
  CHECK(m.psi == doctest::Approx(pi / 2));
  CHECK(m.chi == 1.4f);
  CHECK(m.beta == -0.01f);
  CHECK(m.w_e == -4.0f);
  CHECK(m.initial_alt == 1387);
  CHECK(m.quat.z == doctest::Approx(std::sqrt(0.5)));
  CHECK(m.quat.w == doctest::Approx(std::sqrt(0.5)));
}

TEST_CASE("a place that is not known is not published as zero") {
  Bench<Rosplane> bench;
  VehicleState s = flying();
  s.position_valid = false;
  bench.set(bench.in.state, s);
  bench.step(0.01);
  CHECK_FALSE(bench.out.estimated_state.written);
  CHECK(bench.out.attitude.written);
}

TEST_CASE(
    "command: throttle in u[0], surfaces in u[3] to u[5] by their throws, the elevator as anaconda has it") {
  Bench<Rosplane> bench;
  bench.params.airframe.value = anaconda();
  bench.set(bench.in.actuators, Actuators{0.6, 0.2, -0.25, -0.15});
  bench.step(0.01);
  const RosflightCommand& c = bench.out.command.value;
  CHECK(int{c.mode} == 0);
  CHECK(c.ignore == 0);
  CHECK(c.u[0] == 0.6f);
  CHECK(c.u[3] == doctest::Approx(0.5));
  CHECK(c.u[4] == doctest::Approx(0.5));  // trailing edge up: nose up
  CHECK(c.u[5] == doctest::Approx(-0.5));
  CHECK(c.u[1] == 0);
}

TEST_CASE("what goes out as a command comes back as the same deflections, either way round") {
  for (const bool up : {false, true}) {
    Bench<Rosplane> out;
    Bench<RosplaneController> in;
    out.params.airframe.value = in.params.airframe.value = anaconda();
    out.params.elevator_up.value = in.params.elevator_up.value = up;
    out.set(out.in.actuators, Actuators{0.3, 0.1, 0.2, -0.05});
    out.step(0.01);
    in.set(in.in.command, out.out.command.value);
    CHECK(in.step(0.01) == Status::ok);
    CHECK(in.out.actuators.value.throttle_frac == doctest::Approx(0.3));
    CHECK(in.out.actuators.value.aileron_rad == doctest::Approx(0.1));
    CHECK(in.out.actuators.value.elevator_rad == doctest::Approx(0.2));
    CHECK(in.out.actuators.value.rudder_rad == doctest::Approx(-0.05));
  }
}

TEST_CASE("current_path: a right orbit is clockwise, 1; a line has its point and its direction") {
  Bench<Rosplane> bench;
  Path path;
  path.kind = PathKind::orbit;
  path.origin_m = {10, 20, -50};
  path.radius_m = 60;
  path.airspeed_mps = 17;
  bench.set(bench.in.path, path);
  bench.step(0.01);
  CHECK(int{bench.out.current_path.value.path_type} == 0);
  CHECK(int{bench.out.current_path.value.lamda} == 1);
  CHECK(bench.out.current_path.value.c == std::array<float, 3>{10, 20, -50});
  CHECK(bench.out.current_path.value.rho == 60);
  path.turn = Turn::left;
  bench.set(bench.in.path, path);
  bench.step(0.01);
  CHECK(int{bench.out.current_path.value.lamda} == -1);
  path.kind = PathKind::line;
  path.direction_ratio = {0, 1, 0};
  bench.set(bench.in.path, path);
  bench.step(0.01);
  CHECK(int{bench.out.current_path.value.path_type} == 1);
  CHECK(bench.out.current_path.value.q == std::array<float, 3>{0, 1, 0});
}

TEST_CASE(
    "a plan goes out once per revision: the list is cleared, then each waypoint, however many there are") {
  Bench<Rosplane> bench;
  Plan plan;
  plan.revision = 1;
  plan.airspeed_mps = 15;
  for (int i = 0; i < 100; ++i) {
    Waypoint w;
    w.position_m = {10.0 * i, 5, -70};
    plan.waypoints.push_back(w);
  }
  bench.set(bench.in.plan, plan);
  std::vector<RosplaneWaypoint> reported;
  for (int step = 0; step < 5; ++step) {
    bench.step(0.01);
    for (std::uint32_t i = 0; i < bench.out.waypoint_path.count; ++i)
      reported.push_back(bench.out.waypoint_path.items[i]);
  }
  REQUIRE(reported.size() == 101);
  CHECK(reported[0].clear_wp_list);
  for (std::size_t i = 1; i < reported.size(); ++i) {
    CHECK_FALSE(reported[i].clear_wp_list);
    CHECK(reported[i].w == std::array<float, 3>{10.0f * static_cast<float>(i - 1), 5, -70});
    CHECK(reported[i].va_d == 15);
  }
}

TEST_CASE(
    "sensors and status are those of rosflight_io: body axes, the pressure altitude of the standard "
    "atmosphere, pulses") {
  Bench<Rosplane> bench;
  Imu imu;
  imu.specific_force_mps2 = {0.1, 0.2, -9.81};
  Baro baro;
  baro.pressure_pa = 84556;  // 1500 m in the tables of the standard atmosphere
  Rc rc;
  rc.roll_frac = 0.5;
  rc.pitch_frac = 0.2;
  rc.throttle_frac = 0.25;
  rc.yaw_frac = 1;
  VehicleStatus status;
  status.armed = status.override = true;
  Gnss gnss;
  gnss.fix = FixType::rtk_fixed;
  gnss.utc_ns = 1'700'000'000'123'000'000;
  bench.set(bench.in.imu, imu);
  bench.set(bench.in.baro, baro);
  bench.set(bench.in.rc, rc);
  bench.set(bench.in.status, status);
  bench.set(bench.in.gnss, gnss);
  bench.step(0.01);
  CHECK(bench.out.imu_data.value.linear_acceleration.z == -9.81);
  CHECK(bench.out.baro.value.altitude == doctest::Approx(1500).epsilon(1e-3));
  CHECK(bench.out.rc_raw.value.values[0] == 1750);
  CHECK(bench.out.rc_raw.value.values[1] == 1600);
  CHECK(bench.out.rc_raw.value.values[2] == 1250);
  CHECK(bench.out.rc_raw.value.values[3] == 1000);
  CHECK(bench.out.status.value.armed);
  CHECK(bench.out.status.value.rc_override == 1);
  CHECK(int{bench.out.gnss.value.fix_type} == 3);
  CHECK(bench.out.gnss.value.gnss_unix_seconds == 1'700'000'000);
  CHECK(bench.out.gnss.value.gnss_unix_nanos == 123'000'000);
}

TEST_CASE(
    "a follower's commands guide; a follower that falls silent has failed, one that has not spoken is waited "
    "for") {
  Bench<RosplaneFollower> bench;
  CHECK(bench.step(0.01) == Status::degraded);
  RosplaneControllerCommands c;
  c.va_c = 17;
  c.h_c = 80;
  c.chi_c = -1.5f;
  c.phi_ff = 0.2f;
  bench.set(bench.in.controller_command, c);
  CHECK(bench.step(0.01) == Status::ok);
  REQUIRE(bench.out.command.written);
  CHECK(bench.out.command.value.course_rad == -1.5);
  CHECK(bench.out.command.value.height_m == 80);
  CHECK(bench.out.command.value.airspeed_mps == 17);
  CHECK(bench.step(0.3) == Status::ok);
  CHECK_FALSE(bench.out.command.written);
  CHECK(bench.step(0.3) == Status::failed);
  c.chi_c = std::nanf("");
  bench.set(bench.in.controller_command, c);
  CHECK(bench.step(0.01) == Status::failed);
}

TEST_CASE("nobody hands over to a silent follower, but the beginning waits for it") {
  Bench<RosplaneFollower> bench;
  const RosplaneFollower::Outputs applied;
  CHECK(bench.activate() == Status::ok);
  CHECK(bench.activate(applied) == Status::failed);
  bench.set(bench.in.controller_command, RosplaneControllerCommands{});
  CHECK(bench.activate(applied) == Status::ok);
}

TEST_CASE("a controller's command of another mode, or that is no number, is a failure") {
  Bench<RosplaneController> bench;
  RosflightCommand c;
  c.u[3] = 2;  // more than the throw
  bench.set(bench.in.command, c);
  CHECK(bench.step(0.01) == Status::ok);
  CHECK(bench.out.actuators.value.aileron_rad == Airframe{}.aileron.limit_rad);
  c.mode = 2;
  bench.set(bench.in.command, c);
  CHECK(bench.step(0.01) == Status::failed);
  c.mode = 0;
  c.u[0] = std::nanf("");
  bench.set(bench.in.command, c);
  CHECK(bench.step(0.01) == Status::failed);
}

TEST_CASE("a manager's line is normalised, its orbit keeps its sense, and nonsense leaves the last piece") {
  Bench<RosplanePath> bench;
  RosplaneCurrentPath c;
  c.q = {3, 4, 0};
  c.r = {1, 2, -30};
  c.va_d = 18;
  bench.set(bench.in.current_path, c);
  bench.step(0.01);
  CHECK(bench.out.path.value.direction_ratio.east == doctest::Approx(0.8));
  CHECK(bench.out.path.value.origin_m.down == -30);
  c.path_type = 0;
  c.rho = 75;
  c.lamda = -1;
  c.c = {5, 6, -40};
  bench.set(bench.in.current_path, c);
  bench.step(0.01);
  CHECK(bench.out.path.value.kind == PathKind::orbit);
  CHECK(bench.out.path.value.turn == Turn::left);
  CHECK(bench.out.path.value.radius_m == 75);
  c.rho = 0;
  bench.set(bench.in.current_path, c);
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK_FALSE(bench.out.path.written);
}

TEST_CASE("a planner's waypoints become edits: clear, local, geodetic, with a course where it counts") {
  Bench<RosplaneWaypoints> bench;
  RosplaneWaypoint clear, local, geodetic, bad;
  clear.clear_wp_list = true;
  local.w = {100, 50, -70};
  local.va_d = 16;
  local.chi_d = 1;
  local.use_chi = true;
  geodetic.w = {40.5f, -111.5f, 1500};
  geodetic.lla = true;
  geodetic.chi_d = 1;
  bad.w[1] = std::nanf("");
  for (const RosplaneWaypoint& w : {clear, local, bad, geodetic}) bench.push(bench.in.waypoint_path, w);
  bench.step(0.01);
  REQUIRE(bench.out.edits.count == 3);
  const auto& edits = bench.out.edits.items;
  CHECK(edits[0].kind == PlanEditKind::clear);
  CHECK(edits[1].waypoint.position_m == Vec3<Ned>{100, 50, -70});
  CHECK(edits[1].waypoint.has_course);
  CHECK(edits[1].waypoint.course_rad == 1);
  CHECK(edits[2].waypoint.frame == WaypointFrame::geodetic);
  CHECK(edits[2].waypoint.latitude_deg == 40.5);
  CHECK_FALSE(edits[2].waypoint.has_course);
  CHECK(bench.out.refused_ratio.value == 1);
}

TEST_CASE("the service add_waypoint appends, and refuses what is no number") {
  Bench<RosplaneWaypoints> bench;
  RosplaneAddWaypoint good, bad;
  good.w = {1, 2, -60};
  good.va_d = 14;
  bad.va_d = std::nanf("");
  bench.push(bench.in.add_waypoint, good);
  bench.push(bench.in.add_waypoint, bad);
  bench.step(0.01);
  CHECK(bench.answer(bench.in.add_waypoint, 0) == "accepted");
  CHECK(bench.answer(bench.in.add_waypoint, 1) == "ros_bridge.waypoint_not_finite");
  REQUIRE(bench.out.edits.count == 1);
  CHECK(bench.out.edits.items[0].kind == PlanEditKind::append);
  CHECK(bench.out.edits.items[0].waypoint.position_m.down == -60);
}

TEST_CASE(
    "an estimator's state comes back as it went out, and its zeros before it is initialised are no state") {
  Bench<Rosplane> out;
  out.set(out.in.state, flying());
  out.step(0.01);
  Bench<RosplaneEstimator> in;
  in.set(in.in.estimated_state, out.out.estimated_state.value);
  CHECK(in.step(0.01) == Status::ok);
  REQUIRE(in.out.state.written);
  const VehicleState& s = in.out.state.value;
  CHECK(s.velocity_mps.north == doctest::Approx(3));
  CHECK(s.velocity_mps.east == doctest::Approx(17));
  CHECK(s.ground_speed_mps == doctest::Approx(std::hypot(3, 17)));
  CHECK(s.height_m == 70);
  CHECK(s.climb_rate_mps == doctest::Approx(-0.5));
  CHECK(s.origin_valid);
  RosplaneState zeros;
  zeros.initial_lat = 40;
  in.set(in.in.estimated_state, zeros);
  CHECK(in.step(0.01) == Status::degraded);
  CHECK_FALSE(in.out.state.written);
}

}  // namespace rosplane_test
