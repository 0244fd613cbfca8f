// SPDX-License-Identifier: BSD-3-Clause
// Lift-off, touch-down and the lock of the throttle, on motions whose true contact is written down here.
#include "plugins/safety/ground.hpp"

#include "fulmar/random.hpp"
#include "kit.hpp"

namespace ground_test {

using namespace fulmar;
using namespace fulmar::safety;

namespace {

constexpr double g = 9.80665, dt = 0.0025;

/// An aircraft of 12 m/s least airspeed on a straight line. Its vertical motion is integrated from the
/// acceleration that its accelerometer measures.
struct Craft : Bench<Ground> {
  VehicleState s;
  VehicleStatus status;
  Actuators actuators;
  Random noise{7};
  double noise_mps2 = 0.2, side_mps2 = 0;
  bool has_status = true, has_throttle = true, has_landing = false;
  LandingProgress landing;

  Craft() {
    kit::give_anaconda(params);
    params.airframe.value.limits.airspeed_min_mps = 12;
    s = kit::level();
    s.position_m = s.velocity_mps = {};
    s.height_m = s.climb_rate_mps = s.ground_speed_mps = s.airspeed_mps = 0;
    status.armed = true;
    actuators.throttle_frac = 0.5;
  }
  /// `up_mps2`: acceleration of the centre of gravity; `ahead_mps2`: along the nose, changes no speed.
  const GroundState& go(double seconds, double up_mps2 = 0, double ahead_mps2 = 0) {
    for (double t = 0; t < seconds - dt / 2; t += dt) {
      s.climb_rate_mps += up_mps2 * dt;
      s.height_m += s.climb_rate_mps * dt;
      s.specific_force_mps2 = {ahead_mps2 + noise_mps2 * noise.normal(), side_mps2,
                               -g - up_mps2 + noise_mps2 * noise.normal()};
      set(in.state, s, -dt);
      if (has_status) set(in.status, status, -dt);
      if (has_throttle) set(in.actuators, actuators, -dt);
      if (has_landing) set(in.landing, landing, -dt);
      REQUIRE(step(dt) == Status::ok);
    }
    return out.state;
  }
  void fast(double mps) { s.ground_speed_mps = s.airspeed_mps = mps; }
  void climb(double mps) { s.climb_rate_mps = mps; }
  /// Stands, rolls, and is at `height_m` in level flight.
  void take_off(double height_m = 30) {
    fast(0);
    climb(0);
    go(2);
    fast(13);
    go(1);
    climb(2.5);
    go(height_m / 2.5);
    climb(0);
    fast(14);
    go(2);
    REQUIRE(out.state.contact == Contact::air);
  }
  void sink_to(double height_m, double mps) {
    climb(-mps);
    go((s.height_m - height_m) / mps);
  }
  /// The wheels take the sink away within 60 ms.
  void touch() { go(0.06, -s.climb_rate_mps / 0.06); }
  /// A gust: half a sine of upward acceleration that changes the climb rate by so much.
  void gust(double by_mps, double for_s) {
    const double pi = std::numbers::pi, peak = by_mps * pi / (2 * for_s);
    for (double t = dt / 2; t < for_s; t += dt) go(dt, peak * std::sin(pi * t / for_s));
  }
  /// Gusts that go on and leave the mean of the climb rate as it is.
  void rough_air(double seconds, double up_mps2 = 1) {
    const double pi = std::numbers::pi;
    for (double t = dt / 2; t < seconds; t += dt) go(dt, up_mps2 * std::sin(2 * pi * 1.5 * t));
  }
  /// Seconds from now until the contact is `wanted`; 1e9: not within `within_s`.
  double until(Contact wanted, double within_s) {
    for (double t = 0; t < within_s; t += dt)
      if (go(dt).contact == wanted) return t + dt;
    return 1e9;
  }
};

}  // namespace

TEST_CASE("a lift-off is what rises faster than the ground may, not a roll and not a wind") {
  Craft c;
  CHECK(c.go(0.5).contact == Contact::unknown);
  CHECK(c.go(1).contact == Contact::ground);
  c.fast(13);
  CHECK(c.go(3).contact == Contact::ground);  // rolls at more than the least airspeed
  c.climb(0.4);                               // 0.03 of slope
  CHECK(c.go(5).contact == Contact::ground);
  c.climb(2);
  CHECK(c.until(Contact::air, 3) < 1);
  CHECK(c.out.state.lift_offs == 1);

  Craft stands;
  stands.s.airspeed_mps = 14;  // a gale over a parked aircraft
  CHECK(stands.go(20).contact != Contact::air);
  Craft disarmed;
  disarmed.status.armed = false;
  disarmed.go(2);
  disarmed.fast(14);
  disarmed.climb(2);
  CHECK(disarmed.go(5).contact == Contact::ground);  // carried in a car uphill
}

TEST_CASE("a host that begins in the air estimates so within a second, with and without airspeed") {
  for (const bool pitot : {true, false}) {
    Craft c;
    c.s.height_m = 70;
    c.fast(17);
    c.s.airspeed_valid = pitot;
    CHECK(c.until(Contact::air, 3) < 1);
  }
}

TEST_CASE("a touch-down is recognised within 0.3 s at sinks from 0.3 to 1.5 m/s, and its sink is reported") {
  for (const double sink : {0.3, 0.6, 1.0, 1.5})
    for (const double off : {0.0, 6.0, -6.0}) {
      CAPTURE(sink);
      CAPTURE(off);
      Craft c;
      c.take_off();
      c.sink_to(off, sink);  // the height is off by that much
      REQUIRE(c.out.state.contact == Contact::air);
      c.touch();
      CHECK(c.until(Contact::ground, 1) + 0.06 < 0.3);
      CHECK(c.out.state.touch_downs == 1);
      CHECK(c.out.state.touch_sink_mps == doctest::Approx(sink).epsilon(0.1));
    }
}

TEST_CASE("a touch-down without a push is one after a second or two of a flare, wing unloaded or not") {
  for (const bool unloaded : {true, false}) {
    CAPTURE(unloaded);
    Craft c;
    c.take_off();
    c.has_landing = true;
    c.landing.stage = LandingStage::flare;
    c.sink_to(3, 0.8);
    c.fast(14.5);  // above 1.1 of the least airspeed
    c.go(3, 0.8 / 3);
    REQUIRE(c.out.state.contact == Contact::air);
    c.s.height_m = c.landing.height_m = 0.3;
    if (unloaded) c.s.alpha_rad = -0.08;
    CHECK(c.until(Contact::ground, 5) < (unloaded ? 1.5 : 2.1));
  }
  Craft cruise;
  cruise.take_off();
  cruise.fast(14.5);
  CHECK(cruise.until(Contact::ground, 20) > 1e8);  // level flight, no sink asked for
}

TEST_CASE(
    "a kiss in a crosswind is recognised within 0.3 s by what pushes the wheels to a side, left or right") {
  for (const double side : {1.5, -1.5}) {
    Craft c;
    c.take_off();
    c.has_landing = true;
    c.landing.stage = LandingStage::flare;
    c.sink_to(0.1, 0.4);
    c.go(0.3, 0.4 / 0.3);
    REQUIRE(c.out.state.contact == Contact::air);
    c.side_mps2 = side;
    CHECK(c.until(Contact::ground, 1) < 0.3);
    CHECK(c.out.state.touch_sink_mps == doctest::Approx(0.4).epsilon(0.3));
  }
}

TEST_CASE("a belly that touches with a kiss is recognised by how it brakes, while the throttle is closed") {
  for (const bool closed : {true, false}) {
    CAPTURE(closed);
    Craft c;
    c.take_off();
    c.has_landing = true;
    c.landing.stage = LandingStage::flare;
    c.actuators.throttle_frac = closed ? 0 : 0.5;
    c.sink_to(0.2, 0.3);
    for (double t = 0; t < 0.1; t += dt) c.go(dt, 0, -2.5 * t / 0.1);
    c.go(0.1, 0, -2.5);
    CHECK((c.out.state.contact == Contact::ground) == closed);
  }
}

TEST_CASE("a lull in rough air is no touch-down, in the flare of a runway that is given 4 m wrong or not") {
  for (const double off : {0.5, 4.0}) {
    CAPTURE(off);
    Craft c;
    c.take_off();
    c.has_landing = true;
    c.landing.stage = LandingStage::flare;
    c.landing.height_m = off;
    c.climb(-0.8);
    c.rough_air(10);
    c.climb(0);
    c.rough_air(2.5);
    CHECK(c.out.state.contact == Contact::air);
  }
}

TEST_CASE("a throttle that closes within a fifth of a second brakes more slowly than a belly") {
  Craft c;
  c.take_off();
  c.has_landing = true;
  c.landing.stage = LandingStage::flare;
  c.sink_to(2, 0.8);
  for (double t = 0; t < 0.2; t += dt) c.go(dt, 0, -3 * t / 0.2);
  c.go(2, 0, -3);
  CHECK(c.out.state.contact == Contact::air);
}

TEST_CASE("evidence of one far from the runway has to be stronger by the square of the height") {
  const auto evidence = [](double off_m) {
    Craft one;
    one.take_off(40);
    one.has_landing = true;
    one.landing.stage = LandingStage::flare;
    one.landing.height_m = off_m;
    one.sink_to(30, 0.5);
    one.go(0.01, 6);
    return one.out.state.touch_evidence_ratio;
  };
  const double here = evidence(0), far = evidence(12);
  REQUIRE(here > 0);
  REQUIRE(here < 1);
  CHECK(here / far == doctest::Approx((std::log(1e5) + 4.5) / std::log(1e5)));
}

TEST_CASE("a belly without wheels is recognised by what it brakes") {
  Craft c;
  c.take_off();
  c.sink_to(0, 0.2);
  c.go(0.5, 0.4, -3.5);  // the sink ends within half a second
  CHECK(c.out.state.contact == Contact::ground);
}

TEST_CASE("a gust that pushes as much as a touch-down, more slowly, is none; nor is a push in a climb") {
  Craft gust;
  gust.take_off();
  gust.sink_to(2, 1);
  gust.gust(0.9, 0.3);  // up to 4.7 m/s2; from 1 m/s of sink to 0.1
  CHECK(gust.go(0.6).contact == Contact::air);
  gust.gust(-0.9, 0.3);
  CHECK(gust.go(0.5).contact == Contact::air);

  Craft climbs;
  climbs.take_off(5);
  climbs.climb(1);
  climbs.go(1);
  climbs.go(0.06, -1 / 0.06);
  climbs.go(0.06, 1 / 0.06);
  CHECK(climbs.go(0.5).contact == Contact::air);
}

TEST_CASE("the same push with power far from any known ground is none") {
  Craft c;
  c.take_off(60);
  c.sink_to(40, 1);
  c.touch();
  CHECK(c.go(0.5).contact == Contact::air);
  Craft runway;  // unless a runway is there
  runway.take_off(60);
  runway.landing.height_m = 1;
  runway.has_landing = true;
  runway.sink_to(40, 1);
  runway.touch();
  CHECK(runway.go(0.3).contact == Contact::ground);
  Craft left;  // a landing that has ended is not used
  left.take_off(60);
  left.landing.height_m = 1;
  left.has_landing = true;
  left.go(0.1);
  left.has_landing = false;
  left.go(0.6);
  left.sink_to(40, 1);
  left.touch();
  CHECK(left.go(0.5).contact == Contact::air);
}

TEST_CASE("a landing into a gale is one although the tube reads the wind, and locks the throttle") {
  Craft c;
  c.take_off();
  c.sink_to(0, 0.5);
  c.touch();
  c.s.airspeed_mps = 9;  // of 12; it stands
  c.s.ground_speed_mps = 0.2;
  CHECK(c.go(2).throttle_locked);
  Craft parked;  // and one that never flew stands on the ground
  parked.s.airspeed_mps = 9;
  CHECK(parked.go(2).contact == Contact::ground);
}

TEST_CASE("an aircraft without airspeed that flies slowly against the wind is not on the ground") {
  Craft c;
  c.take_off(60);
  c.s.airspeed_valid = false;
  c.s.ground_speed_mps = 4;
  CHECK(c.go(20).contact == Contact::air);
  CHECK_FALSE(c.out.state.throttle_locked);
}

TEST_CASE("a touch-down that was none ends after seconds as well, and a later landing locks") {
  Craft c;
  c.take_off(10);
  c.sink_to(3, 1);
  c.touch();
  REQUIRE(c.go(6).contact == Contact::ground);
  c.climb(-2.5);
  CHECK(c.until(Contact::air, 1) < 0.7);
  c.sink_to(0, 1);
  c.touch();
  c.fast(3);
  CHECK(c.go(2).throttle_locked);
}

TEST_CASE("a touch-down that was none ends when the aircraft falls, and is not counted") {
  Craft c;
  c.take_off(10);
  c.sink_to(3, 1);
  c.touch();
  REQUIRE(c.go(0.2).contact == Contact::ground);
  REQUIRE(c.out.state.touch_downs == 1);
  c.go(0.5, -4);
  CHECK(c.until(Contact::air, 0.5) < 0.3);
  CHECK(c.out.state.touch_downs == 0);
  CHECK(c.out.state.lift_offs == 1);
  CHECK_FALSE(c.out.state.landed);
  c.sink_to(0, 1);  // the second time it is one
  c.touch();
  CHECK(c.go(0.3).contact == Contact::ground);
  CHECK(c.out.state.touch_downs == 1);
}

TEST_CASE("after a landing the throttle is locked, whatever the estimate says, until the pilot hands over") {
  Craft c;
  c.take_off();
  c.sink_to(0, 0.5);
  c.touch();
  CHECK_FALSE(c.go(1).throttle_locked);  // it still rolls: a go-around is possible
  c.fast(5);
  CHECK(c.go(1).throttle_locked);
  CHECK(c.out.state.landed);
  c.s.attitude_valid = c.s.position_valid = c.s.height_valid = false;
  CHECK(c.go(5).throttle_locked);
  c.s.attitude_valid = c.s.height_valid = true;
  c.s.height_m += 40;  // a barometer that steps
  c.s.ground_speed_mps = 0;
  CHECK(c.go(5).throttle_locked);
  CHECK(c.out.state.contact == Contact::ground);
  c.status.override = true;
  CHECK(c.go(1).throttle_locked);  // the pilot has control now; only later changes count
  c.status.override = false;
  CHECK_FALSE(c.go(1).throttle_locked);
  CHECK_FALSE(c.go(10).throttle_locked);  // one landing locks once

  c.s.height_m = 0;
  c.take_off();
  c.sink_to(0, 0.5);
  c.touch();
  c.fast(2);
  CHECK(c.go(2).throttle_locked);  // and the second one again
  CHECK(c.out.state.touch_downs == 2);
}

TEST_CASE("a take-off request opens the throttle on the ground, and is refused in the air") {
  Craft c;
  c.take_off();
  c.push(c.in.takeoff, TakeoffRequest{});
  c.go(dt);
  CHECK(c.answer(c.in.takeoff) == "safety.aircraft_flies");
  c.sink_to(0, 0.5);
  c.touch();
  c.fast(0);
  REQUIRE(c.go(3).throttle_locked);
  c.push(c.in.takeoff, TakeoffRequest{});
  c.go(dt);
  CHECK(c.answer(c.in.takeoff) == "accepted");
  CHECK_FALSE(c.go(1).throttle_locked);
}

TEST_CASE("arming opens the throttle for the next flight") {
  Craft c;
  c.take_off();
  c.sink_to(0, 0.5);
  c.touch();
  c.fast(0);
  REQUIRE(c.go(3).throttle_locked);
  c.status.armed = false;
  CHECK(c.go(1).throttle_locked);
  c.status.armed = true;
  CHECK_FALSE(c.go(0.1).throttle_locked);
}

TEST_CASE("an aircraft that lies in a tree, slow and still, is on the ground") {
  Craft c;
  c.take_off(60);
  c.fast(1);
  CHECK(c.until(Contact::ground, 5) < 2);
  CHECK(c.go(1).throttle_locked);
}

TEST_CASE("a reset of the estimated height is no lift-off") {
  Craft c;
  c.take_off();
  c.sink_to(0, 0.5);
  c.touch();
  c.go(0.3);
  REQUIRE(c.out.state.contact == Contact::ground);
  c.s.height_m += 5;
  ++c.s.reset_count;
  c.s.reset_position_m = {0, 0, -5};
  CHECK(c.go(1).contact == Contact::ground);
}

}  // namespace ground_test
