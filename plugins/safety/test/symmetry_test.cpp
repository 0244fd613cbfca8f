// SPDX-License-Identifier: BSD-3-Clause
// Each component of safety in mirrored, turned and moved worlds, and taken over a second time.
#include "fulmar/random.hpp"
#include "kit.hpp"
#include "plugins/safety/fence.hpp"
#include "plugins/safety/glide.hpp"
#include "plugins/safety/home.hpp"
#include "plugins/safety/monitor.hpp"
#include "sdk/test/flight/worlds.hpp"

namespace safety_symmetry_test {

using namespace fulmar;
using namespace fulmar::safety;
using namespace fulmar::test;
using doctest::Approx;

namespace {

/// On no circle and no line, climbing and sinking, in wind.
VehicleState wandering(double t, double north_m = 0) {
  const double course = 0.4 + 0.9 * std::sin(0.11 * t) + 0.05 * t;
  VehicleState s = kit::level(north_m + 150 * std::sin(0.07 * t), -90 + 6 * t - 0.03 * t * t, course,
                              16 + 2 * std::sin(0.3 * t));
  s.wind_mps = {3, -4 + std::sin(0.1 * t), 0};
  s.velocity_mps = s.velocity_mps + s.wind_mps;
  s.course_rad = std::atan2(s.velocity_mps.east, s.velocity_mps.north);
  s.ground_speed_mps = std::hypot(s.velocity_mps.north, s.velocity_mps.east);
  s.climb_rate_mps = 1.8 * std::cos(0.2 * t);
  s.velocity_mps.down = -s.climb_rate_mps;
  s.height_m += 9 * std::sin(0.2 * t);
  s.position_m.down = -s.height_m;
  s.roll_rad = 0.3 * std::sin(0.17 * t + 0.4);
  s.pitch_rad = 0.05 * std::sin(0.2 * t);
  s.rate_radps = {0.05 * std::cos(0.17 * t), 0.02, 0.1};
  s.position_std_m = {2, 2, 2};
  return s;
}

constexpr std::array<HomeMode, 5> modes{HomeMode::home, HomeMode::glide, HomeMode::level, HomeMode::wait,
                                        HomeMode::descend};

void place(Bench<Home>& b, const World& w, HomeMode mode) {
  kit::give_anaconda(b.params);
  for (const Vec3<Ned>& at : {Vec3<Ned>{30, -20, 0}, Vec3<Ned>{260, 140, 0}, Vec3<Ned>{-330, 45, 0}}) {
    const Vec3<Ned> there = w.place(at);
    Place p;
    p.north_m = there.north;
    p.east_m = there.east;
    p.up_m = 6;
    b.params.places.value.places.push_back(p);
    b.params.places.is_given = true;
  }
  b.params.mode.value = mode;
  REQUIRE(b.retune() == Status::ok);
}
VehicleState sinking(double t, HomeMode mode) {
  VehicleState s = wandering(t);
  if (mode == HomeMode::glide || mode == HomeMode::descend) {
    s.height_m = std::max(130 - 2.2 * t, 8.0);
    s.position_m.down = -s.height_m;
    s.climb_rate_mps = -2.2;
  }
  s.position_valid = mode != HomeMode::wait || t < 30;  // satellites are lost on the way
  return s;
}

}  // namespace

TEST_CASE("the ways home are the same in a mirrored, turned and moved world") {
  for (const HomeMode mode : modes)
    for (const World& w : worlds) {
      // Every circle of it goes to the right, in every world.
      if (w.mirrored && mode != HomeMode::level) continue;
      CAPTURE(static_cast<int>(mode));
      Bench<Home> here, there;
      place(here, {}, mode);
      place(there, w, mode);
      for (int i = 0; i < 3000; ++i) {
        const VehicleState s = sinking(0.02 * i, mode);
        here.set(here.in.state, s);
        there.set(there.in.state, w.of(s));
        if (i == 0) REQUIRE((here.activate() == Status::ok && there.activate() == Status::ok));
        here.step(0.02);
        there.step(0.02);
        if (i % 50 != 0) continue;
        CAPTURE(i);
        check_same(there.out.command, w.of(here.out.command));
        CHECK(there.out.progress.there == here.out.progress.there);
        CHECK(there.out.progress.final == here.out.progress.final);
        CHECK(there.out.progress.distance_m == Approx(here.out.progress.distance_m));
        CHECK(there.out.progress.reach_m == Approx(here.out.progress.reach_m));
        CHECK(there.out.progress.ground_m == here.out.progress.ground_m);
      }
    }
}

TEST_CASE("a way home that is begun a second time is as the first, whatever was flown before") {
  for (const HomeMode mode : modes)
    for (const HomeMode before : modes) {
      CAPTURE(static_cast<int>(mode));
      CAPTURE(static_cast<int>(before));
      Bench<Home> here, again;
      place(here, {}, mode);
      place(again, {}, before);
      again.set(again.in.state, sinking(20, before));
      REQUIRE(again.activate() == Status::ok);
      for (int i = 0; i < 2500; ++i) {
        again.set(again.in.state, sinking(0.02 * i, before));
        again.step(0.02);
      }
      again.params.mode.value = mode;
      REQUIRE(again.retune() == Status::ok);
      for (int i = 0; i < 1000; ++i) {
        const VehicleState s = sinking(0.02 * i, mode);
        here.set(here.in.state, s);
        again.set(again.in.state, s);
        if (i == 0) REQUIRE((here.activate() == Status::ok && again.activate() == Status::ok));
        here.step(0.02);
        again.step(0.02);
        if (i % 50 == 0) check_same(again.out.command, here.out.command);
        CHECK(again.out.progress.final == here.out.progress.final);
      }
    }
}

namespace {

struct Sinks {
  Bench<Glide> bench;
  World world;
  explicit Sinks(const World& w) : world(w) {
    kit::give_anaconda(bench.params.common);
    bench.params.ground.value = 12;
  }
  void feed(double t, double north_m = 0) {
    VehicleState s = wandering(t, north_m);
    s.height_m = std::max(90 - 2.6 * t, 12.0);
    s.position_m.down = -s.height_m;
    s.climb_rate_mps = -2.6;
    s.velocity_mps.down = 2.6;
    GuidanceCommand c;
    c.course_rad = wrap_pi(s.course_rad + 0.5 * std::sin(0.3 * t) - 0.2);
    c.airspeed_mps = 15;
    c.roll_feedforward_rad = 0.1;
    bench.set(bench.in.state, world.of(s));
    bench.set(bench.in.command, world.of(c));
  }
};

}  // namespace

TEST_CASE("a glide in another world banks to its side, and a second one is as the first") {
  for (const World& w : worlds) {
    Sinks here({}), there(w), again({});
    again.feed(0, 400);
    REQUIRE(again.bench.activate() == Status::ok);
    for (int i = 0; i < 3200; ++i) {
      again.feed(0.01 * i, 400);
      again.bench.step(0.01);
    }
    bool flared = false;
    for (int i = 0; i < 3200; ++i) {
      for (Sinks* each : {&here, &there, &again}) {
        each->feed(0.01 * i);
        if (i == 0) REQUIRE(each->bench.activate() == Status::ok);
        REQUIRE(each->bench.step(0.01) == Status::ok);
      }
      const auto &a = here.bench.out, &b = there.bench.out, &c = again.bench.out;
      flared = flared || a.flare_ratio.value > 0;
      CHECK(b.attitude.roll_rad == Approx(w.side() * a.attitude.roll_rad).epsilon(1e-7));
      CHECK(b.attitude.pitch_rad == Approx(a.attitude.pitch_rad).epsilon(1e-7));
      CHECK(a.attitude.throttle_frac == 0);
      CHECK(c.attitude.roll_rad == Approx(a.attitude.roll_rad).epsilon(1e-9));
      CHECK(c.attitude.pitch_rad == Approx(a.attitude.pitch_rad).epsilon(1e-9));
      CHECK(c.flare_ratio.value == a.flare_ratio.value);
    }
    CHECK(flared);
  }
}

TEST_CASE("the monitor reports the same of a flight in a mirrored, turned and moved world") {
  for (const World& w : worlds) {
    Bench<Monitor> here, there;
    for (auto* b : {&here, &there}) {
      kit::give_anaconda(b->params);
      for (const auto& [n, e] :
           {std::pair{170.0, -260.0}, {420.0, 380.0}, {-150.0, 190.0}, {-190.0, -230.0}}) {
        const Vec3<Ned> at = (b == &there ? w : World{}).place({n, e, 0});
        FencePoint corner;
        corner.north_m = at.north;
        corner.east_m = at.east;
        b->params.fence.value.corners.push_back(corner);
      }
      b->params.fence.value.floor_m = 20;
      b->params.fence.value.ceiling_m = 95;
      b->params.fence.is_given = true;
      const Vec3<Ned> home = (b == &there ? w : World{}).place({20, -40, 0});
      Place p;
      p.north_m = home.north;
      p.east_m = home.east;
      b->params.places.value.places.push_back(p);
      b->params.places.is_given = true;
      b->params.fencing.keep_fence.value = false;
      REQUIRE(b->configure() == Status::ok);
    }
    unsigned raised = 0, inside = 0;
    for (int i = 0; i < 4000; ++i) {
      const VehicleState s = wandering(0.02 * i);
      VehicleStatus status;
      status.armed = status.in_control = true;
      status.battery_volt = 24;
      for (auto* b : {&here, &there}) {
        b->set(b->in.state, b == &there ? w.of(s) : s, -0.02);
        b->set(b->in.status, status, -0.02);
        REQUIRE(b->step(0.02) == Status::ok);
      }
      const SafetyState &a = here.out.safety, &b = there.out.safety;
      raised += a.fence ? 1 : 0;
      inside += a.fence ? 0 : 1;
      if (i % 25 != 0) continue;
      CAPTURE(i);
      CHECK(b.answer == a.answer);
      CHECK(b.fence == a.fence);
      CHECK(b.fence_margin_m == Approx(a.fence_margin_m).epsilon(1e-6));
      CHECK(b.height_margin_m == Approx(a.height_margin_m).epsilon(1e-6));
      CHECK(b.wind_ratio == Approx(a.wind_ratio).epsilon(1e-6));
      const SafetyTurn flipped = a.turn == SafetyTurn::either ? SafetyTurn::either
                                 : a.turn == SafetyTurn::left ? SafetyTurn::right
                                                              : SafetyTurn::left;
      CHECK(b.turn == (w.mirrored ? flipped : a.turn));
    }
    CHECK(raised > 100);
    CHECK(inside > 100);
  }
}

TEST_CASE("the room of a turn is that of a fine integration of the turn in wind, anywhere, to either side") {
  Random rng(3);
  for (int i = 0; i < 200; ++i) {
    Fence f;
    for (const auto& [n, e] : {std::pair{370.0, -460.0}, {520.0, 480.0}, {-250.0, 390.0}, {-390.0, -330.0}}) {
      FencePoint corner;
      corner.north_m = n;
      corner.east_m = e;
      f.corners.push_back(corner);
    }
    Polygon fence;
    fence.set(f, {});
    const double psi = rng.uniform(-3, 3), Va = rng.uniform(13, 22), side = i % 2 == 0 ? 1 : -1;
    TurnBack t{rng.uniform(-150, 250), rng.uniform(-200, 200), 0, 0, rng.uniform(-5, 5), rng.uniform(-5, 5),
               rng.uniform(0.4, 0.8),  rng.uniform(0.5, 2)};
    t.v_north_mps = Va * std::cos(psi) + t.w_north_mps;
    t.v_east_mps = Va * std::sin(psi) + t.w_east_mps;
    const double bearing = psi + side * rng.uniform(0.6, 4);
    const Spot home{3000 * std::cos(bearing), 3000 * std::sin(bearing), 0};  // ahead on that side, far away
    // The same by steps of 1 ms, and one coarse step of 0.15 rad longer: room lies between.
    double n = t.north_m + t.v_north_mps * t.reaction_s, e = t.east_m + t.v_east_mps * t.reaction_s;
    double room = std::min(fence.room_m(t.north_m, t.east_m), fence.room_m(n, e)), heading = psi;
    double longer = room, points_at = 10;
    const double rate = 9.80665 * std::tan(t.roll_rad) / Va;
    for (double turned = 0; turned < std::min(6.3, points_at + 0.15); turned += 1e-3 * rate) {
      heading += side * 1e-3 * rate;
      const double vn = Va * std::cos(heading) + t.w_north_mps, ve = Va * std::sin(heading) + t.w_east_mps;
      n += 1e-3 * vn;
      e += 1e-3 * ve;
      longer = std::min(longer, fence.room_m(n, e));
      if (points_at > 9) room = longer;
      const double left =
          side * angle_difference(std::atan2(home.east_m - e, home.north_m - n), std::atan2(ve, vn));
      if (points_at > 9 && left <= 0.1 && left > -1.5) points_at = turned;
    }
    const double found = room_of_turn(fence, t, home, side);
    CHECK(found < room + 0.5);
    CHECK(found > longer - 0.5);
  }
}

TEST_CASE("room to floor and ceiling is what a flown pull-out leaves, climbing and sinking") {
  Random rng(4);
  for (int i = 0; i < 100; ++i) {
    const double height = rng.uniform(40, 90), climb = rng.uniform(-6, 6), pull = rng.uniform(1, 5),
                 reaction = rng.uniform(0.2, 2);
    double h = height, v = climb, low = height, high = height;
    for (double t = 0; t < 20; t += 1e-3) {
      if (t > reaction) v = climb > 0 ? std::max(v - 1e-3 * pull, 0.0) : std::min(v + 1e-3 * pull, 0.0);
      h += 1e-3 * v;
      low = std::min(low, h);
      high = std::max(high, h);
    }
    const double room = std::min(120 - high, low - 20);
    CHECK(std::abs(room_of_height(height, climb, 20, 120, pull, reaction) - room) < 0.05);
  }
}

}  // namespace safety_symmetry_test
