// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <complex>
#include <fulmar/flight/math/filters.hpp>
#include <numbers>

namespace filters_test {

using namespace fulmar;
using Complex = std::complex<double>;

namespace {
/// Gain and phase of a filter at one frequency, by correlation over whole periods after the transient.
template <class Step>
Complex response(double omega, double dt, double settle_s, Step step) {
  const double period = 2 * std::numbers::pi / omega;
  const double start = std::ceil(settle_s / period) * period, end = start + 20 * period;
  Complex in = 0, out = 0;
  for (long k = 0; static_cast<double>(k) * dt < end; ++k) {
    const double t = static_cast<double>(k) * dt, u = std::sin(omega * t), y = step(u);
    if (t < start) continue;
    const Complex phasor = std::exp(Complex(0, -omega * t));
    in += u * phasor;
    out += y * phasor;
  }
  return out / in;
}
}  // namespace

TEST_CASE("a low-pass reaches 1 - 1/e after one time constant, for any step") {
  for (double dt : {0.001, 0.01, 0.125, 0.5}) {
    LowPass filter;
    filter.reset_to(0);
    for (int i = 0; i < static_cast<int>(std::lround(0.5 / dt)); ++i) filter.step(1, 0.5, dt);
    CHECK(filter.value() == doctest::Approx(1 - std::exp(-1.0)).epsilon(1e-12));
  }
  LowPass fresh;
  CHECK(fresh.step(7, 0.5, 0.01) == 7);  // starts at its input
  CHECK(fresh.step(9, 0, 0.01) == 9);    // no time constant: no filter
  CHECK(fresh.step(100, 0.5, 0) == 9);   // no time: no change
}

TEST_CASE("the wash-out's frequency response is that of s / (s + p)") {
  const double p = 0.6349, dt = 0.01;
  for (double omega : {0.1, 0.6349, 2.0, 5.0, 30.0}) {
    WashOut filter;
    const Complex measured = response(omega, dt, 15, [&](double u) { return filter.step(u, p, dt); });
    const Complex s(0, omega), analytic = s / (s + p);
    CHECK(std::abs(measured - analytic) < 0.02);
    if (omega <= 5) CHECK(std::abs(measured - analytic) < 2e-3);
  }
}

TEST_CASE("the wash-out forgets a step with its time constant and never saw the start") {
  WashOut filter;
  CHECK(filter.step(5, 1, 0.01) == 0);
  CHECK(filter.step(6, 1, 1e-9) == doctest::Approx(1));
  for (int i = 0; i < 200; ++i) filter.step(6, 1, 0.01);
  CHECK(filter.value() == doctest::Approx(std::exp(-2.0)).epsilon(1e-6));
}

TEST_CASE("the second-order filter's step response is the closed form, damped and critically damped") {
  const double w = 3, u = 2;
  for (double z : {0.2, 0.7, 1.0}) {
    for (double dt : {0.001, 0.05, 0.25}) {
      SecondOrder filter;
      filter.reset_to(0);
      for (int i = 0; i < static_cast<int>(std::lround(1 / dt)); ++i) filter.step(u, w, z, dt);
      const double wd = w * std::sqrt(1 - z * z), e = std::exp(-z * w);
      const double y = z < 1 ? 1 - e * (std::cos(wd) + z * w / wd * std::sin(wd)) : 1 - e * (1 + w);
      const double v = z < 1 ? e * w * w / wd * std::sin(wd) : e * w * w;
      CHECK(filter.value() == doctest::Approx(u * y).epsilon(1e-9));
      CHECK(filter.rate() == doctest::Approx(u * v).epsilon(1e-9));
    }
  }
}

TEST_CASE("a damping above 1 counts as 1; a reset stands still") {
  SecondOrder heavy, critical;
  for (SecondOrder* f : {&heavy, &critical}) f->reset_to(0);
  for (int i = 0; i < 50; ++i) CHECK(heavy.step(2, 3, 4, 0.01) == critical.step(2, 3, 1, 0.01));
  CHECK(heavy.rate() > 0.1);
  heavy.reset_to(5);
  CHECK(heavy.rate() == 0);
  CHECK(heavy.step(5, 3, 0.7, 0.01) == doctest::Approx(5).epsilon(1e-14));
}

TEST_CASE("the differentiator gives a ramp's slope and the response of s / (tau s + 1)") {
  Differentiator ramp;
  double y = 0;
  for (int i = 0; i < 400; ++i) y = ramp.step(3 + 0.7 * 0.01 * i, 0.1, 0.01);
  CHECK(y == doctest::Approx(0.7).epsilon(1e-9));
  Differentiator filter;
  const double omega = 4, tau = 0.05;
  const Complex measured = response(omega, 0.002, 2, [&](double u) { return filter.step(u, tau, 0.002); });
  const Complex s(0, omega);
  CHECK(std::abs(measured - s / (tau * s + 1.0)) < 0.01);
}

TEST_CASE("the rate limiter moves at its limit and no faster, up and down apart") {
  RateLimiter limiter;
  CHECK(limiter.step(1, 2, 0.1) == 1);
  CHECK(limiter.step(9, 2, 0.1) == doctest::Approx(1.2));
  CHECK(limiter.step(-9, 2, 0.1) == doctest::Approx(1.0));
  CHECK(limiter.step(9, -1, 5, 0.1) == doctest::Approx(1.5));
  CHECK(limiter.step(-9, -1, 5, 0.1) == doctest::Approx(1.4));
  CHECK(limiter.step(1.41, -1, 5, 0.1) == doctest::Approx(1.41));
}

}  // namespace filters_test
