// SPDX-License-Identifier: BSD-3-Clause
// The laws of the path beside their formulas, where nothing is level or symmetrical: commands while
// the position is lost, circles that are entered and left, plans at their limits, each on both sides.
#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <memory>
#include <string>

#include "kinematic.hpp"
#include "plugins/path/loiter.hpp"
#include "plugins/path/plan_limits.hpp"
#include "plugins/path/reckoning.hpp"
#include "plugins/path/vector_field.hpp"
#include "plugins/path/wide_fillet.hpp"
#include "sdk/test/flight/flight_model.hpp"

namespace values_test {

using namespace fulmar;
using namespace fulmar::path;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi, g = 9.80665;
using Words = std::array<char, 96>;

VehicleState at(double north, double east, double course, double speed = 16) {
  VehicleState s;
  s.position_m = {north, east, -83};
  s.height_m = 83;
  s.velocity_mps = {speed * std::cos(course), speed * std::sin(course), -0.5};
  s.course_rad = course;
  s.yaw_rad = course + 0.2;
  s.ground_speed_mps = speed;
  s.airspeed_mps = 18;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = true;
  return s;
}

Path climbing_line() {
  Path p;
  p.kind = PathKind::line;
  p.origin_m = {100, -200, -60};
  p.direction_ratio = {0.6, -0.7, -0.1};
  p.airspeed_mps = 19;
  p.remaining_m = 500;
  return p;
}

struct Field : Bench<VectorField> {
  const GuidanceCommand& fly(const VehicleState& s, const Path& p) {
    set(in.state, s);
    set(in.path, p);
    step(0.02);
    return out.command;
  }
};

}  // namespace

TEST_CASE("on a climbing line course, height and climb are those of Beard and McLain's formulas") {
  Field f;
  const FieldParams& k = f.params.field;
  const Path p = climbing_line();
  const double level = std::hypot(0.6, 0.7), course = std::atan2(-0.7, 0.6);
  for (const double chi : {course + 0.4, course - 1.1})
    for (const double speed : {16.0, 3.0, 25.0}) {
      const VehicleState s = at(150, -160, chi, speed);
      const GuidanceCommand& c = f.fly(s, p);
      const double n = 50, e = 40, along = (n * 0.6 - e * 0.7) / level, cross = (e * 0.6 + n * 0.7) / level;
      const double gain = k.k_path * k.reference_speed / std::max(speed, 0.3 * k.reference_speed);
      CHECK(c.course_rad == Approx(course - k.chi_infinity * 2 / pi * std::atan(gain * cross)));
      CHECK(c.height_m == Approx(60 + along * 0.1 / level));
      CHECK(c.climb_rate_mps == Approx(speed * std::cos(chi - course) * 0.1 / level));
      CHECK(c.airspeed_mps == 19);
      CHECK(f.out.cross_track_m.value == Approx(cross));
      CHECK(f.out.height_error_m.value == Approx(83 - c.height_m));
      CHECK(c.roll_feedforward_rad == 0);
    }
}

TEST_CASE("the bank of a circle is fed forward whole near it, by a share beside it, and not far away") {
  Field f;
  for (const Turn turn : {Turn::left, Turn::right})
    for (const auto& [off, share] : {std::pair{0.3, 1.0}, {-0.45, 1.0}, {0.7, 0.8}, {1.2, 0.3}, {1.6, 0.0}}) {
      const double side = turn == Turn::right ? 1 : -1, R = 120;
      Path p;
      p.kind = PathKind::orbit;
      p.turn = turn;
      p.radius_m = R;
      p.origin_m = {30, -50, -70};
      p.climb_ratio = 0.05;
      p.start_rad = 2.9;
      p.remaining_m = 1e9;
      p.airspeed_mps = 17;
      const double azimuth = -2.8, d = R * (1 + off), tangent = azimuth + side * pi / 2;
      const VehicleState s =
          at(30 + d * std::cos(azimuth), -50 + d * std::sin(azimuth), wrap_pi(tangent + 0.3));
      const GuidanceCommand& c = f.fly(s, p);
      const double bank = std::atan(16 * 16 * side * share / R / (g * std::cos(0.2)));
      CHECK(c.roll_feedforward_rad == Approx(bank));
      CHECK(c.height_m == Approx(70 + 0.05 * side * R * (2 * pi - 5.7)));
      CHECK(c.climb_rate_mps == Approx(16 * 0.05 * std::cos(0.3)));
      const double gain = f.params.field.k_orbit * f.params.field.reference_speed / 16;
      CHECK(std::abs(wrap_pi(c.course_rad - tangent - side * std::atan(gain * off))) < 1e-9);
      CHECK(f.out.cross_track_m.value == Approx(d - R));
    }
}

TEST_CASE("the next piece's bank is commanded within the time that a roll takes, on the way and near it") {
  Field f;
  const double lead_m = 16 * f.params.field.lead_time;
  const auto bank = [&](double remaining_m, double off_m, double course_off, double radius_m = 5) {
    Path p = climbing_line();
    p.radius_m = radius_m;
    p.direction_ratio = {0, 1, 0};
    p.origin_m = {0, 0, -80};
    p.remaining_m = remaining_m;
    p.next_curvature_ratio = -0.01;
    return f.fly(at(off_m, 300, pi / 2 + course_off), p).roll_feedforward_rad;
  };
  const double whole = std::atan(-16 * 16 * 0.01 / (g * std::cos(0.2)));
  CHECK(bank(lead_m - 0.1, 3, 0.2) == Approx(whole));
  CHECK(bank(lead_m + 0.1, 3, 0.2) == 0);
  CHECK(bank(1, 9.9, 0) == Approx(whole));
  CHECK(bank(1, 10.1, 0) == 0);
  CHECK(bank(1, 24, 0, 50) == Approx(whole));
  CHECK(bank(1, 26, 0, 50) == 0);
  CHECK(bank(1, 3, 1.5) == Approx(whole));
  CHECK(bank(1, 3, -1.6) == 0);
}

TEST_CASE("a bank is that of the curvature over the ground, beyond its limit the limit") {
  CHECK(bank_for(0.01, 15, 0.3, 1) == Approx(std::atan(2.25 / (g * std::cos(0.3)))));
  CHECK(bank_for(-0.02, 10, -1.3, 1) == Approx(std::atan(-2 / (g * 0.5))));
  CHECK(bank_for(0.1, 20, 0, 0.7) == 0.7);
  CHECK(bank_for(-0.1, 20, 0, 0.7) == -0.7);
}

TEST_CASE("without a position a circle to the right at the height and speed last asked for, twice alike") {
  Field f;
  const Path p = climbing_line();
  for (int again = 0; again < 2; ++again) {
    VehicleState s = at(150, -160, 0.4);
    f.fly(s, p);
    const GuidanceCommand last = f.out.command;
    CHECK(f.out.notices.count == (again ? 1 : 0));  // it is back
    s.position_valid = false;
    s.position_std_m = {3, 60, 0};
    s.course_rad = -1.2;
    const GuidanceCommand& c = f.fly(s, p);
    CHECK(f.out.notices.count == 1);
    CHECK(c.height_m == last.height_m);
    CHECK(c.airspeed_mps == 19);
    CHECK(c.climb_rate_mps == 0);
    CHECK(c.course_rad == -1.2);
    CHECK(c.roll_feedforward_rad == Approx(std::atan(18.0 * 18 / (g * f.params.lost_radius))));
    CHECK(f.out.cross_track_m.value == 0);
    CHECK(f.out.height_error_m.value == 0);
    s.attitude_valid = false;
    s.course_rad = 2;
    f.fly(s, p);
    CHECK(f.out.notices.count == 0);
    CHECK(f.out.command.course_rad == -1.2);
    CHECK(f.out.command.roll_feedforward_rad == 0);
  }
}

TEST_CASE("a position is reckoned on for its time and up to its deviation, north or east, each time alike") {
  const auto held = std::make_unique<Reckoning>();
  Reckoning& r = *held;
  VehicleState s = at(0, 0, 0);
  const std::int64_t second = 1'000'000'000;
  s.position_valid = false;
  CHECK_FALSE(r.located(s, 0, 50, 20));  // there was none
  for (std::int64_t begin = 10 * second; begin < 300 * second; begin += 100 * second) {
    s.position_valid = true;
    s.position_std_m = {99, 99, 0};
    CHECK(r.located(s, begin, 50, 20));
    s.position_valid = false;
    s.position_std_m = {49, 10, 99};
    CHECK(r.located(s, begin + second, 50, 20));
    CHECK(r.located(s, begin + 21 * second, 50, 20));
    CHECK_FALSE(r.located(s, begin + 21 * second + 1000, 50, 20));
    s.velocity_valid = false;
    CHECK_FALSE(r.located(s, begin + 2 * second, 50, 20));
    s.velocity_valid = true;
    s.attitude_valid = false;
    CHECK_FALSE(r.located(s, begin + 2 * second, 50, 20));
    s.attitude_valid = true;
    CHECK(r.located(s, begin + 2 * second, 50, 20));
    s.position_std_m = {10, 51, 0};
    CHECK_FALSE(r.located(s, begin + 3 * second, 50, 20));
    s.position_std_m = {10, 10, 0};  // it stays too far
    CHECK_FALSE(r.located(s, begin + 4 * second, 50, 20));
  }
}

TEST_CASE(
    "a circle begins beside the aircraft, counts its laps near it, and goes to its height by its rate") {
  for (const Turn turn : {Turn::left, Turn::right}) {
    Bench<Loiter> l;
    l.params.airframe.value = test::anaconda();
    l.params.airframe.is_given = true;
    l.params.turn.value = turn;
    l.params.height.value = 90;
    l.params.radius.value = 100;
    const double side = turn == Turn::right ? 1 : -1, chi = 0.7;
    VehicleState s = at(40, -25, chi);
    l.set(l.in.state, s);
    REQUIRE(l.activate() == Status::ok);
    const double cn = 40 - side * 100 * std::sin(chi), ce = -25 + side * 100 * std::cos(chi);
    double azimuth = std::atan2(-25 - ce, 40 - cn), height = 83;
    const auto look = [&](double radius, double turned) {
      azimuth += side * turned;
      s = at(cn + radius * std::cos(azimuth), ce + radius * std::sin(azimuth),
             wrap_pi(azimuth + side * pi / 2));
      l.set(l.in.state, s);
      REQUIRE(l.step(0.05) == Status::ok);
      height = std::min(height + 2 * 0.05, 90.0);
      CHECK(l.out.command.height_m == Approx(height));
    };
    for (int k = 0; k < 20; ++k) look(100, 0.1);
    CHECK(l.out.command.climb_rate_mps == 2);
    CHECK(l.out.command.airspeed_mps == test::anaconda().limits.airspeed_cruise_mps);
    CHECK(l.out.progress.laps_ratio == Approx(1.9 / (2 * pi)));  // the first step has no step before it
    CHECK(std::abs(l.out.progress.cross_m) < 1e-9);
    CHECK(l.out.progress.height_error_m == Approx(-7));
    CHECK_FALSE(l.out.progress.there);
    for (int k = 0; k < 20; ++k) look(131, 0.1);  // too far: no laps
    CHECK(l.out.progress.laps_ratio == Approx(1.9 / (2 * pi)));
    for (int k = 0; k < 60; ++k) look(128, 0.1);
    CHECK(l.out.progress.laps_ratio == Approx((1.9 + 5.9) / (2 * pi)));
    CHECK(l.out.command.climb_rate_mps == 0);
    const double bank = std::atan(16 * 16 * side / 100 / (g * std::cos(0.2)));
    CHECK(l.out.command.roll_feedforward_rad == Approx(bank));
    for (const auto& [off, there] : {std::pair{2.9, true}, {3.1, false}, {-2.9, true}, {-3.1, false}}) {
      s.height_m = 90 + off;
      l.set(l.in.state, s);
      l.step(0.05);
      CHECK(l.out.progress.there == there);
    }
    s.position_valid = false;
    l.set(l.in.state, s);
    CHECK(l.step(0.05) == Status::degraded);
    CHECK(l.out.command.course_rad == s.course_rad);
    CHECK(l.out.command.roll_feedforward_rad == Approx(std::atan(18.0 * 18 * side / 100 / g)));
    CHECK_FALSE(l.out.progress.there);
    l.set(l.in.state, at(300, 200, -2));  // a second time
    REQUIRE(l.activate() == Status::ok);
    l.set(l.in.state, at(300, 200, -2));
    l.step(0.05);
    CHECK(l.out.progress.laps_ratio == 0);
    CHECK(std::abs(l.out.progress.cross_m) < 1e-9);
    CHECK(std::abs(wrap_pi(l.out.command.course_rad + 2)) < 1e-9);
    CHECK(l.out.command.height_m == Approx(83.1));
  }
}

TEST_CASE("a loiter's own airspeed, point and the height at which it takes over are taken when asked for") {
  Bench<Loiter> l;
  l.params.airframe.value = test::anaconda();
  l.params.airframe.is_given = true;
  l.params.airspeed.value = 21;
  l.params.at.value = LoiterAt::point;
  l.params.north.value = -30;
  l.params.east.value = 70;
  l.params.radius.value = 60;
  const VehicleState s = at(50, 10, 0.3);
  l.set(l.in.state, s);
  REQUIRE(l.activate() == Status::ok);
  l.set(l.in.state, s);
  l.step(0.02);
  CHECK(l.out.command.airspeed_mps == 21);
  CHECK(l.out.command.height_m == 83);
  CHECK(l.out.progress.cross_m == Approx(std::hypot(80, 60) - 60));
}

TEST_CASE("a plan is in doubt beyond the airframe's airspeeds and bank, and at each limit it is not") {
  const FlightLimits limits = test::anaconda().limits;
  const auto fast = [&](double whole, double at_waypoint) {
    Plan plan;
    plan.airspeed_mps = whole;
    Waypoint w;
    w.airspeed_mps = at_waypoint;
    plan.waypoints.push_back(w);
    return std::string(airspeed_doubt(plan, limits).data());
  };
  for (const double at_limit : {0.0, limits.airspeed_min_mps, limits.airspeed_max_mps}) {
    CHECK(fast(at_limit, 0).empty());
    CHECK(fast(0, at_limit).empty());
  }
  for (const double beyond : {limits.airspeed_min_mps - 0.1, limits.airspeed_max_mps + 0.1}) {
    CHECK_FALSE(fast(beyond, 0).empty());
    CHECK_FALSE(fast(17, beyond).empty());
  }
  const std::string both = fast(99, 1);  // the first that is found
  CHECK(both.starts_with("path.airspeed_beyond_airframe(99, "));
  const double least = 20 * 20 / (g * std::tan(limits.roll_max_rad));
  Plan plan;
  plan.airspeed_mps = 20;
  for (const double radius : {1.01 * least, 0.99 * least}) {
    plan.turn_radius_m = radius;
    CHECK((radius_doubt(plan, limits)[0] != 0) == (radius < least));
  }
  plan.turn_radius_m = least / 2;  // twice the tangent of the bank
  const std::string words = radius_doubt(plan, limits).data();
  const auto degrees = [](double rad) { return std::to_string(std::lround(rad * 180 / pi)); };
  CHECK(words.starts_with("path.turn_radius_tight("));
  CHECK(words.find(", " + degrees(std::atan(2 * std::tan(limits.roll_max_rad))) + ", " +
                   degrees(limits.roll_max_rad) + ", ") != std::string::npos);
  CHECK(words.ends_with(", " + std::to_string(std::lround(least)) + ")"));
}

TEST_CASE("a waypoint outside the fence, above its ceiling or below its floor is refused by its number") {
  safety::Fence fence;
  for (const auto& [n, e] : {std::pair{300.0, -100.0}, {300.0, 200.0}, {-50.0, 200.0}, {-50.0, -100.0}}) {
    safety::FencePoint corner;
    corner.north_m = n;
    corner.east_m = e;
    fence.corners.push_back(corner);
  }
  fence.floor_m = 20;
  fence.ceiling_m = 100;
  PlanFence limits;
  limits.set(fence, {});
  const auto refused = [&](double north, double east, double up) {
    const auto fault = limits.fault_of({north, east, -up});
    return fault ? std::string(fault->view()) : std::string();
  };
  CHECK(refused(299, 199, 99).empty());
  CHECK(refused(-49, -99, 21).empty());
  CHECK(refused(330, 0, 50) == "path.waypoint_outside_fence(30)");
  CHECK(refused(0, -117, 50) == "path.waypoint_outside_fence(17)");
  CHECK(refused(0, 0, 101) == "path.waypoint_above_ceiling(101.0, 100)");
  CHECK(refused(0, 0, 19) == "path.waypoint_below_floor(19.0, 20)");
}

TEST_CASE(
    "the radius of a turn in wind is that of its fastest part by a fine search, in any wind an upper bound") {
  for (const auto& wind : {Vec3<Ned>{6, -5, 0}, Vec3<Ned>{-3, 8, 0}, Vec3<Ned>{0, 0, 0}})
    for (const double turn : {1.3, -2.2}) {
      double widest = 0;
      for (int i = 0; i <= 400; ++i) {  // the airspeed's way to a ground track, by the triangle
        const double chi = 0.8 + turn * i / 400,
                     along = wind.north * std::cos(chi) + wind.east * std::sin(chi),
                     across = wind.east * std::cos(chi) - wind.north * std::sin(chi);
        const double crab = std::sqrt(17 * 17 - across * across), Vg = crab + along;
        widest = std::max(widest, Vg * Vg / (g * std::tan(0.5) * crab / 17));
      }
      const double found = radius_in_wind(0.8, turn, 17, wind, 0.5);
      CHECK(found <= widest * 1.0001);
      CHECK(found > 0.98 * widest);
      CHECK(radius_in_any_wind(17, wind, 0.5) >= widest * 0.9999);
    }
  CHECK(radius_in_any_wind(17, {3, 4, 0}, 0.5) ==
        Approx(22 * 22 / (g * std::tan(0.5) * std::sqrt(1 - 25.0 / 289))));
  CHECK(radius_in_any_wind(10, {0, 9.5, 0}, 0.5) == Approx(19.5 * 19.5 / (g * std::tan(0.5) * 0.5)));
  CHECK(wider_fillet_m(50, 80) == Approx(60));
  CHECK(wider_fillet_m(50, 40) == 50);
}

}  // namespace values_test
