// SPDX-License-Identifier: BSD-3-Clause
// The slot by hand, the command into it sign by sign and limit by limit, the evasion, and a formation that
// closes.
#define FULMAR_COUNT_ALLOCATIONS
#include "follower.hpp"

#include <doctest/doctest.h>

#include "fulmar/testing.hpp"
#include "scene.hpp"

namespace follower_test {

using namespace fulmar;
using namespace fulmar::formation;
using namespace fulmar::formation::testing;

namespace {

constexpr double pi = std::numbers::pi;

/// A leader flies east at 17 m/s, 70 m up. The slot is 20 m behind, 30 m to the right (south), and 5 m below.
struct Scene {
  Bench<Follower> bench;
  VehicleState leader;
  Scene() {
    leader = flying({100, 200, -70}, pi / 2);
    bench.params.offset.value = {-20, 30, 5};
    bench.params.airframe.value.limits = {
        .airspeed_min_mps = 12, .airspeed_cruise_mps = 17, .airspeed_max_mps = 27};
  }
  static Vec3<Ned> slot() { return {70, 180, -65}; }
  GuidanceCommand command(const VehicleState& own, Status expected = Status::ok) {
    bench.set(bench.in.state, own);
    bench.set(bench.in.leader, leader);
    REQUIRE(bench.step(0) == expected);
    REQUIRE(bench.out.command.written);
    return bench.out.command.value;
  }
};

VehicleState at_slot(double north = 0, double east = 0, double up = 0) {
  return flying({Scene::slot().north + north, Scene::slot().east + east, Scene::slot().down - up}, pi / 2);
}

}  // namespace

TEST_CASE("in the slot the command is the leader's course and speed, at the slot's height") {
  Scene s;
  const GuidanceCommand c = s.command(at_slot());
  CHECK(c.course_rad == doctest::Approx(pi / 2));
  CHECK(c.airspeed_mps == doctest::Approx(17));
  CHECK(c.height_m == doctest::Approx(65));
  CHECK(c.climb_rate_mps == 0);
  CHECK(c.roll_feedforward_rad == 0);
  CHECK(s.bench.out.slot.value.ahead_m == doctest::Approx(0).epsilon(1e-9));
  CHECK(s.bench.out.slot.value.reached);
}

TEST_CASE("a leader's state that is half a second old is half a second's way further on") {
  Scene s;
  s.leader.velocity_mps.down = -2;  // it climbs
  s.bench.set(s.bench.in.state, at_slot(0, 8.5, 1));
  s.bench.set(s.bench.in.leader, s.leader, 0.5);
  REQUIRE(s.bench.step(0) == Status::ok);
  CHECK(std::abs(s.bench.out.slot.value.ahead_m) < 1e-9);
  CHECK(std::abs(s.bench.out.slot.value.above_m) < 1e-9);
  CHECK(s.bench.out.command.value.height_m == doctest::Approx(66));
  CHECK(s.bench.out.command.value.climb_rate_mps == 2);
}

TEST_CASE("a leader that turns is taken to turn on: it is on its circle, as far on as time has passed") {
  VehicleState leader = flying({0, 0, -70}, pi / 2);
  leader.roll_rad =
      std::atan(17 * 17 / (100 * 9.80665));  // a circle of 100 m to the right, with its centre in the south
  const double angle = 0.8;                  // of the circle: 100 m * angle / 17 m/s of flight
  const Motion now(leader, 100 * angle / 17);
  CHECK(now.p.x() == doctest::Approx(-100 + 100 * std::cos(angle)));
  CHECK(now.p.y() == doctest::Approx(100 * std::sin(angle)));
  CHECK(now.chi == doctest::Approx(pi / 2 + angle));
  CHECK(now.v.x() == doctest::Approx(-17 * std::sin(angle)));
}

TEST_CASE(
    "right of the slot's line the course turns left, by the book's formula, and never by more than the "
    "approach angle") {
  Scene s;
  // South is right of a line to the east. 0.9 (2/pi) atan(0.03 * 40)
  CHECK(s.command(at_slot(-40)).course_rad == doctest::Approx(pi / 2 - 0.50195).epsilon(1e-4));
  CHECK(s.bench.out.slot.value.right_m == doctest::Approx(40));
  CHECK(s.command(at_slot(40)).course_rad == doctest::Approx(pi / 2 + 0.50195).epsilon(1e-4));
  for (const double far : {1e3, 1e5}) {
    const double turn = pi / 2 - s.command(at_slot(-far)).course_rad;
    CHECK(turn > 0.85);
    CHECK(turn < 0.9);
  }
  // Twice the speed, half the gain: 0.9 (2/pi) atan(0.6)
  VehicleState fast = at_slot(-40);
  fast.ground_speed_mps = 34;
  CHECK(s.command(fast).course_rad == doctest::Approx(pi / 2 - 0.30963).epsilon(1e-4));
}

TEST_CASE(
    "behind the slot the airspeed rises with the distance, ahead of it it falls, within the closing speed "
    "and the airframe's limits") {
  Scene s;
  CHECK(s.command(at_slot(0, -8)).airspeed_mps == doctest::Approx(19));  // 0.25 1/s * 8 m
  CHECK(s.command(at_slot(0, 8)).airspeed_mps == doctest::Approx(15));
  CHECK(s.command(at_slot(0, -1000)).airspeed_mps == doctest::Approx(22));
  CHECK(s.command(at_slot(0, 1000)).airspeed_mps == doctest::Approx(12));
  s.bench.params.closing_max.value = 20;
  s.bench.retune();
  CHECK(s.command(at_slot(0, -1000)).airspeed_mps == 27);
  CHECK(s.command(at_slot(0, 1000)).airspeed_mps == 12);
}

TEST_CASE("the speed over ground is what counts: what the air adds is taken off") {
  VehicleState own = at_slot();
  own.airspeed_mps = 13;  // 4 m/s from behind
  CHECK(Scene().command(own).airspeed_mps == doctest::Approx(13));
  own.airspeed_mps = std::hypot(13, 3);  // and 3 m/s from the south (right): the nose points south of east
  own.yaw_rad = pi / 2 + std::atan2(3, 13);
  CHECK(Scene().command(own).airspeed_mps == doctest::Approx(std::hypot(13, 3)));
  own = flying(Scene::slot(), pi / 2, 16);  // 1 m/s too slow over the ground
  own.airspeed_mps = 13;
  CHECK(Scene().command(own).airspeed_mps == doctest::Approx(14));
}

TEST_CASE("a gust counts by and by, with a second's lag") {
  Scene s;
  s.command(at_slot());
  VehicleState own = at_slot();
  own.airspeed_mps = 13;
  s.bench.set(s.bench.in.state, own);
  for (int k = 0; k < 100; ++k) {
    s.bench.set(s.bench.in.leader, s.leader);
    s.bench.step(0.01);
  }
  CHECK(s.bench.out.command.value.airspeed_mps == doctest::Approx(17 - 4 * (1 - std::exp(-1))).epsilon(0.01));
}

TEST_CASE("on its way across to the line it flies faster, so that it does not fall behind") {
  Scene s;
  const double turn = 0.9 * 2 / pi * std::atan(0.03 * 40);
  CHECK(s.command(at_slot(-40)).airspeed_mps == doctest::Approx(17 / std::cos(turn)));
}

TEST_CASE(
    "in the leader's turn the slot inside is slower, the one outside faster, and both turn as fast as the "
    "leader") {
  Scene s;
  s.leader.roll_rad = 0.3;                              // to the right
  const double chi_dot = 9.80665 / 17 * std::tan(0.3);  // coordinated turn: 0.178 rad/s
  const double v_east = 17 - chi_dot * 30,
               v_north = -chi_dot * -20;  // of a point fixed to the turning leader: omega x r, by hand
  const Slot inside(Motion(s.leader), {-20, 30, 5});
  CHECK(inside.v.y() == doctest::Approx(v_east));
  CHECK(inside.v.x() == doctest::Approx(v_north));
  CHECK(Slot(Motion(s.leader), {-20, -30, 5}).v.y() == doctest::Approx(17 + chi_dot * 30));
  const VehicleState own = flying(Scene::slot(), std::atan2(v_east, v_north), std::hypot(v_east, v_north));
  const GuidanceCommand c = s.command(own);
  CHECK(c.airspeed_mps == doctest::Approx(std::hypot(v_east, v_north)));
  CHECK(c.roll_feedforward_rad ==
        doctest::Approx(std::atan(std::hypot(v_east, v_north) * chi_dot / 9.80665)));
  CHECK(s.command(at_slot(-200)).roll_feedforward_rad == 0);  // far from the slot its turn does not count
}

TEST_CASE("a leader that stands is not turned about: its course is what it says") {
  VehicleState leader = flying({0, 0, 0}, 0, 0.5);
  leader.course_rad = pi / 2;
  const Slot slot(Motion(leader), {-20, 0, 0});
  CHECK(slot.p.y() == doctest::Approx(-20));
  CHECK(slot.chi == doctest::Approx(pi / 2));
}

TEST_CASE(
    "a leader that never spoke is waited for; one that falls silent, is lost or counts from elsewhere fails "
    "it") {
  Scene s;
  s.bench.set(s.bench.in.state, at_slot());
  CHECK(s.bench.step(0.01) == Status::degraded);
  CHECK_FALSE(s.bench.out.command.written);
  s.bench.set(s.bench.in.leader, s.leader);
  CHECK(s.bench.step(3.99) == Status::ok);
  CHECK(s.bench.step(0.02) == Status::failed);
  for (bool VehicleState::*flag :
       {&VehicleState::position_valid, &VehicleState::height_valid, &VehicleState::velocity_valid}) {
    VehicleState lost = s.leader;
    lost.*flag = false;
    s.bench.set(s.bench.in.leader, lost);
    CHECK(s.bench.step(0) == Status::failed);
  }
  VehicleState elsewhere = s.leader;
  elsewhere.origin_altitude_m += 3;
  s.bench.set(s.bench.in.leader, elsewhere);
  CHECK(s.bench.step(0) == Status::failed);
}

TEST_CASE("nobody hands over to it without a leader") {
  Scene s;
  Follower::Outputs before;
  s.bench.set(s.bench.in.state, at_slot());
  CHECK(s.bench.activate() == Status::ok);  // no previous component
  CHECK(s.bench.activate(before) == Status::failed);
  s.bench.set(s.bench.in.leader, s.leader);
  CHECK(s.bench.activate(before) == Status::ok);
}

TEST_CASE("without a position of its own it flies straight on, as last commanded") {
  Scene s;
  s.leader.roll_rad = 0.3;
  const GuidanceCommand before = s.command(at_slot());
  REQUIRE(before.roll_feedforward_rad > 0);
  VehicleState own = at_slot(50, 50);
  own.position_valid = false;
  const GuidanceCommand c = s.command(own, Status::degraded);
  CHECK(c.course_rad == before.course_rad);
  CHECK(c.height_m == before.height_m);
  CHECK(c.airspeed_mps == before.airspeed_mps);
  CHECK(c.roll_feedforward_rad == 0);
}

TEST_CASE("a slot nearer to the leader than the separation is refused, before and during the flight") {
  Scene s;
  s.bench.params.separation.value = 36;  // the slot is 36.4 m away
  CHECK(s.bench.configure() == Status::ok);
  s.bench.params.separation.value = 37;
  CHECK(s.bench.configure() == Status::failed);
  CHECK(s.bench.error().find("nearer than separation") != std::string::npos);
  s.bench.params.separation.value = 10;
  s.bench.params.offset.value = {0, 6, 6};
  CHECK(s.bench.retune() == Status::failed);
}

TEST_CASE(
    "of two that come too near the higher climbs away and the lower one stays low; who is behind slows "
    "down") {
  Scene s;
  VehicleState own = at_slot();
  s.bench.set(s.bench.in.neighbour, flying({70, 185, -62}, pi / 2));  // 5 m ahead, 3 m below
  GuidanceCommand c = s.command(own, Status::degraded);
  CHECK(s.bench.out.slot.value.evading);
  CHECK(c.height_m == doctest::Approx(72));  // 62 + 10
  CHECK(c.airspeed_mps == 12);
  s.bench.set(s.bench.in.neighbour, flying({70, 175, -68}, pi / 2));  // 5 m behind, 3 m above
  own = at_slot(0, 0, -2);  // below the slot: the command would climb
  c = s.command(own, Status::degraded);
  CHECK(c.height_m == doctest::Approx(63));
  CHECK(c.airspeed_mps == doctest::Approx(17));
  own = at_slot(0, 0, 2);  // above the slot: the descent is permitted
  s.bench.set(s.bench.in.neighbour, flying({70, 175, -70}, pi / 2));
  CHECK(s.command(own, Status::degraded).height_m == doctest::Approx(65));
}

TEST_CASE("what comes nearer is kept clear of before it is near; what flies along, or goes away, is not") {
  Scene s;
  const VehicleState own = at_slot();
  const auto evades = [&](const VehicleState& other) {
    s.bench.set(s.bench.in.neighbour, other);
    s.bench.set(s.bench.in.state, own);
    s.bench.set(s.bench.in.leader, s.leader);
    s.bench.step(0);
    return s.bench.out.slot.value.evading;
  };
  CHECK(evades(flying({70, 180 + 50, -65}, -pi / 2)));         // head on: 34 m/s for 2 s
  CHECK_FALSE(evades(flying({70, 180 + 90, -65}, -pi / 2)));   // not yet
  CHECK_FALSE(evades(flying({70 + 11, 180, -65}, pi / 2)));    // alongside
  CHECK(evades(flying({70 + 9, 180, -65}, pi / 2)));           // too near alongside
  CHECK_FALSE(evades(flying({70, 180 - 11, -65}, -pi / 2)));   // has passed
  CHECK(evades(flying({70 - 34, 180 + 5, -65}, pi / 4, 24)));  // crosses from the right: 5 m off in 2 s
  VehicleState lost = flying({70 + 5, 180, -65}, pi / 2);
  lost.position_valid = false;  // an invalid position does not count
  CHECK_FALSE(evades(lost));
}

TEST_CASE("a step allocates nothing, neither in the slot nor evading nor failing") {
  Scene s;
  s.bench.set(s.bench.in.neighbour, flying({70, 185, -62}, pi / 2));
  s.command(at_slot(), Status::degraded);
  CHECK(allocations([&] { s.bench.step(0.01); }) == 0);
  CHECK(allocations([&] { s.bench.step(10); }) == 0);
}

TEST_CASE(
    "a formation closes from a hundred metres and holds through turns, in wind, on samples at 20 Hz that are "
    "0.1 s late") {
  constexpr double dt = 0.01;
  Scene s;
  s.bench.params.offset.value = {-20, 20, 5};
  s.bench.params.timeout.value = 1;
  Point leader, own;
  leader.wind_north = own.wind_north = 2;
  leader.wind_east = own.wind_east = -3;
  own.north = -70;
  own.east = -70;
  own.height = 90;
  std::vector<VehicleState> past;
  double square = 0, worst = 0;
  int n = 0;
  for (int k = 0; k < 12000; ++k) {
    const double t = k * dt;
    GuidanceCommand lead;  // circles of 120 m to the right and to the left, a straight way between them
    const int part = static_cast<int>(t / 15) % 4;
    const double turn = part == 1 ? 1 : part == 3 ? -1 : 0;
    const VehicleState l = leader.state();
    lead.course_rad = wrap_pi(l.course_rad);
    lead.roll_feedforward_rad = turn * std::atan(l.ground_speed_mps * l.ground_speed_mps / (120 * 9.80665));
    lead.airspeed_mps = 17;
    lead.height_m = 70;
    past.push_back(l);
    s.bench.set(s.bench.in.state, own.state());
    if (k >= 10 && k % 5 == 0) s.bench.set(s.bench.in.leader, past[static_cast<std::size_t>(k - 10)], 0.1);
    const Status status = s.bench.step(dt);
    if (k >= 10) REQUIRE(status == Status::ok);
    leader.step(lead, dt);
    if (s.bench.out.command.written) own.step(s.bench.out.command.value, dt);
    if (t < 40) continue;
    // slot from the course of the leader
    const VehicleState now = leader.state(), me = own.state();
    const double c = std::cos(now.course_rad), si = std::sin(now.course_rad);
    const double dn = me.position_m.north - (now.position_m.north - 20 * c - 20 * si);
    const double de = me.position_m.east - (now.position_m.east - 20 * si + 20 * c);
    const double d = std::hypot(dn, de, me.height_m - 65);
    square += d * d;
    worst = std::max(worst, d);
    ++n;
  }
  MESSAGE("rms " << std::sqrt(square / n) << " m, worst " << worst << " m");
  CHECK(std::sqrt(square / n) < 2.6);  // twice the present value
  CHECK(worst < 6.5);
}

}  // namespace follower_test
