// SPDX-License-Identifier: BSD-3-Clause
// The planner: contents of a file, edits and rejections, geodetic waypoints.
#define FULMAR_COUNT_ALLOCATIONS
#include "plugins/path/planner.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "fulmar/testing.hpp"

namespace planner_test {

using namespace fulmar;
using namespace fulmar::path;

namespace {

PlanFileWaypoint local(double north, double east, double up) {
  PlanFileWaypoint w;
  w.north_m = north;
  w.east_m = east;
  w.up_m = up;
  return w;
}

PlanFileWaypoint geodetic(double lat, double lon, double alt) {
  PlanFileWaypoint w;
  w.lat_deg = lat;
  w.lon_deg = lon;
  w.alt_msl_m = alt;
  return w;
}

PlanEdit edit(PlanEditKind kind, std::uint32_t index, double north = 0, double east = 0, double up = 50) {
  PlanEdit e;
  e.kind = kind;
  e.index = index;
  e.waypoint.position_m = {north, east, -up};
  return e;
}

void three_waypoints(Bench<Planner>& bench) {
  auto& list = bench.params.plan.value.waypoints;
  for (const double north : {0.0, 300.0, 600.0}) list.push_back(local(north, 100, 70));
}

std::string ask(Bench<Planner>& bench, const PlanEdit& e) {
  bench.push(bench.in.edit, e);
  bench.step(0.01);
  return bench.answer(bench.in.edit);
}

}  // namespace

TEST_CASE("the plan of the file is published once, then only when it changes") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.params.plan.value.airspeed_mps = 17;
  CHECK(bench.step(0.01) == Status::ok);
  REQUIRE(bench.out.plan.written);
  const Plan first = bench.out.plan.value;
  CHECK(first.waypoints.count == 3);
  CHECK(first.waypoints[2].position_m == Vec3<Ned>{600, 100, -70});
  CHECK(first.airspeed_mps == 17);
  for (int i = 0; i < 10; ++i) {
    bench.step(0.01);
    CHECK_FALSE(bench.out.plan.written);
  }
  CHECK(ask(bench, edit(PlanEditKind::append, 0, 900, 100)) == "accepted");
  REQUIRE(bench.out.plan.written);
  CHECK(bench.out.plan.value.waypoints.count == 4);
  CHECK(bench.out.plan.value.revision > first.revision);
  CHECK(bench.out.plan.value.jumps == first.jumps);
}

TEST_CASE("airspeed and bank beyond the airframe are reported once, within it never") {
  const auto reports = [](double airspeed, double radius, bool known = true) {
    Bench<Planner> bench;
    three_waypoints(bench);
    FlightLimits& limits = bench.params.airframe.value.limits;
    limits.airspeed_min_mps = 12;
    limits.airspeed_max_mps = 27;
    limits.roll_max_rad = 0.7853981634;
    bench.params.airframe.is_given = known;
    bench.params.plan.value.airspeed_mps = airspeed;
    bench.params.plan.value.turn_radius_m = radius;
    std::uint32_t n = 0;
    for (int i = 0; i < 5; ++i) {
      bench.step(0.01);
      n += bench.out.notices.count;
    }
    return n;
  };
  CHECK(reports(17, 50) == 0);
  CHECK(reports(9, 50) == 1);
  CHECK(reports(35, 150) == 1);
  CHECK(reports(17, 30) == 0);  // 45 deg at 17 m/s: 29.47 m
  CHECK(reports(17, 29) == 1);
  CHECK(reports(35, 20) == 2);
  CHECK(reports(35, 20, false) == 0);
}

TEST_CASE("an empty plan is published too, so that something can be flown around") {
  Bench<Planner> bench;
  bench.step(0.01);
  REQUIRE(bench.out.plan.written);
  CHECK(bench.out.plan.value.waypoints.empty());
}

TEST_CASE("edits insert, replace, remove, clear and set the current waypoint") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.step(0.01);
  const std::uint32_t jumps = bench.out.plan.value.jumps;
  const auto norths = [&] {
    std::vector<double> result;
    for (const Waypoint& w : bench.out.plan.value.waypoints) result.push_back(w.position_m.north);
    return result;
  };
  CHECK(ask(bench, edit(PlanEditKind::insert, 1, 150, 100)) == "accepted");
  CHECK(norths() == std::vector<double>{0, 150, 300, 600});
  CHECK(ask(bench, edit(PlanEditKind::insert, 4, 700, 100)) == "accepted");
  CHECK(norths() == std::vector<double>{0, 150, 300, 600, 700});
  CHECK(ask(bench, edit(PlanEditKind::replace, 0, -50, 100)) == "accepted");
  CHECK(norths() == std::vector<double>{-50, 150, 300, 600, 700});
  CHECK(ask(bench, edit(PlanEditKind::remove, 2)) == "accepted");
  CHECK(norths() == std::vector<double>{-50, 150, 600, 700});
  CHECK(bench.out.plan.value.jumps == jumps);
  CHECK(ask(bench, edit(PlanEditKind::set_current, 3)) == "accepted");
  CHECK(bench.out.plan.value.jumps == jumps + 1);
  CHECK(bench.out.plan.value.jump_item == 3);
  CHECK(ask(bench, edit(PlanEditKind::clear, 0)) == "accepted");
  CHECK(norths().empty());
  CHECK(bench.out.plan.value.jumps == jumps + 2);
  CHECK(bench.out.plan.value.jump_item == 0);
}

TEST_CASE("a jump keeps its waypoint when others are removed or inserted before it in the same step") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.step(0.01);
  bench.push(bench.in.edits, edit(PlanEditKind::set_current, 2));
  bench.push(bench.in.edits, edit(PlanEditKind::remove, 0));
  bench.step(0.01);
  const Plan& plan = bench.out.plan.value;
  CHECK(plan.waypoints[plan.jump_item].position_m.north == 600);
  bench.push(bench.in.edits, edit(PlanEditKind::insert, 0, -300, 0));
  bench.step(0.01);
  CHECK(bench.out.plan.value.waypoints[bench.out.plan.value.jump_item].position_m.north == 600);
}

TEST_CASE("a bad edit is refused with its reason and changes nothing") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.step(0.01);
  const auto refused = [&](PlanEdit e, const std::string& reason) {
    CAPTURE(reason);
    CHECK(ask(bench, e).find(reason) != std::string::npos);
    CHECK_FALSE(bench.out.plan.written);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused(edit(PlanEditKind::remove, 3), "path.waypoint_index_unknown(3, 2)");
  refused(edit(PlanEditKind::replace, 7, 0, 0), "path.waypoint_index_unknown(7, 2)");
  refused(edit(PlanEditKind::set_current, 3), "path.waypoint_index_unknown(3, 2)");
  refused(edit(PlanEditKind::insert, 4, 0, 0), "path.index_beyond_end(4, 3)");
  refused(edit(PlanEditKind::append, 0, nan, 0), "path.coordinate_not_finite");
  refused(edit(PlanEditKind::append, 0, 0, 0, nan), "path.coordinate_not_finite");
  refused(edit(PlanEditKind::append, 0, 2e5, 0), "path.origin_too_far");
  refused(edit(PlanEditKind::append, 0, 600.5, 100), "path.waypoint_before_close");
  refused(edit(PlanEditKind::insert, 1, 300, 100.2), "path.waypoint_after_close");
  refused(edit(PlanEditKind::replace, 1, 600, 100), "path.waypoint_after_close");
  PlanEdit course = edit(PlanEditKind::append, 0, 900, 0);
  course.waypoint.course_rad = nan;
  refused(course, "path.course_not_finite");
  PlanEdit speed = edit(PlanEditKind::append, 0, 900, 0);
  speed.waypoint.airspeed_mps = -1;
  refused(speed, "path.airspeed_not_valid(-1)");
  speed.waypoint.airspeed_mps = 1000;
  refused(speed, "path.airspeed_not_valid(1000)");
  PlanEdit kind = edit(PlanEditKind::append, 0, 900, 0);
  kind.kind = static_cast<PlanEditKind>(77);
  refused(kind, "path.edit_kind_unknown");
  PlanEdit pole = edit(PlanEditKind::append, 0);
  pole.waypoint.frame = WaypointFrame::geodetic;
  pole.waypoint.latitude_deg = 91;
  refused(pole, "path.latitude_out_of_range(91)");
  pole.waypoint.latitude_deg = 40;
  pole.waypoint.longitude_deg = -361;
  refused(pole, "path.longitude_out_of_range(-361)");
  PlanEdit frame = edit(PlanEditKind::append, 0, 900, 0);
  frame.waypoint.frame = static_cast<WaypointFrame>(77);
  refused(frame, "path.waypoint_frame_unknown");
  // a place near its former one is valid
  CHECK(ask(bench, edit(PlanEditKind::replace, 1, 300, 101)) == "accepted");
}

TEST_CASE("a plan holds 1024 waypoints and refuses one more") {
  Bench<Planner> bench;
  for (int i = 0; i < 1023; ++i) bench.params.plan.value.waypoints.push_back(local(50.0 * i, 0, 100));
  bench.step(0.01);
  CHECK(ask(bench, edit(PlanEditKind::append, 0, -400, 0)) == "accepted");
  CHECK(bench.out.plan.value.waypoints.count == 1024);
  CHECK(ask(bench, edit(PlanEditKind::append, 0, -800, 0)).find("path.plan_full") != std::string::npos);
  CHECK(ask(bench, edit(PlanEditKind::insert, 0, -800, 0)).find("path.plan_full") != std::string::npos);
  CHECK(ask(bench, edit(PlanEditKind::remove, 0)) == "accepted");
  CHECK(bench.out.plan.value.waypoints.count == 1023);
}

TEST_CASE("geodetic waypoints wait for the origin") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.params.plan.value.waypoints.push_back(
      geodetic(40.2499741, -111.6474138, 1457));  // 0.0036017 deg north of the origin: 400 m
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK_FALSE(bench.out.plan.written);
  VehicleState state;
  bench.set(bench.in.state, state);
  bench.step(0.01);
  CHECK_FALSE(bench.out.plan.written);
  state.origin_latitude_deg = 40.2463724;
  state.origin_longitude_deg = -111.6474138;
  state.origin_altitude_m = 1387;
  state.origin_valid = true;
  bench.set(bench.in.state, state);
  CHECK(bench.step(0.01) == Status::ok);
  REQUIRE(bench.out.plan.written);
  // WGS-84 meridian radius at 40.248 deg: a (1 - e^2) / (1 - e^2 sin^2 lat)^1.5 = 6362209 m, and 1.4 km up
  const Vec3<Ned>& p = bench.out.plan.value.waypoints[3].position_m;
  const double sin_lat = std::sin(40.248 * std::numbers::pi / 180), e2 = 0.00669437999014;
  const double M = 6378137 * (1 - e2) / std::pow(1 - e2 * sin_lat * sin_lat, 1.5);
  CHECK(p.north == doctest::Approx((M + 1457) * 0.0036017 * std::numbers::pi / 180).epsilon(1e-5));
  CHECK(std::abs(p.east) < 0.01);
  CHECK(p.down == doctest::Approx(-70).epsilon(1e-3));
}

TEST_CASE("the mission's origin serves at once") {
  Bench<Planner> bench;
  bench.params.origin.value = {40.2463724, -111.6474138, 1387, true};
  bench.params.plan.value.end = PlanEnd::orbit;
  bench.params.plan.value.waypoints.push_back(geodetic(40.2463724, -111.6474138, 1457));
  CHECK(bench.step(0.01) == Status::ok);
  REQUIRE(bench.out.plan.written);
  CHECK(std::abs(bench.out.plan.value.waypoints[0].position_m.north) < 1e-6);
  CHECK(bench.out.plan.value.waypoints[0].position_m.down == doctest::Approx(-70));
}

TEST_CASE("a file that is wrong is refused with a sentence that names the waypoint") {
  const auto fault = [](auto&& change) {
    Bench<Planner> bench;
    three_waypoints(bench);
    change(bench.params.plan.value);
    CHECK(bench.configure() == Status::failed);
    return bench.error();
  };
  CHECK(fault([](PlanFile& f) { f.waypoints[1].lat_deg = 40; }) ==
        "plan.waypoints[1]: path.waypoint_placed_twice");
  CHECK(fault([](PlanFile& f) { f.waypoints[2].up_m = not_given; }) ==
        "plan.waypoints[2]: path.waypoint_place_missing(north, east and up)");
  CHECK(fault([](PlanFile& f) { f.waypoints[2] = f.waypoints[1]; }) ==
        "plan.waypoints[2]: path.waypoint_before_close");
  CHECK(fault([](PlanFile& f) { f.waypoints.count = 1; }) == "plan.waypoints: path.circuit_of_one");
  CHECK(fault([](PlanFile& f) { f.waypoints[0] = {}; }) == "plan.waypoints[0]: path.waypoint_without_place");
  CHECK(fault([](PlanFile& f) { f.airspeed_mps = 0; }) == "plan.airspeed: path.airspeed_out_of_range(0)");
  for (const double radius_m : {0.0, 100'001.0})
    CHECK(fault([&](PlanFile& f) { f.turn_radius_m = radius_m; }) ==
          (radius_m > 1 ? "plan.turn_radius: path.turn_radius_out_of_range(100001)"
                        : "plan.turn_radius: path.turn_radius_out_of_range(0)"));
  CHECK(fault([](PlanFile& f) {
          f.waypoints.count = 0;
          f.given = true;
        }) == "plan: path.plan_empty");  // {turn_radius: 80 m} alone
  CHECK(fault([](PlanFile& f) { f.waypoints[0].airspeed_mps = -3; }) ==
        "plan.waypoints[0]: path.airspeed_not_valid(-3)");
}

TEST_CASE("the ends of the ranges of turn_radius and airspeed are valid in a file") {
  for (const auto& [radius_m, airspeed_mps] : {std::pair{1.0, 3.0}, {1e5, 300.0}}) {
    Bench<Planner> bench;
    three_waypoints(bench);
    bench.params.plan.value.turn_radius_m = radius_m;
    bench.params.plan.value.airspeed_mps = airspeed_mps;
    CHECK(bench.configure() == Status::ok);
  }
}

TEST_CASE("edits of the queue are applied in order, and what is refused is counted") {
  Bench<Planner> bench;
  bench.step(0.01);
  bench.push(bench.in.edits, edit(PlanEditKind::append, 0, 100, 0));
  bench.push(bench.in.edits, edit(PlanEditKind::remove, 9));
  bench.push(bench.in.edits, edit(PlanEditKind::append, 0, 500, 0));
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
  CHECK(bench.out.plan.value.waypoints.count == 2);
  CHECK(bench.out.refused_ratio.value == 1);
}

TEST_CASE("a waypoint that is put in just before the one to jump to is not jumped to") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.step(0.01);
  bench.push(bench.in.edits, edit(PlanEditKind::set_current, 1));
  bench.push(bench.in.edits, edit(PlanEditKind::insert, 1, 150, 100));
  bench.step(0.01);
  const Plan& plan = bench.out.plan.value;
  REQUIRE(plan.waypoints.count == 4);
  CHECK(plan.waypoints[plan.jump_item].position_m.north == 300);
}

TEST_CASE("a waypoint in the ground is refused, in a file, in an edit, and when the origin becomes known") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.params.plan.value.waypoints[1].up_m = -70;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "plan.waypoints[1]: path.waypoint_low(-70.0, 1)");
  bench.params.lowest.value = -100;  // next to a cliff
  CHECK(bench.configure() == Status::ok);

  Bench<Planner> air;
  three_waypoints(air);
  REQUIRE(air.configure() == Status::ok);
  air.push(air.in.edit, PlanEdit{});  // an append without a place
  air.step(0.01);
  CHECK(air.answer(air.in.edit, 0) == "path.waypoint_low(0.0, 1)");
  CHECK(air.out.plan.value.waypoints.count == 3);

  Bench<Planner> map;
  map.params.plan.value.waypoints.push_back(geodetic(40.25, -111.65, 1457));
  map.params.plan.value.waypoints.push_back(geodetic(40.26, -111.65, 1357));
  REQUIRE(map.configure() == Status::ok);  // above an unknown origin
  VehicleState state;
  state.origin_latitude_deg = 40.2463724;
  state.origin_longitude_deg = -111.6474138;
  state.origin_altitude_m = 1387;
  state.origin_valid = true;
  map.set(map.in.state, state);
  CHECK(map.step(0.01) == Status::degraded);
  CHECK_FALSE(map.out.plan.written);
  REQUIRE(map.out.notices.count == 1);
  CHECK(map.out.notices.items[0].text.view() == "path.waypoint_not_valid(2, path.waypoint_low(-30.2, 1))");
  map.step(0.01);
  CHECK(map.out.notices.count == 0);
}

TEST_CASE("too high is as far away as too deep") {
  Bench<Planner> bench;
  for (const double down : {-1.1e5, 1.1e5}) {
    PlanEdit far = edit(PlanEditKind::append, 0, 900, 100);
    far.waypoint.position_m.down = down;
    CHECK(ask(bench, far) == "path.origin_too_far");
  }
}

TEST_CASE("of a geodetic waypoint the local position means nothing, as long as nobody knows the origin") {
  Bench<Planner> bench;
  three_waypoints(bench);
  bench.step(0.01);
  PlanEdit e = edit(PlanEditKind::append, 0, 2e5, 0);  // 200 km away
  e.waypoint.frame = WaypointFrame::geodetic;
  e.waypoint.latitude_deg = 40.25;
  e.waypoint.longitude_deg = -111.65;
  e.waypoint.altitude_m = 1450;
  CHECK(ask(bench, e) == "accepted");
}

TEST_CASE("edits that were lost on the way are counted with those refused") {
  Bench<Planner> bench;
  bench.step(0.01);
  const_cast<fulmar_input*>(bench.in.edits.input)->lost = 3;
  bench.push(bench.in.edits, edit(PlanEditKind::remove, 9));
  bench.step(0.01);
  CHECK(bench.out.refused_ratio.value == 4);
}

}  // namespace planner_test
