// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/control/pid.hpp>

namespace pid_test {

using namespace fulmar;

TEST_CASE("a PID adds its four terms") {
  Pid pid;
  const PidInput in{.error = 0.5, .rate = 0.25, .feedforward = 0.125, .min = -10, .max = 10};
  // 0.125 + 2 * 0.5 - 1 * 0.25 + 4 * 0.5 * 0.01
  CHECK(pid.step({2, 4, 1}, in, 0.01) == doctest::Approx(0.895));
  CHECK(pid.integral() == doctest::Approx(0.02));
}

TEST_CASE("the integral depends on time, not on the number of steps") {
  Pid fast, slow;
  const PidInput in{.error = 0.3};
  for (int i = 0; i < 100; ++i) fast.step({0, 2, 0}, in, 0.005);
  for (int i = 0; i < 5; ++i) slow.step({0, 2, 0}, in, 0.1);
  CHECK(fast.integral() == doctest::Approx(0.3));
  CHECK(slow.integral() == doctest::Approx(0.3));
}

TEST_CASE("a saturated integrator does not wind up and unwinds at once when the error turns") {
  Pid pid;
  const PidGains gains{0.5, 1, 0};
  for (int i = 0; i < 10000; ++i) pid.step(gains, {.error = 5}, 0.01);
  CHECK(pid.saturated());
  CHECK(pid.integral() <= 1);
  // A large, opposite proportional term must not freeze the integral either: it saturates the other way, but
  // the integral may unwind.
  pid.reset_to(0.9);
  pid.step(gains, {.error = -10}, 0.01);
  CHECK(pid.saturated());
  const double before = pid.integral();
  pid.step(gains, {.error = 10, .rate = 0, .feedforward = -20},
           0.01);  // still saturated at the lower limit, error now positive
  CHECK(pid.integral() > before);
}

TEST_CASE("an integrator that starts outside the limits comes back inside") {
  Pid pid;
  pid.reset_to(4);
  int steps = 0;
  while (pid.step({0, 1, 0}, {.error = -0.5}, 0.01) >= 1 && steps < 2000) ++steps;
  CHECK(steps == doctest::Approx(600).epsilon(0.02));  // (4 - 1) / (0.5 per second)
}

TEST_CASE("reset makes the next output what it was") {
  Pid pid;
  const PidGains gains{0.7, 0.3, 0.2};
  const PidInput in{.error = 0.4, .rate = -0.3, .feedforward = 0.1, .min = -5, .max = 5};
  pid.reset_to(0.77, gains, in);
  CHECK(pid.step(gains, in, 0) == doctest::Approx(0.77));
  pid.reset_to(3, gains, in, 0.25);
  CHECK(pid.integral() == 0.25);
  pid.reset_to(-3, gains, in, 0.25);
  CHECK(pid.integral() == -0.25);
}

TEST_CASE("a step of the set-point does not kick the derivative") {
  Pid pid;
  const PidGains gains{1, 0, 3};
  const double before = pid.step(gains, {.error = 0, .rate = 0}, 0.01);
  const double after = pid.step(gains, {.error = 0.1, .rate = 0}, 0.01);
  CHECK(after - before == doctest::Approx(0.1));
}

TEST_CASE("a PI loop round a double integrator with rate feedback settles as its polynomial says") {
  // x'' = u, u = kp (1 - x) - kd x' with w = 2 rad/s, z = 1: x(t) = 1 - (1 + w t) exp(-w t).
  Pid pid;
  double x = 0, v = 0;
  const double dt = 1e-4;
  for (double t = 0; t < 1 - dt / 2; t += dt) {
    const double u =
        pid.step({4, 0, 4}, {.error = 1 - x, .rate = v, .feedforward = 0, .min = -100, .max = 100}, dt);
    x += v * dt + u * dt * dt / 2;
    v += u * dt;
  }
  CHECK(x == doctest::Approx(1 - 3 * std::exp(-2.0)).epsilon(1e-3));
}

TEST_CASE("what is missing of a limited demand counts after five seconds, down to a bound and up to zero") {
  const auto after = [](double seconds, double demanded, double flown, double integral, bool limited = true) {
    LateDemand late;
    double missing = 0;
    for (double t = 0.05; t < seconds; t += 0.1)
      missing = late.missing(limited, demanded, flown, integral, -0.1, 0.1);
    return missing;
  };
  CHECK(after(4.8, -1, 0.2, 0) == 0);
  CHECK(after(5.3, -1, 0.2, 0) == doctest::Approx(-1.2));
  CHECK(after(5.3, -1, 0.2, 0, false) == 0);
  CHECK(after(5.3, -1, -0.49, 0.05) == doctest::Approx(-0.51));
  CHECK(after(5.3, -1, -0.51, 0.05) == 0);
  CHECK(after(5.3, -1, 0.2, -0.1) == 0);
  CHECK(after(5.3, 1, 0.2, -0.01) == doctest::Approx(0.8));
  CHECK(after(5.3, 1, 0.2, 0) == 0);
  // gusts: too late for two thirds of the time, and for one third
  for (const int part : {1, 2}) {
    LateDemand late;
    double most = 0;
    for (int i = 0; i < 300; ++i)
      most = std::max(most, std::abs(late.missing(true, -1, i % 3 < part ? 1 : -1, 0, -0.1, 0.1)));
    CHECK((most > 0) == (part == 2));
    late.reset();
    CHECK(late.missing(true, -1, 1, 0, -0.1, 0.1) == 0);
  }
}

}  // namespace pid_test
