// SPDX-License-Identifier: BSD-3-Clause
// The inner loops against numbers worked out by hand, and the yaw damper against its transfer function.
#include "plugins/control_slc/inner.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <fulmar/random.hpp>
#include <fulmar/testing.hpp>
#include <numbers>

namespace inner_test {

using namespace fulmar;
using Inner = slc::Inner;

namespace {
constexpr double cruise = 15;  // of the default airframe, whose surfaces move 0.5 rad and need no trim

VehicleState flying(double airspeed = cruise) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = airspeed;
  s.airspeed_valid = s.attitude_valid = true;
  return s;
}
const Actuators& step(Bench<Inner>& bench, const VehicleState& state, const AttitudeCommand& command,
                      int steps = 200) {
  bench.set(bench.in.state, state);
  bench.set(bench.in.attitude, command);
  for (int i = 0; i < steps; ++i) bench.step(0.01);
  return bench.out.actuators;
}
void no_integrals(Bench<Inner>& bench) { bench.params.roll_ki.value = bench.params.pitch_ki.value = 0; }
}  // namespace

TEST_CASE("roll to the right is positive aileron, nose up is negative elevator, each by its gain") {
  Bench<Inner> bench;
  no_integrals(bench);
  const Actuators& u = step(bench, flying(), {0.1, 0.05, 0.7});
  CHECK(u.aileron_rad == doctest::Approx(0.12));
  CHECK(u.elevator_rad == doctest::Approx(-0.2));
  CHECK(u.throttle_frac == 0.7);
}

TEST_CASE("rates damp, with the signs of the surfaces") {
  Bench<Inner> bench;
  no_integrals(bench);
  VehicleState s = flying();
  s.rate_radps = {0.5, 0.2, 0};
  const Actuators& u = step(bench, s, {});
  CHECK(u.aileron_rad == doctest::Approx(-0.01));
  CHECK(u.elevator_rad == doctest::Approx(0.1));
}

TEST_CASE("a ramp of the roll command is fed forward by its rate") {
  Bench<Inner> bench;
  no_integrals(bench);
  bench.params.roll_kp.value = 0;
  bench.set(bench.in.state, flying());
  for (int i = 0; i <= 60; ++i) {
    bench.set(bench.in.attitude, AttitudeCommand{0.008 * i, 0, 0});
    bench.step(0.01);
  }
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx((0.15 + 0.02) * 0.8).epsilon(1e-4));
}

TEST_CASE("gains fall with the square of the airspeed, within their bounds") {
  Bench<Inner> bench;
  no_integrals(bench);
  bench.params.airspeed_smoothing.value = 0;
  const AttitudeCommand c{0.1, 0, 0};
  CHECK(step(bench, flying(20), c).aileron_rad == doctest::Approx(0.12 * 0.5625));
  CHECK(step(bench, flying(12), c).aileron_rad == doctest::Approx(0.12 * 1.5625));
  CHECK(step(bench, flying(50), c).aileron_rad == doctest::Approx(0.12 / 2.5));
  CHECK(step(bench, flying(3.5), c).aileron_rad == doctest::Approx(0.12 * 2.5));
  VehicleState blind = flying(0);
  blind.ground_speed_mps = 15;
  blind.airspeed_valid = false;
  CHECK(step(bench, blind, c).aileron_rad == doctest::Approx(0.12));
}

TEST_CASE("gains follow the airspeed with its time constant, from where it was at the activation") {
  Bench<Inner> bench;
  no_integrals(bench);
  bench.params.airspeed_smoothing.value = 0.4;
  const AttitudeCommand c{0.1, 0, 0};
  CHECK(step(bench, flying(20), c, 1).aileron_rad == doctest::Approx(0.12 * 0.5625));
  const double Va = 12 + 8 * std::exp(-1);  // after one time constant
  CHECK(step(bench, flying(12), c, 40).aileron_rad == doctest::Approx(0.12 * 225 / (Va * Va)).epsilon(1e-6));
  bench.set(bench.in.state, flying(18));
  bench.activate(Applied<Inner::Outputs>{});
  CHECK(step(bench, flying(18), c, 1).aileron_rad == doctest::Approx(0.12 * 225 / (18.0 * 18)).epsilon(1e-6));
}

TEST_CASE("the yaw damper's frequency response is kd s / (s + p)") {
  const double kd = 0.3, pole = 0.6, dt = 0.01;
  for (double omega : {0.2, 0.6, 2.0, 5.0, 10.0, 20.0}) {
    Bench<Inner> bench;
    const double period = 2 * std::numbers::pi / omega;
    const double start = std::ceil(20 / period) * period, end = start + 10 * period;
    std::complex<double> in = 0, out = 0;
    bench.set(bench.in.attitude, AttitudeCommand{});
    for (int k = 0; k * dt < end; ++k) {
      VehicleState s = flying();
      s.rate_radps.z = 0.2 * std::sin(omega * k * dt);
      bench.set(bench.in.state, s);
      bench.step(dt);
      if (k * dt < start) continue;
      const std::complex<double> phasor = std::exp(std::complex<double>(0, -omega * k * dt));
      in += s.rate_radps.z * phasor;
      out += bench.out.actuators.rudder_rad * phasor;
    }
    const std::complex<double> s(0, omega), analytic = kd * s / (s + pole);
    const std::complex<double> over = out / in / analytic;
    CHECK(std::abs(std::abs(over) - 1) < 0.02);
    CHECK(std::abs(std::arg(over)) < 2 * std::numbers::pi / 180);
  }
}

TEST_CASE(
    "in a steady coordinated turn the damper leaves the rudder alone and the pitch damper the elevator") {
  Bench<Inner> bench;
  no_integrals(bench);
  VehicleState s = flying();
  s.roll_rad = 0.7;
  s.pitch_rad = 0.05;
  // Body rates of psi' = g tan(phi) / Va, B&M (3.3).
  const double psi_dot = 9.80665 * std::tan(0.7) / cruise;
  s.rate_radps = {0, std::sin(0.7) * std::cos(0.05) * psi_dot, std::cos(0.7) * std::cos(0.05) * psi_dot};
  const Actuators& u = step(bench, s, {0.7, 0.05, 0.5}, 1);
  CHECK(std::abs(u.rudder_rad) < 1e-12);
  CHECK(std::abs(u.elevator_rad) < 1e-12);
}

TEST_CASE("yaw to the right asks for nose left") {
  Bench<Inner> bench;
  step(bench, flying(), {}, 10);
  VehicleState s = flying();
  s.rate_radps.z = 0.1;
  CHECK(step(bench, s, {}, 1).rudder_rad == doctest::Approx(0.03).epsilon(0.01).scale(0));
}

TEST_CASE("a saturated elevator's integral unwinds as soon as the error turns") {
  Bench<Inner> bench;
  step(bench, flying(), {0, 0.3, 0.5}, 6000);
  CHECK(bench.out.actuators.elevator_rad == -0.5);
  VehicleState s = flying();
  s.pitch_rad = 0.31;
  step(bench, s, {0, 0.3, 0.5}, 1);
  CHECK(bench.out.actuators.elevator_rad > -0.5);
}

TEST_CASE("on the ground nothing is integrated") {
  Bench<Inner> bench;
  VehicleState s = flying(0);
  s.height_m = 0;
  s.pitch_rad = 0.1;
  s.roll_rad = -0.05;
  const Actuators first = step(bench, s, {}, 1);
  const Actuators later = step(bench, s, {}, 6000);
  CHECK(later.elevator_rad == doctest::Approx(first.elevator_rad));
  CHECK(later.aileron_rad == doctest::Approx(first.aileron_rad));
}

TEST_CASE("taking over continues the last deflections") {
  Bench<Inner> bench;
  bench.set(bench.in.state, flying());
  bench.set(bench.in.attitude, AttitudeCommand{});
  Inner::Outputs last;
  last.actuators = {0.5, 0.03, -0.12, 0};
  bench.activate(last);
  bench.step(0.01);
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.03));
  CHECK(bench.out.actuators.elevator_rad == doctest::Approx(-0.12));
}

TEST_CASE(
    "what integrals do not take up of a hand-over - rudder, throttle, too much of a surface - fades in half "
    "a second") {
  for (const double side : {1.0, -1.0}) {
    Bench<Inner> bench;
    no_integrals(bench);
    bench.set(bench.in.state, flying());
    bench.set(bench.in.attitude, AttitudeCommand{0, 0, 0.5});
    Inner::Outputs last;
    last.actuators = {0.5 + 0.3 * side, 0.35 * side, -0.45 * side,
                      0.2 * side};  // of 0.1 and 0.2 that the integrals may
    bench.activate(last);
    bench.step(0.01);
    const Actuators& u = bench.out.actuators;
    CHECK(u.throttle_frac == doctest::Approx(0.5 + 0.3 * side));
    CHECK(u.aileron_rad == doctest::Approx(0.35 * side));
    CHECK(u.elevator_rad == doctest::Approx(-0.45 * side));
    CHECK(u.rudder_rad == doctest::Approx(0.2 * side));
    for (int i = 0; i < 50; ++i) bench.step(0.01);
    const double left = std::exp(-1.0) * side;
    CHECK(u.throttle_frac == doctest::Approx(0.5 + 0.3 * left));
    CHECK(u.aileron_rad == doctest::Approx(0.1 * side + 0.25 * left));
    CHECK(u.elevator_rad == doctest::Approx(-0.2 * side - 0.25 * left));
    CHECK(u.rudder_rad == doctest::Approx(0.2 * left));
    for (int i = 0; i < 1000; ++i) bench.step(0.01);
    CHECK(u.rudder_rad == 0);
    bench.activate(last);  // on the ground no propeller runs down
    VehicleState stands = flying(0);
    stands.ground_speed_mps = 0;
    bench.set(bench.in.state, stands);
    bench.step(0.01);
    CHECK(u.throttle_frac == 0.5);
    bench.set(bench.in.state, flying());
    bench.activate(last);
    bench.step(0.01);
    bench.activate();  // nor after a pilot
    bench.step(0.01);
    CHECK(u.throttle_frac == 0.5);
  }
}

TEST_CASE("surfaces at zero in a glide are somebody's command; after nobody the law begins at its trim") {
  for (const bool with_last : {true, false}) {
    Bench<Inner> bench;
    auto& airframe = bench.params.airframe.value;
    airframe.elevator.trim_rad = -0.04;
    airframe.aileron.trim_rad = 0.03;
    VehicleState s = flying();
    s.pitch_rad = 0.02;
    s.roll_rad = 0.01;
    bench.set(bench.in.state, s);
    bench.set(bench.in.attitude, AttitudeCommand{0.02, 0.03, 0});
    REQUIRE((with_last ? bench.activate(Inner::Outputs{}) : bench.activate()) == Status::ok);
    REQUIRE(bench.step(0.01) == Status::ok);
    // without a law before: trim and gain times error, 1.2 and 4.0 times 0.01 rad
    CHECK(std::abs(bench.out.actuators.aileron_rad - (with_last ? 0 : 0.042)) < 1e-3);
    CHECK(std::abs(bench.out.actuators.elevator_rad - (with_last ? 0 : -0.08)) < 1e-3);
    CHECK(bench.out.actuators.throttle_frac == 0);
  }
}

TEST_CASE("deflections stay within the throws and throttle in 0 to 1, for any state and command") {
  Random random(3);
  Bench<Inner> bench;
  bench.params.quieten.value = false;  // the detector would take this motion for an oscillation
  for (int i = 0; i < 20000; ++i) {
    VehicleState s = flying(random.uniform(0, 60));
    s.airspeed_valid = random.uniform() < 0.8;
    s.roll_rad = random.uniform(-3.14, 3.14);
    s.pitch_rad = random.uniform(-1.5, 1.5);
    s.rate_radps = {random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-10, 10)};
    bench.set(bench.in.state, s);
    bench.set(bench.in.attitude,
              AttitudeCommand{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 2)});
    REQUIRE(bench.step(random.uniform(0, 0.3)) == Status::ok);
    const Actuators& u = bench.out.actuators;
    REQUIRE((u.throttle_frac >= 0 && u.throttle_frac <= 1));
    for (double surface : {u.aileron_rad, u.elevator_rad, u.rudder_rad}) REQUIRE(std::abs(surface) <= 0.5);
  }
}

TEST_CASE("an inner step allocates nothing") {
  Bench<Inner> bench;
  step(bench, flying(), {});
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

TEST_CASE("without an attitude the surfaces follow the command's rate alone, and the step says so") {
  Bench<Inner> bench;
  no_integrals(bench);
  VehicleState s = flying();
  s.attitude_valid = false;
  s.roll_rad = 0.6;
  s.pitch_rad = -0.2;
  s.rate_radps = {1, 1, 1};  // invalid values that must have no effect
  const Actuators& u = step(bench, s, {0.2, 0.05, 0.5});
  CHECK(u.aileron_rad == doctest::Approx(0).epsilon(1e-6));
  CHECK(u.elevator_rad == doctest::Approx(0).epsilon(1e-6));
  CHECK(u.rudder_rad == doctest::Approx(0).epsilon(1e-3));
  CHECK(u.throttle_frac == 0.5);
  CHECK(bench.step(0.01) == Status::degraded);
  double roll = 0.2;
  for (int i = 0; i < 100; ++i) {
    roll -= 0.01;  // one radian per second to the left: feed-forward and damping reference
    bench.set(bench.in.attitude, {roll, 0.05, 0.5});
    bench.step(0.01);
  }
  CHECK(u.aileron_rad == doctest::Approx(-0.15 - 0.02).epsilon(0.01).scale(0));
}

TEST_CASE("when attitude is known again it is held once the command answers to it, and no surface steps") {
  Bench<Inner> bench;
  VehicleState s = flying();
  s.attitude_valid = false;
  step(bench, s, {0, 0.05, 0.5});
  const Actuators last = bench.out.actuators;
  s = flying();
  s.roll_rad = 0.5;
  s.pitch_rad = 0.2;
  bench.tick.now_ns += 1'000'000;  // the command is older than this state
  bench.set(bench.in.state, s);
  CHECK(bench.step(0.01) == Status::degraded);
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(last.aileron_rad).epsilon(1e-6));
  bench.set(bench.in.attitude, {0.5, 0.2, 0.5});
  CHECK(bench.step(0.01) == Status::ok);
  CHECK(std::abs(bench.out.actuators.aileron_rad - last.aileron_rad) < 1e-6);
  CHECK(std::abs(bench.out.actuators.elevator_rad - last.elevator_rad) < 1e-6);
  CHECK(std::abs(bench.out.actuators.rudder_rad - last.rudder_rad) < 0.01);
}

TEST_CASE("when a pilot hands back the surfaces begin at their trim: what nobody commanded is not taken up") {
  Bench<Inner> bench;
  auto& airframe = bench.params.airframe.value;
  airframe.elevator.trim_rad = -0.12;
  airframe.aileron.trim_rad = 0.03;
  VehicleState s = flying();
  s.roll_rad = 0.02;
  s.pitch_rad = 0.05;
  bench.set(bench.in.state, s);
  bench.set(bench.in.attitude, AttitudeCommand{0.02, 0.05, 0.5});
  for (int i = 0; i < 100; ++i) {
    bench.activate();
    bench.step(0.01);
  }
  CHECK(bench.out.actuators.elevator_rad == doctest::Approx(-0.12).epsilon(0.02).scale(0));
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.03).epsilon(0.02).scale(0));
}

TEST_CASE("a step of the roll command is fed forward as 3 rad/s at most, either way") {
  for (const double side : {1.0, -1.0}) {
    Bench<Inner> bench;
    no_integrals(bench);
    bench.params.roll_kp.value = bench.params.roll_kd.value = 0;
    step(bench, flying(), {}, 1);
    const Actuators& u = step(bench, flying(), {side * 0.7, 0, 0.5}, 1);  // 0.7 rad in 10 ms
    CHECK(u.aileron_rad == doctest::Approx(side * 3 * bench.params.roll_kff));
  }
}

TEST_CASE("after a time without attitude a command is young enough that answers to the first known state") {
  Bench<Inner> bench;
  VehicleState s = flying();
  s.attitude_valid = false;
  step(bench, s, {0, 0.05, 0.5});
  bench.tick.now_ns += 1'000'000;
  bench.set(bench.in.state, flying());
  CHECK(bench.step(0.01) == Status::degraded);
  bench.set(bench.in.attitude, {0, 0.05, 0.5});  // to that state; states come more often than commands
  bench.tick.now_ns += 1'000'000;
  bench.set(bench.in.state, flying());
  CHECK(bench.step(0.01) == Status::ok);
}

TEST_CASE("a sideslip that is asked for is held by rudder and aileron, until nobody says it any more") {
  for (const double side : {1.0, -1.0}) {
    Bench<Inner> bench;
    no_integrals(bench);
    Airframe& a = bench.params.airframe.value;
    a.aero.yaw.beta_ratio = 0.13;
    a.aero.yaw.rudder_ratio = -0.065;
    a.aero.roll.beta_ratio = -0.12;
    a.aero.roll.aileron_ratio = 0.16;
    a.rudder.trim_rad = 0.01;
    a.aileron.trim_rad = 0.02;
    step(bench, flying(), {});
    // Air from the right: nose left, positive rudder; the dihedral rolls away from it, positive aileron.
    bench.set(bench.in.sideslip, SideslipCommand{side * 0.1});
    const Actuators& u = step(bench, flying(), {}, 1);
    CHECK(u.rudder_rad == doctest::Approx(0.01 + side * 0.2));
    CHECK(u.aileron_rad == doctest::Approx(0.02 + side * 0.075));
    // The moments vanish: B&M (4.19), (4.20).
    CHECK(std::abs(0.13 * side * 0.1 - 0.065 * (u.rudder_rad - 0.01)) < 1e-12);
    CHECK(std::abs(-0.12 * side * 0.1 + 0.16 * (u.aileron_rad - 0.02)) < 1e-12);
    step(bench, flying(), {}, 15);
    CHECK(bench.out.actuators.rudder_rad == doctest::Approx(0.01 + side * 0.2));
    step(bench, flying(), {}, 10);  // 0.26 s old
    CHECK(bench.out.actuators.rudder_rad == doctest::Approx(0.01));
    CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.02));
  }
  Bench<Inner> without;  // an airframe that has no rudder
  without.params.airframe.value.aero.yaw.rudder_ratio = 0;
  without.set(without.in.sideslip, SideslipCommand{0.1});
  CHECK(step(without, flying(), {}, 1).rudder_rad == 0);
}

TEST_CASE("the rudder rests at its trim") {
  Bench<Inner> bench;
  bench.params.airframe.value.rudder.trim_rad = 0.07;
  CHECK(step(bench, flying(), {}).rudder_rad == doctest::Approx(0.07));
}

TEST_CASE("the aileron works against sideslip where it is asked to, and only while sideslip is known") {
  for (const double beta : {-0.05, 0.05}) {
    Bench<Inner> bench;
    no_integrals(bench);
    bench.params.airspeed_smoothing.value = 0;
    VehicleState s = flying(20);
    s.yaw_rad = 2;
    s.beta_rad = beta;
    bench.params.roll_from_sideslip.value = 0;
    bench.retune();
    CHECK(step(bench, s, {}, 1).aileron_rad == 0);
    bench.params.roll_from_sideslip.value = 0.6;
    bench.retune();
    CHECK(step(bench, s, {}, 1).aileron_rad == doctest::Approx(0.5625 * 0.6 * beta));  // (15/20)^2
    s.airspeed_valid = false;                                                          // a stand-in
    CHECK(step(bench, s, {}, 1).aileron_rad == 0);
    s.airspeed_valid = true;
    s.attitude_valid = false;  // no valid attitude
    CHECK(step(bench, s, {}, 1).aileron_rad == 0);
  }
}

TEST_CASE("on the ground a surface is its gain times the error to the last digit: no integral of one step") {
  Bench<Inner> bench;
  VehicleState s = flying(0);
  s.height_m = 0;
  s.roll_rad = -0.05;
  CHECK(step(bench, s, {}, 10).aileron_rad == doctest::Approx(2.5 * 1.2 * 0.05));
  s.roll_rad = 0;
  s.pitch_rad = 0.02;
  CHECK(step(bench, s, {}, 10).elevator_rad == doctest::Approx(2.5 * 4 * 0.02));
}

}  // namespace inner_test
