// SPDX-License-Identifier: BSD-3-Clause
// Second-order servos, their stops and dead band, against closed solutions and small Euler steps.
#include "fulmar/sim/servo.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "fulmar/sim/drive.hpp"

namespace servo_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

constexpr double dt = 0.00125;

/// The published servo of the Skywalker X8's elevons.
Surface x8() {
  Surface s;
  s.limit_rad = 0.5236;
  s.min_rad = -0.5236;
  s.max_rad = 0.6109;
  s.rate_limit_radps = 3.49;
  s.natural_frequency_radps = 100;
  s.damping_ratio = 1.71;
  return s;
}

/// Step response to 1 of the overdamped servo: a sum of two exponentials.
double overdamped(double omega, double zeta, double t) {
  const double root = std::sqrt(zeta * zeta - 1), p1 = omega * (zeta - root), p2 = omega * (zeta + root);
  return 1 - (p2 * std::exp(-p1 * t) - p1 * std::exp(-p2 * t)) / (p2 - p1);
}
/// The same for the underdamped servo: Ogata, Modern Control Engineering, (5-12).
double underdamped(double omega, double zeta, double t) {
  const double root = std::sqrt(1 - zeta * zeta), wd = omega * root;
  return 1 - std::exp(-zeta * omega * t) * (std::cos(wd * t) + zeta / root * std::sin(wd * t));
}
double critical(double omega, double, double t) { return 1 - std::exp(-omega * t) * (1 + omega * t); }

Surface free_servo(double omega, double zeta) {
  Surface s;
  s.limit_rad = 1.5;
  s.rate_limit_radps = 1e4;
  s.natural_frequency_radps = omega;
  s.damping_ratio = zeta;
  return s;
}

/// Reference solution by Euler steps of a microsecond.
struct Euler {
  double x = 0, v = 0;
  void advance(const Surface& s, double command, double seconds) {
    constexpr double h = 1e-6;
    const double w = s.natural_frequency_radps;
    for (int i = 0; i < std::lround(seconds / h); ++i) {
      v = std::clamp(v + h * (w * w * (command - x) - 2 * s.damping_ratio * w * v), -s.rate_limit_radps,
                     s.rate_limit_radps);
      x += h * v;
    }
  }
};

}  // namespace

TEST_CASE("a second-order servo follows its closed step response for any time step") {
  struct Case {
    double omega, zeta;
    double (*solution)(double, double, double);
  };
  for (const Case& c : {Case{100, 1.71, overdamped}, Case{60, 0.5, underdamped}, Case{40, 1, critical}})
    for (const double h : {0.00125, 0.005, 0.07})
      for (const double size : {0.4, -0.4}) {
        CAPTURE(c.zeta);
        CAPTURE(h);
        Servo servo(free_servo(c.omega, c.zeta));
        for (int i = 1; i * h < 0.25; ++i) {
          servo.advance(size, h);
          CHECK(servo.angle() / (size * c.solution(c.omega, c.zeta, i * h)) == Approx(1).epsilon(1e-9));
        }
      }
}

TEST_CASE("two steps of a servo are one of twice the length") {
  Servo twice(x8()), once(x8());
  for (int i = 0; i < 200; ++i) {
    const double command = i < 60 ? 0.5 : i < 110 ? -0.4 : 0.05;
    twice.advance(command, dt);
    twice.advance(command, dt);
    once.advance(command, 2 * dt);
    REQUIRE(std::abs(twice.angle() - once.angle()) < 1e-9);
  }
}

TEST_CASE("its rate stays below the limit, and the way is that of small Euler steps") {
  for (const double zeta : {1.71, 0.3}) {
    Surface s = x8();
    s.damping_ratio = zeta;
    Servo servo(s);
    Euler euler;
    double fastest = 0, before = 0;
    for (int i = 0; i < 400; ++i) {
      const double command = i < 150 ? 0.5 : i < 250 ? -0.45 : i < 300 ? 0.01 : 0.02;
      servo.advance(command, dt);
      euler.advance(s, command, dt);
      fastest = std::max(fastest, std::abs(servo.angle() - before) / dt);
      before = servo.angle();
      REQUIRE(std::abs(servo.angle() - euler.x) < 2e-5);
    }
    CHECK(fastest / 3.49 == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("an elevon moves from -30 to 35 degrees, and no command or swing moves it further") {
  Surface s = x8();
  s.damping_ratio = 0.1;  // large overshoot without the stop
  s.rate_limit_radps = 100;
  for (const double command : {0.6, 5.0, -0.5, -5.0}) {
    Servo servo(s);
    double lowest = 0, highest = 0;
    for (int i = 0; i < 2000; ++i) {
      servo.advance(command, dt);
      lowest = std::min(lowest, servo.angle());
      highest = std::max(highest, servo.angle());
    }
    CHECK(lowest >= s.min_rad);
    CHECK(highest <= s.max_rad);
    CHECK((command > 0 ? highest / s.max_rad : lowest / s.min_rad) == Approx(1));
    CHECK(servo.angle() == Approx(std::clamp(command, s.min_rad, s.max_rad)).epsilon(1e-6).scale(0));
  }
}

TEST_CASE("stops that are not given are at the throw; one alone can be given") {
  CHECK(stops({.limit_rad = 0.4}).min == -0.4);
  CHECK(stops({.limit_rad = 0.4}).max == 0.4);
  Surface down;
  down.limit_rad = 0.4;
  down.min_rad = 0;
  CHECK(stops(down).min == 0);
  CHECK(stops(down).max == 0.4);
  Servo servo(down);  // first order
  for (int i = 0; i < 400; ++i) servo.advance(-0.3, dt);
  CHECK(servo.angle() == 0);
  for (int i = 0; i < 400; ++i) servo.advance(0.3, dt);
  CHECK(servo.angle() == Approx(0.3));
}

TEST_CASE("a dead band is a play of its width: it rests within, and turns back later by it") {
  for (const bool second : {false, true}) {
    Surface s;
    s.limit_rad = 0.5;
    s.dead_band_rad = 0.04;
    if (second) s.natural_frequency_radps = 120;
    Servo servo(s);
    const auto settle = [&](double command) {
      for (int i = 0; i < 2000; ++i) servo.advance(command, dt);
      return servo.angle();
    };
    CHECK(settle(0.019) == 0);
    CHECK(settle(-0.019) == 0);
    CHECK(settle(0.3) / 0.28 == Approx(1).epsilon(1e-9));
    CHECK(settle(0.261) / 0.28 == Approx(1).epsilon(1e-9));
    CHECK(settle(0.2) / 0.22 == Approx(1).epsilon(1e-9));
    CHECK(settle(-0.2) / -0.18 == Approx(1).epsilon(1e-9));
    servo.set(0.1);  // at rest at its target
    CHECK(settle(0.115) == 0.1);
  }
}

TEST_CASE("a surface that is hard over goes to its own stop on that side; a slow one lives in slower time") {
  Fault fault;
  fault.growth = 1;
  for (const bool positive : {true, false}) {
    Drive drive(x8());
    fault.kind = positive ? FaultKind::hardover_positive : FaultKind::hardover_negative;
    drive.suffer(fault);
    for (int i = 0; i < 1000; ++i) drive.advance(0, dt);
    CHECK(drive.angle() / (positive ? 0.6109 : -0.5236) == Approx(1));
  }
  Drive slow(x8()), whole(x8());
  fault.kind = FaultKind::slow;
  fault.share = 0.25;
  slow.suffer(fault);
  for (int i = 0; i < 40; ++i) {
    whole.advance(0.4, dt);
    for (int k = 0; k < 4; ++k) slow.advance(0.4, dt);
    REQUIRE(slow.angle() / whole.angle() == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("reversal is for hardware: it does not change a simulated servo") {
  Surface s = x8();
  s.reversed = true;
  Servo reversed(s), right(x8());
  for (int i = 0; i < 100; ++i) {
    reversed.advance(0.3, dt);
    right.advance(0.3, dt);
  }
  CHECK(reversed.angle() == right.angle());
  CHECK(right.angle() > 0.2);
}

}  // namespace servo_test
