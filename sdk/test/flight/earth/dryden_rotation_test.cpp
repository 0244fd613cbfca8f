// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/earth/dryden_rotation.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "fulmar/flight/earth/dryden_height.hpp"

namespace dryden_rotation_test {

using namespace fulmar;
using doctest::Approx;

namespace {
constexpr double Va = 25, span = 2.1, pi = std::numbers::pi;
}

TEST_CASE("rolling gusts have the deviation that their spectrum integrates to") {
  const DrydenScales scales = dryden_scales_at(Turbulence::severe, 100);
  const double sigma = scales.sigma.z(), L = scales.length.z();
  double variance = 0;
  const double step = 0.01;
  for (double w = step / 2; w < 4000; w += step) {
    const double x = 4 * span * w / (pi * Va);
    variance += step * sigma * sigma / (Va * L) * 0.8 * std::cbrt(pi * L / (4 * span)) / (1 + x * x);
  }
  CHECK(DrydenRotation::deviation_p(scales, span) / std::sqrt(variance) == Approx(1).epsilon(2e-3));
}

TEST_CASE("the rolling gust is a process of that deviation and of the time 4 b/(pi V)" *
          doctest::test_suite("amounts")) {
  DrydenScales scales;
  scales.length = {250, 250, 100};
  scales.sigma = {0, 0, 2};
  DrydenRotation air(span, 3);
  const double dt = 0.01, sigma = DrydenRotation::deviation_p(scales, span);
  double square = 0, product = 0, before = 0;
  constexpr int n = 400'000;
  for (int i = 0; i < n; ++i) {
    const double p = air.advance(dt, Va, {0, 0, 0}, scales).x();
    square += p * p;
    product += p * before;
    before = p;
  }
  CHECK(std::sqrt(square / n) / sigma == Approx(1).epsilon(0.02));
  CHECK(product / square == Approx(std::exp(-pi * Va / (4 * span) * dt)).epsilon(0.01));
}

TEST_CASE("pitching and yawing gusts are the gradients of the gusts along the axes, with their signs") {
  // A ramp of a sideways or downward gust: after the time of the wing the rate is a/V.
  DrydenRotation air(span, 1);
  const double dt = 0.005, a = 2;
  Eigen::Vector3d rate;
  for (int i = 0; i <= 400; ++i)
    rate = air.advance(dt, Va, {0, a * i * dt, -0.5 * a * i * dt}, DrydenScales{});
  CHECK(rate.x() == 0);
  CHECK(rate.y() == Approx(0.5 * a / Va));  // upward gust increases ahead: the air rotates nose up
  CHECK(rate.z() == Approx(a / Va));
  // A step of 1 m/s decays: value after one time constant.
  DrydenRotation step(span, 1);
  const double time_q = 4 * span / (pi * Va), h = time_q / 1000;
  step.advance(h, Va, {0, 0, 0}, DrydenScales{});
  for (int i = 0; i < 1000; ++i) rate = step.advance(h, Va, {0, 1, 1}, DrydenScales{});
  CHECK(rate.y() == Approx(-std::exp(-1) / (Va * time_q)).epsilon(0.01));
  CHECK(rate.z() == Approx(std::exp(-4.0 / 3) / (Va * time_q * 0.75)).epsilon(0.01));
}

TEST_CASE("still air does not turn") {
  DrydenRotation air(span, 1);
  for (int i = 0; i < 10; ++i) CHECK(air.advance(0.01, Va, {0, 0, 0}, DrydenScales{}).norm() == 0);
}

}  // namespace dryden_rotation_test
