// SPDX-License-Identifier: BSD-3-Clause
// A command that a servo cannot follow is reported: before the signal begins, and during it.
#include "plugins/signal/servo_watch.hpp"

#include "kit.hpp"

namespace servo_watch_test {

using namespace kit;
using doctest::Approx;
using signal::Surfaces;

namespace {

/// A servo of 0.4 rad and 2 rad/s with a lag of 20 ms on each surface, at 0.05 rad of elevator.
struct Sweep : Stand<Surfaces> {
  Actuators asked{0.5, 0, 0.05, 0};
  std::string reported;
  double limited_s = 0, time_s = 0;

  explicit Sweep(Shape shape, double size, double f0 = 0.5, double f1 = 1) {
    Airframe& a = params.bounds.airframe.value;
    for (Surface* s : {&a.aileron, &a.elevator, &a.rudder}) {
      s->limit_rad = 0.4;
      s->rate_limit_radps = 2;
      s->time_constant_s = 0.02;
      s->trim_rad = s == &a.elevator ? 0.05 : 0;
    }
    params.signal = signal_of(shape, 8, f0, f1);
    params.size.value = size;
  }
  void go(double seconds) {
    for (double t = 0; t < seconds - 0.005; t += 0.01) {
      fly(in.actuators, asked);
      for (std::uint32_t i = 0; i < out.reported.notices.count; ++i)
        reported += std::string(out.reported.notices.items[i].text.view()) + "\n";
      limited_s += 0.01 * out.limited_ratio.value;
      time_s += 0.01;
    }
  }
};

}  // namespace

TEST_CASE("a signal that every servo can follow is flown without a word") {
  for (const Shape shape :
       {Shape::step, Shape::doublet, Shape::d3211, Shape::sine, Shape::chirp, Shape::multisine}) {
    CAPTURE(shape);
    Sweep s(shape, 0.1);
    s.go(9);
    CHECK(s.reported == "");
    CHECK(s.limited_s < 0.5);  // the edges of a step take 0.1 s each
  }
}

TEST_CASE("larger than the throw, about the trim; faster than the servo: reported when it is asked for") {
  for (const double size : {0.36, -0.36}) {
    Sweep large(Shape::sine, 0.3);
    large.go(0.01);
    CHECK(large.reported == "");
    large.params.size.value = size;
    large.params.bounds.airframe.value.elevator.trim_rad = 0.05;
    large.go(0.01);
    CHECK(large.reported == std::string(signal::signal_beyond_throw) + "\n");
  }
  struct Asked {
    Shape shape;
    double size, f1;
    bool reported;
  };
  for (const Asked& asked :
       {Asked{Shape::chirp, 0.1, 3.1, false}, Asked{Shape::chirp, 0.1, 3.3, true},  // 2 rad/s: 3.18 Hz
        Asked{Shape::multisine, 0.1, 3.3, true}, Asked{Shape::sine, 0.3, 40.0, false},
        Asked{Shape::square, 0.19, 1.0, false},
        Asked{Shape::square, 0.21, 1.0, true}}) {  // 0.2 of a level of 1 s
    CAPTURE(asked.shape);
    CAPTURE(asked.f1);
    Sweep fast(asked.shape, asked.size, 0.5, asked.f1);
    fast.go(0.01);
    CHECK((fast.reported == std::string(signal::signal_beyond_rate) + "\n") == asked.reported);
  }
}

TEST_CASE("a sine at twice the servo's rate: it is at its limit most of the time, which is reported once") {
  Sweep s(Shape::sine, 0.3, 2 / (2 * std::numbers::pi * 0.15));
  s.go(8);
  // 16 whole periods of 8 s; of each half one of 0.24 s the lag of 20 ms takes a tenth to a fifth
  CHECK(s.limited_s / 7.54 > 0.75);
  CHECK(s.limited_s / 7.54 < 0.9);
  CHECK(s.reported ==
        std::string(signal::signal_beyond_rate) + "\n" + std::string(signal::servo_limited[1][1]) + "\n");
}

TEST_CASE("a command of somebody else that drives a servo to its stop is reported, and again later") {
  Sweep s(Shape::none, 0.1);
  s.go(1);
  for (int i = 0; i < 2; ++i) {
    s.asked.rudder_rad = -0.5;
    s.go(1);
    CHECK(s.limited_s == Approx(1 + 1.2 * i).epsilon(0.02));  // and 0.2 s on the way back
    s.asked.rudder_rad = 0;
    s.go(10);
  }
  const std::string once = std::string(signal::servo_limited[2][0]) + "\n";
  CHECK(s.reported == once + once);
}

TEST_CASE("watching the servos allocates nothing") {
  Sweep s(Shape::sine, 0.3, 5);
  s.go(0.01);
  CHECK(allocations([&] { s.step(0.01); }) == 0);
}

}  // namespace servo_watch_test
