// SPDX-License-Identifier: BSD-3-Clause
// The three components: the added signal, its end, and unchanged commands otherwise.
#define FULMAR_COUNT_ALLOCATIONS
#include <cstring>
#include <limits>

#include "kit.hpp"

namespace excitation_test {

using namespace kit;
using fulmar::signal::Attitude;
using fulmar::signal::Guidance;
using fulmar::signal::Surfaces;

namespace {

const AttitudeCommand command{0.1, 0.03, 0.4};
const Actuators surfaces{0.5, 0.02, -0.05, 0.01};

/// Pitch is excited; the angle that is added in each step.
struct Pitch : Stand<Attitude> {
  explicit Pitch(Shape shape, double duration = 4) {
    params.signal.shape.value = shape;
    params.signal.duration.value = duration;
    params.size.value = 3 * deg;
  }
  double go(int steps = 1) {
    for (int i = 0; i < steps; ++i) status = fly(in.attitude, asked);
    return out.attitude.pitch_rad - asked.pitch_rad;
  }
  bool bits_are_its_own() const { return std::memcmp(&out.attitude, &asked, sizeof asked) == 0; }
  AttitudeCommand asked = command;
  Status status = Status::failed;
};

}  // namespace

TEST_CASE("without a signal, before one and after one, every bit of a command goes through") {
  Stand<Guidance> guidance;
  Stand<Surfaces> actuators;
  GuidanceCommand asked;
  asked.course_rad = -3.1415926;
  asked.height_m = 0.1 + 0.2;
  asked.climb_rate_mps = -1.0 / 3;
  asked.airspeed_mps = 1e-300;
  asked.roll_feedforward_rad = 9;
  asked.lateral_acceleration_mps2 = -0.0;
  const Actuators wild{1.7, -2.5, 0.1 + 0.2, -0.0};  // beyond every limit: not for this to judge
  for (int i = 0; i < 3; ++i) {
    CHECK(guidance.fly(guidance.in.command, asked) == Status::ok);
    CHECK(actuators.fly(actuators.in.actuators, wild) == Status::ok);
    CHECK(std::memcmp(&guidance.out.command, &asked, sizeof asked) == 0);
    CHECK(std::memcmp(&actuators.out.actuators, &wild, sizeof wild) == 0);
  }
  Pitch p(Shape::doublet, 1);
  p.params.signal.delay.value = 0.5;
  p.asked.throttle_frac = 1.0 / 3;
  for (int i = 0; i < 50; ++i) {
    p.go();
    CHECK(p.bits_are_its_own());
    CHECK(p.out.reported.active_ratio.value == 1);
  }
  CHECK(p.go() == doctest::Approx(3 * deg));
  CHECK(p.out.attitude.roll_rad == command.roll_rad);
  CHECK(p.go(99) == doctest::Approx(-3 * deg));
  CHECK(p.out.reported.active_ratio.value == 1);
  for (int i = 0; i < 50; ++i) {
    p.go();
    CHECK(p.bits_are_its_own());
    CHECK(p.out.reported.active_ratio.value == 0);
    CHECK(p.out.pitch_excitation_rad.value == 0);
  }
  CHECK(p.status == Status::ok);
}

TEST_CASE("each channel gets its own size, and tells what it got") {
  Stand<Attitude> a;
  Stand<Surfaces> s;
  Stand<Guidance> g;
  a.params.signal.shape.value = s.params.signal.shape.value = g.params.signal.shape.value = Shape::step;
  const auto roll = [&](Attitude::Channel c) {
    a.params.channel.value = c;
    a.fly(a.in.attitude, command);
  };
  roll(Attitude::Channel::roll);
  CHECK(a.out.attitude.roll_rad == doctest::Approx(0.1 + 0.0873));
  CHECK(a.out.roll_excitation_rad.value == doctest::Approx(0.0873));
  for (int i = 0; i < 25; ++i) roll(Attitude::Channel::throttle);  // the roll before has gone by then
  CHECK(a.out.attitude.throttle_frac == doctest::Approx(0.5));
  CHECK(a.out.attitude.roll_rad == 0.1);
  CHECK(a.out.throttle_excitation_frac.value == doctest::Approx(0.1));
  const auto move = [&](Surfaces::Channel c, double Actuators::*of, const Probe& reported, double size) {
    s.params.channel.value = c;
    for (int i = 0; i < 25; ++i) s.fly(s.in.actuators, surfaces);
    CHECK(s.out.actuators.*of == doctest::Approx(surfaces.*of + size));
    CHECK(reported.value == doctest::Approx(size));
  };
  move(Surfaces::Channel::aileron, &Actuators::aileron_rad, s.out.aileron_excitation_rad, 0.0524);
  move(Surfaces::Channel::elevator, &Actuators::elevator_rad, s.out.elevator_excitation_rad, 0.0524);
  move(Surfaces::Channel::rudder, &Actuators::rudder_rad, s.out.rudder_excitation_rad, 0.0524);
  move(Surfaces::Channel::throttle, &Actuators::throttle_frac, s.out.throttle_excitation_frac, 0.1);
  GuidanceCommand asked;
  asked.course_rad = 3.1;
  asked.height_m = 70;
  asked.airspeed_mps = 17;
  const auto lead = [&](Guidance::Channel c) {
    g.params.channel.value = c;
    for (int i = 0; i < 25; ++i) g.fly(g.in.command, asked);
  };
  lead(Guidance::Channel::course);
  CHECK(g.out.command.course_rad == doctest::Approx(3.1 + 0.262 - 2 * std::numbers::pi));
  CHECK(g.out.course_excitation_rad.value == doctest::Approx(0.262));
  lead(Guidance::Channel::height);
  CHECK(g.out.command.height_m == doctest::Approx(75));
  CHECK(g.out.command.course_rad == 3.1);
  lead(Guidance::Channel::airspeed);
  CHECK(g.out.command.airspeed_mps == doctest::Approx(18.5));
}

TEST_CASE("the sum stays within the airframe's limits, and what was really added is told") {
  const Airframe a = test::anaconda();
  Pitch p(Shape::step);
  p.asked.pitch_rad = a.limits.pitch_max_rad - 1 * deg;
  CHECK(p.go() == doctest::Approx(1 * deg));
  CHECK(p.out.pitch_excitation_rad.value == doctest::Approx(1 * deg));
  p.asked.pitch_rad = a.limits.pitch_max_rad + 2 * deg;  // an outer law's own choice, and no more
  CHECK(p.go() == 0);
  Stand<Surfaces> s;
  s.params.signal.shape.value = Shape::step;
  s.params.bounds.airframe.value.elevator.min_rad = -0.1;  // its servo stops before the throw
  s.params.size.value = -0.3;
  s.fly(s.in.actuators, surfaces);
  CHECK(s.out.actuators.elevator_rad == doctest::Approx(-0.1));
  CHECK(s.out.elevator_excitation_rad.value == doctest::Approx(-0.05));
  s.params.channel.value = Surfaces::Channel::throttle;
  s.params.throttle_size.value = 0.5;
  Actuators full = surfaces;
  full.throttle_frac = 0.9;
  for (int i = 0; i < 25; ++i) s.fly(s.in.actuators, full);
  CHECK(s.out.actuators.throttle_frac == 1);
  Stand<Guidance> g;
  g.params.signal.shape.value = Shape::step;
  g.params.channel.value = Guidance::Channel::airspeed;
  g.params.airspeed_size.value = -10;
  GuidanceCommand asked;
  asked.airspeed_mps = 17;
  g.fly(g.in.command, asked);
  CHECK(g.out.command.airspeed_mps == a.limits.airspeed_min_mps);
}

TEST_CASE("each bound aborts: the rest is gone within 0.2 s, it is told once, and stays so") {
  struct Case {
    const char* says;
    void (*leave)(VehicleState&);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  static const double none = nan;
  const Case cases[] = {
      {"signal.aborted_by_roll", [](VehicleState& s) { s.roll_rad = -46 * deg; }},
      {"signal.aborted_by_pitch", [](VehicleState& s) { s.pitch_rad = 29 * deg; }},
      {"signal.aborted_by_pitch", [](VehicleState& s) { s.pitch_rad = -29 * deg; }},
      {"signal.aborted_by_roll", [](VehicleState& s) { s.roll_rad = none; }},
      {"signal.aborted_by_height", [](VehicleState& s) { s.height_m = 49.9; }},
      {"signal.aborted_by_height", [](VehicleState& s) { s.height_m = 90.1; }},
      {"signal.aborted_by_airspeed_low", [](VehicleState& s) { s.airspeed_mps = 10.9; }},  // of 10
      {"signal.aborted_by_airspeed_high", [](VehicleState& s) { s.airspeed_mps = 25.1; }},
      {"signal.aborted_by_estimate", [](VehicleState& s) { s.attitude_valid = false; }},
      {"signal.aborted_by_estimate", [](VehicleState& s) { s.height_valid = false; }},
      {"signal.aborted_by_estimate", [](VehicleState& s) { s.airspeed_valid = false; }}};
  for (const Case& c : cases) {
    CAPTURE(c.says);
    Pitch p(Shape::step, 10);
    CHECK(p.go(10) == doctest::Approx(3 * deg));
    c.leave(p.state);
    p.go();
    CHECK(p.status == Status::degraded);
    REQUIRE(p.out.reported.notices.count == 1);
    const std::string said(p.out.reported.notices.items[0].text.view());
    CHECK(said == c.says);
    CHECK(p.out.reported.aborted_ratio.value == 1);
    CHECK(p.out.reported.active_ratio.value == 0);
    p.state = level();  // back within the bounds: it does not come back
    CHECK(p.go(9) == doctest::Approx(1.5 * deg));
    CHECK(p.out.reported.notices.count == 0);
    p.go(11);
    CHECK(p.bits_are_its_own());
    CHECK(p.go(100) == 0);
    CHECK(p.status == Status::degraded);
    p.params.signal.run.value = 1;  // asked for again
    CHECK(p.go() == doctest::Approx(3 * deg));
    CHECK(p.status == Status::ok);
    CHECK(p.out.reported.aborted_ratio.value == 0);
  }
}

TEST_CASE("just within every bound it goes on; wider bounds and a stated stall count") {
  Pitch p(Shape::step, 10);
  p.go();
  p.state.roll_rad = 44.9 * deg;
  p.state.pitch_rad = -28.6 * deg;
  p.state.height_m = 89.9;
  p.state.airspeed_mps = 11.1;
  CHECK(p.go() == doctest::Approx(3 * deg));
  p.params.bounds.stall_airspeed.value = 10.2;  // times 1.1 is 11.22
  p.go();
  CHECK(p.out.reported.aborted_ratio.value == 1);
  Pitch wide(Shape::step, 10);
  wide.params.bounds.roll_bound.value = 1.2;
  wide.params.bounds.height_bound.value = 100;
  wide.go();
  wide.state.roll_rad = 1.1;
  wide.state.height_m = 165;
  CHECK(wide.go() == doctest::Approx(3 * deg));
}

TEST_CASE("a phase that takes the signal away lets it go within 0.2 s, without a step and without a fault") {
  Pitch p(Shape::step, 10);
  p.go(10);
  p.params.signal.shape.value = Shape::none;
  CHECK(p.go() == doctest::Approx(3 * 0.95 * deg));
  CHECK(p.status == Status::ok);
  CHECK(p.out.reported.notices.count == 0);
  double before = p.go();
  for (int i = 0; i < 18; ++i) {
    const double now = p.go();
    CHECK(before - now == doctest::Approx(0.15 * deg));
    before = now;
  }
  CHECK(p.bits_are_its_own());
}

TEST_CASE("another signal begins anew, and what is left of the one before goes on its own channel") {
  Pitch p(Shape::step, 10);
  p.go(10);
  p.params.channel.value = Attitude::Channel::roll;
  CHECK(p.go(10) == doctest::Approx(1.5 * deg));
  CHECK(p.out.attitude.roll_rad == doctest::Approx(command.roll_rad + 3 * deg));
  p.params.size.value = 1 * deg;  // 3 degrees go while 1 is added
  CHECK(p.go(10) == 0);
  CHECK(p.out.attitude.roll_rad == doctest::Approx(command.roll_rad + 2.5 * deg));
  p.go(11);
  CHECK(p.out.attitude.roll_rad == doctest::Approx(command.roll_rad + 1 * deg));
}

TEST_CASE("the pilot: aborted while commands do not move the aircraft, and not begun for that he lets go") {
  Pitch p(Shape::step, 10);
  VehicleStatus status;
  status.in_control = true;
  p.set(p.in.signal.status, status);
  CHECK(p.go(10) == doctest::Approx(3 * deg));
  status.in_control = false;
  p.set(p.in.signal.status, status);
  p.go();
  CHECK(p.status == Status::degraded);
  status.in_control = true;
  p.set(p.in.signal.status, status);
  p.go(30);
  CHECK(p.bits_are_its_own());
  // as the host does it in `control`, with no status wired: activated as at the start of a flight
  Pitch q(Shape::step, 10);
  CHECK(q.go(10) == doctest::Approx(3 * deg));
  for (int i = 0; i < 3; ++i) {
    q.activate();
    q.go();
    CHECK(q.out.reported.notices.count == (i == 0 ? 1 : 0));
    CHECK(q.bits_are_its_own());
  }
  q.go(100);
  CHECK(q.bits_are_its_own());
  CHECK(q.out.reported.aborted_ratio.value == 1);
  // after another component's commands it is a phase that begins
  Attitude::Outputs flown;
  flown.attitude = command;
  q.activate(flown);
  CHECK(q.go() == doctest::Approx(3 * deg));
}

TEST_CASE("a course is not excited while guidance asks for an acceleration, and that is told") {
  Stand<Guidance> g;
  g.params.signal.shape.value = Shape::step;
  g.params.channel.value = Guidance::Channel::course;
  GuidanceCommand asked;
  asked.lateral = LateralMode::acceleration;
  CHECK(g.fly(g.in.command, asked) == Status::degraded);
  CHECK(std::string(g.out.reported.notices.items[0].text.view()).find("acceleration") != std::string::npos);
  CHECK(std::memcmp(&g.out.command, &asked, sizeof asked) == 0);
}

TEST_CASE("no step allocates: not the first of a multisine, and not the one that aborts") {
  Pitch p(Shape::none);
  p.go();
  p.set(p.in.attitude, command);
  p.set(p.in.signal.state, level());
  p.params.signal = signal_of(Shape::multisine, 20, 0.1, 3);
  p.retune();
  CHECK(fulmar::allocations([&] { p.step(0.01); }) == 0);
  CHECK(fulmar::allocations([&] { p.step(0.01); }) == 0);
  VehicleState banked = level();
  banked.roll_rad = 1;
  p.set(p.in.signal.state, banked);
  CHECK(fulmar::allocations([&] { p.step(0.01); }) == 0);
  CHECK(p.out.reported.aborted_ratio.value == 1);
}

}  // namespace excitation_test
