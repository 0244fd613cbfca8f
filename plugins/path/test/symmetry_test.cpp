// SPDX-License-Identifier: BSD-3-Clause
// Each component of the path in mirrored, turned and moved worlds, and taken over a second time.
#include "flight.hpp"
#include "fulmar/random.hpp"
#include "landing_kit.hpp"
#include "plugins/path/loiter.hpp"
#include "sdk/test/flight/worlds.hpp"

namespace symmetry_test {

using namespace fulmar;
using namespace fulmar::test;

namespace {

/// Nothing level, nothing along an axis; a third of the waypoints with a course, some twice in one place.
Plan random_plan(Random& rng) {
  Plan plan = plan_of({}, rng.uniform() < 0.4 ? PlanEnd::orbit : PlanEnd::circuit);
  plan.turn_radius_m = rng.uniform(45, 80);
  const int n = 2 + static_cast<int>(rng.uniform(0, 5));
  for (int i = 0; i < n; ++i) {
    Waypoint w = point(rng.uniform(-500, 500), rng.uniform(-500, 500), rng.uniform(40, 100));
    w.has_course = rng.uniform() < 0.35;
    w.course_rad = rng.uniform(-3, 3);
    w.airspeed_mps = rng.uniform() < 0.3 ? rng.uniform(14, 20) : 0;
    w.id = static_cast<std::uint32_t>(i) + 1;
    plan.waypoints.push_back(w);
  }
  return plan;
}

/// A coordinated flight on no circle and no line, through wind that is not constant.
VehicleState wandering(double t, double height_m = 60) {
  Kinematic k;
  k.psi = 0.4 + 0.9 * std::sin(0.11 * t) + 0.05 * t;
  k.north = 40 + 150 * std::sin(0.07 * t);
  k.east = -90 + 11 * t - 0.03 * t * t;
  k.height = height_m + 9 * std::sin(0.2 * t);
  k.Va = 17 + 2 * std::sin(0.3 * t);
  k.climb = 1.8 * std::cos(0.2 * t);
  k.roll = 0.3 * std::sin(0.17 * t + 0.4);
  k.wind_north = 3;
  k.wind_east = -4 + std::sin(0.1 * t);
  return k.state();
}

}  // namespace

TEST_CASE("manager and field fly a mirrored, turned and moved plan as they fly the plan") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    Random rng(seed);
    const Plan plan = random_plan(rng);
    Flight here(plan);
    here.aircraft.north = rng.uniform(-300, 300);
    here.aircraft.east = rng.uniform(-300, 300);
    here.aircraft.psi = rng.uniform(-3, 3);
    here.aircraft.wind_north = rng.uniform(-6, 6);
    here.aircraft.wind_east = rng.uniform(-6, 6);
    const World& w = worlds[seed % worlds.size()];
    Bench<path::Manager> manager;
    Bench<path::VectorField> field;
    manager.set(manager.in.plan, w.of(plan));
    for (int i = 0; i < 6000; ++i) {
      const VehicleState there = w.of(here.aircraft.state());
      manager.set(manager.in.state, there);
      REQUIRE(manager.step(0.01) == Status::ok);
      field.set(field.in.state, there);
      field.set(field.in.path, manager.out.path.value);
      REQUIRE(field.step(0.01) == Status::ok);
      here.step();
      if (i % 50 != 0) continue;
      CAPTURE(i);
      check_same(manager.out.path.value, w.of(here.path()));
      check_same(field.out.command, w.of(here.field.out.command));
      CHECK(field.out.cross_track_m.value ==
            doctest::Approx((here.path().kind == PathKind::line ? w.side() : 1) *
                            here.field.out.cross_track_m.value)
                .epsilon(1e-6));
      CHECK(manager.out.progress.reached == here.progress().reached);
      CHECK(std::abs(manager.out.progress.distance_m - here.progress().distance_m) < 1e-6);
      CHECK(std::abs(manager.out.progress.miss_m - here.progress().miss_m) < 1e-6);
    }
  }
}

TEST_CASE("the field asks for the same on any line and orbit of a mirrored, turned and moved world") {
  Random rng(7);
  for (int i = 0; i < 400; ++i) {
    Path path;
    path.kind = rng.uniform() < 0.4 ? PathKind::line : PathKind::orbit;
    path.turn = rng.uniform() < 0.5 ? Turn::left : Turn::right;
    path.origin_m = {rng.uniform(-200, 200), rng.uniform(-200, 200), -rng.uniform(30, 90)};
    const double course = rng.uniform(-3, 3), climb = rng.uniform(-0.2, 0.2), norm = 1 / std::hypot(1, climb);
    path.direction_ratio = {std::cos(course) * norm, std::sin(course) * norm, -climb * norm};
    path.radius_m = rng.uniform(40, 120);
    path.climb_ratio = climb;
    path.start_rad = rng.uniform(-3, 3);
    path.remaining_m = rng.uniform(0, 40);
    path.next_curvature_ratio = rng.uniform(-0.02, 0.02);
    const VehicleState s = wandering(rng.uniform(0, 60));
    Bench<path::VectorField> here;
    here.set(here.in.state, s);
    here.set(here.in.path, path);
    REQUIRE(here.step(0.01) == Status::ok);
    for (const World& w : worlds) {
      Bench<path::VectorField> there;
      there.set(there.in.state, w.of(s));
      there.set(there.in.path, w.of(path));
      REQUIRE(there.step(0.01) == Status::ok);
      check_same(there.out.command, w.of(here.out.command));
      CHECK(there.out.height_error_m.value == doctest::Approx(here.out.height_error_m.value));
    }
  }
}

TEST_CASE("a loiter in another world is the same loiter, and a second one is as the first") {
  for (const path::LoiterAt at : {path::LoiterAt::here, path::LoiterAt::point})
    for (const Turn turn : {Turn::left, Turn::right})
      for (const World& w : worlds) {
        Bench<path::Loiter> here, there, again;
        const Vec3<Ned> point{30, 250, 0};
        for (auto* b : {&here, &there, &again}) {
          const bool other = b == &there;
          const Vec3<Ned> middle = other ? w.place(point) : point;
          b->params.airframe.value.limits.airspeed_cruise_mps = 17;
          b->params.at.value = at;
          b->params.turn.value = other ? w.turn(turn) : turn;
          b->params.north.value = middle.north;
          b->params.east.value = middle.east;
          b->params.height.value = 74;
        }
        again.set(again.in.state, wandering(300, 30));  // somewhere else, before
        REQUIRE(again.activate() == Status::ok);
        for (int i = 0; i < 500; ++i) {
          again.set(again.in.state, wandering(300 + 0.01 * i, 30));
          again.step(0.01);
        }
        for (int i = 0; i < 4000; ++i) {
          const VehicleState s = wandering(0.01 * i);
          here.set(here.in.state, s);
          again.set(again.in.state, s);
          there.set(there.in.state, w.of(s));
          if (i == 0)
            for (auto* b : {&here, &there, &again}) REQUIRE(b->activate() == Status::ok);
          for (auto* b : {&here, &there, &again}) REQUIRE(b->step(0.01) == Status::ok);
          if (i % 100 != 0) continue;
          check_same(there.out.command, w.of(here.out.command));
          check_same(again.out.command, here.out.command);
          for (auto* b : {&there, &again}) {
            CHECK(b->out.progress.laps_ratio == doctest::Approx(here.out.progress.laps_ratio));
            CHECK(b->out.progress.cross_m == doctest::Approx(here.out.progress.cross_m));
            CHECK(b->out.progress.there == here.out.progress.there);
          }
        }
      }
}

namespace {

struct Lands {
  landing_kit::Strip strip{600};
  World world;
  Lands(const World& w, Turn circle) : world(w) {
    Runway& r = strip.bench.params.runway.value;
    const Vec3<Ned> begin = w.place({80, -40, 0});
    r.north_m = begin.north;
    r.east_m = begin.east;
    r.heading_rad = w.course(0.6);
    r.up_m = 4;
    strip.bench.params.pattern.circle.value = w.turn(circle);
    strip.bench.params.decrab.value = 0.15;
    strip.bench.params.wind.wind.value = path::WindAnswer::warn;
    strip.bench.configure();
  }
  void step(const VehicleState& s, Contact contact) {
    auto& b = strip.bench;
    GroundState ground;
    ground.contact = contact;
    b.set(b.in.state, world.of(s));
    b.set(b.in.ground, ground);
    REQUIRE(b.step(0.01) == Status::ok);
  }
};

/// The flight that the first one asks for, down to the runway and along it.
void check_landing(const World& w, Turn circle, bool second) {
  Lands here({}, circle), there(w, circle);
  if (second) {
    Kinematic before;
    before.north = -300;
    before.height = 30;
    before.wind_east = 5;
    for (int i = 0; i < 3000; ++i) {
      there.step(before.state(), Contact::air);
      before.step(there.strip.bench.out.command, 0.01);
    }
    REQUIRE(there.strip.bench.activate() == Status::ok);
  }
  Kinematic k;
  k.north = -250;
  k.east = -420;
  k.height = 60;
  k.psi = 1.1;
  k.wind_north = -2;
  k.wind_east = 3;
  bool down = false;
  std::uint32_t stages = 0;
  for (int i = 0; i < 20000; ++i) {
    const VehicleState s = k.state();
    down = down || s.height_m < 4.05;
    here.step(s, down ? Contact::ground : Contact::air);
    there.step(s, down ? Contact::ground : Contact::air);
    const auto &a = here.strip.bench.out, &b = there.strip.bench.out;
    stages |= 1U << static_cast<unsigned>(a.progress.stage);
    if (down) {
      k.Va = std::max(k.Va - 0.015, 0.5);
      k.height = 4;
    } else
      k.step(a.command, 0.01);
    if (i % 100 != 0) continue;
    CAPTURE(i);
    check_same(b.command, w.of(a.command));
    CHECK(b.progress.stage == a.progress.stage);
    CHECK(b.progress.along_m == doctest::Approx(a.progress.along_m));
    CHECK(b.progress.cross_m == doctest::Approx(w.side() * a.progress.cross_m).epsilon(1e-6));
    CHECK(b.progress.head_wind_mps == doctest::Approx(a.progress.head_wind_mps));
    CHECK(b.progress.cross_wind_mps == doctest::Approx(w.side() * a.progress.cross_wind_mps));
    CHECK(b.progress.needed_m == doctest::Approx(a.progress.needed_m));
    CHECK(b.sideslip.sideslip_rad == doctest::Approx(w.side() * a.sideslip.sideslip_rad).epsilon(1e-6));
  }
  CHECK((stages & 0xFU) == 0xFU);  // join, approach, flare and roll-out
}

}  // namespace

TEST_CASE("a landing in a mirrored, turned and moved world is the same landing") {
  for (const World& w : worlds) check_landing(w, w.mirrored ? Turn::left : Turn::right, false);
}

TEST_CASE("a landing that is begun a second time is as the first, whatever was flown before") {
  check_landing({}, Turn::left, true);
}

}  // namespace symmetry_test
