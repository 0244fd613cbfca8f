// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/earth/dryden_height.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace dryden_height_test {

using namespace fulmar;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double Va = 17, ft = 0.3048;

/// Fast Fourier transform in place, radix 2.
void fourier(std::vector<std::complex<double>>& x) {
  const std::size_t n = x.size();
  if (n == 1) return;
  std::vector<std::complex<double>> even(n / 2), odd(n / 2);
  for (std::size_t i = 0; i < n / 2; ++i) {
    even[i] = x[2 * i];
    odd[i] = x[2 * i + 1];
  }
  fourier(even);
  fourier(odd);
  for (std::size_t k = 0; k < n / 2; ++k) {
    const auto t =
        std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n)) * odd[k];
    x[k] = even[k] + t;
    x[k + n / 2] = even[k] - t;
  }
}

/// One-sided density per Hz of each axis at k / (n dt): Welch's method, Hann window, segments that overlap by
/// half.
std::array<std::vector<double>, 3> welch(Dryden& dryden, double dt, std::size_t n, int segments) {
  std::array<std::vector<double>, 3> density;
  for (auto& d : density) d.assign(n / 2, 0);
  std::vector<double> window(n);
  double power = 0;
  for (std::size_t i = 0; i < n; ++i) {
    window[i] = std::pow(std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)), 2);
    power += window[i] * window[i];
  }
  std::vector<Vector3d> g(n);
  for (std::size_t i = n / 2; i < n; ++i) g[i] = dryden.advance(dt, Va);
  std::vector<std::complex<double>> x(n);
  for (int s = 0; s < segments; ++s) {
    std::copy(g.begin() + static_cast<std::ptrdiff_t>(n / 2), g.end(), g.begin());
    for (std::size_t i = n / 2; i < n; ++i) g[i] = dryden.advance(dt, Va);
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < n; ++i) x[i] = window[i] * g[i](axis);
      fourier(x);
      for (std::size_t k = 1; k < n / 2; ++k)
        density[std::size_t(axis)][k] += 2 * dt * std::norm(x[k]) / power / segments;
    }
  }
  return density;
}

/// MIL-F-8785C 3.7.1.2, per rad/m, one-sided; here per Hz. A signal sampled at `dt` has the density of all
/// its aliases.
double book(int axis, double L, double sigma, double f, double dt) {
  double sum = 0;
  for (int alias = -20; alias <= 20; ++alias) {
    const double Omega = 2 * std::numbers::pi * std::abs(f + alias / dt) / Va, x = L * Omega;
    const double form = axis == 0 ? 2 / (1 + x * x) : (1 + 3 * x * x) / ((1 + x * x) * (1 + x * x));
    sum += sigma * sigma * L / std::numbers::pi * form;
  }
  return sum * 2 * std::numbers::pi / Va;
}

/// Expected result of Welch's method for a process of this density, leakage and aliases included: the
/// transform of its autocorrelation times that of the window. The autocorrelation is the Fourier transform of
/// `book`: sigma^2 e^-x along, sigma^2 e^-x (1 - x / 2) across, with x = Va tau / L.
std::vector<double> expected_of_welch(int axis, double L, double sigma, double dt, std::size_t n) {
  std::vector<double> window(n);
  for (std::size_t i = 0; i < n; ++i)
    window[i] = std::pow(std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)), 2);
  std::vector<std::complex<double>> r(n);
  double power = 0;
  for (std::size_t m = 0; m < n; ++m) {
    double overlap = 0;
    for (std::size_t i = m; i < n; ++i) overlap += window[i] * window[i - m];
    if (m == 0) power = overlap;
    const double x = Va * static_cast<double>(m) * dt / L;
    r[m] = overlap / power * sigma * sigma * std::exp(-x) * (axis == 0 ? 1 : 1 - 0.5 * x);
  }
  const double at_zero = r[0].real();
  fourier(r);
  std::vector<double> density(n / 2);
  for (std::size_t k = 0; k < n / 2; ++k) density[k] = 2 * dt * (2 * r[k].real() - at_zero);
  return density;
}

struct Height {
  double m;
  double L_u, L_w, sigma_u, sigma_w;  ///< by hand, moderate
};
/// 20 m = 65.62 ft: k = 0.177 + 0.000823 h = 0.23100; 150 m = 492.1 ft: k = 0.58202; 700 m = 2297 ft: figure
/// 7 between 9.6 ft/s at 1750 ft and 10.6 at 3750.
constexpr Height heights[] = {{20, 116.062, 20, 2.77340, 1.54333},
                              {150, 287.188, 150, 1.91639, 1.54333},
                              {700, 533.4, 533.4, 3.00938, 3.00938}};

}  // namespace

TEST_CASE("lengths and deviations over the height are those of MIL-F-8785C") {
  for (const Height& h : heights) {
    const DrydenScales s = dryden_scales_at(Turbulence::moderate, h.m);
    CHECK(s.length.x() == Approx(h.L_u).epsilon(1e-4));
    CHECK(s.length.y() == Approx(h.L_u).epsilon(1e-4));
    CHECK(s.length.z() == Approx(h.L_w).epsilon(1e-4));
    CHECK(s.sigma.x() == Approx(h.sigma_u).epsilon(1e-4));
    CHECK(s.sigma.y() == Approx(h.sigma_u).epsilon(1e-4));
    CHECK(s.sigma.z() == Approx(h.sigma_w).epsilon(1e-4));
  }
  // 15, 30, 45 knots at 20 ft
  CHECK(dryden_scales_at(Turbulence::light, 100).sigma.z() == Approx(0.77167).epsilon(1e-4));
  CHECK(dryden_scales_at(Turbulence::severe, 100).sigma.z() == Approx(2.3150).epsilon(1e-4));
  CHECK(dryden_scales_at(Turbulence::light, 100, 5).sigma.z() == Approx(0.5).epsilon(1e-9));
  CHECK(dryden_scales_at(Turbulence::none, 100, 5).sigma.norm() == 0);
}

TEST_CASE("turbulence over the height has no step, and ends at 10 ft and at the top of the figure") {
  for (const Turbulence t : {Turbulence::light, Turbulence::moderate, Turbulence::severe}) {
    DrydenScales before = dryden_scales_at(t, 0);
    double sigma_step = 0, length_step = 0;
    for (double h = 0; h < 9000; h += 0.5) {
      const DrydenScales s = dryden_scales_at(t, h);
      sigma_step = std::max(sigma_step, (s.sigma - before.sigma).norm() / before.sigma.norm());
      length_step = std::max(length_step, (s.length - before.length).norm());
      before = s;
    }
    CHECK(sigma_step < 0.01);
    CHECK(length_step < 6);
    CHECK(dryden_scales_at(t, -5).length == dryden_scales_at(t, 3).length);
    CHECK(dryden_scales_at(t, 3.048).length.z() == Approx(3.048));
    CHECK(dryden_scales_at(t, 9000).sigma == dryden_scales_at(t, 7620).sigma);
    // 1000 ft: all lengths are 1000 ft, and all standard deviations are equal
    const DrydenScales top = dryden_scales_at(t, 1000 * ft);
    CHECK(top.length.isApprox(Vector3d::Constant(1000 * ft), 1e-9));
    CHECK(top.sigma.isApprox(Vector3d::Constant(top.sigma.z()), 1e-9));
    // half-way between the models
    const DrydenScales half = dryden_scales_at(t, 1500 * ft), base = dryden_scales_at(t, 2000 * ft);
    CHECK(half.length.x() == Approx(1375 * ft));
    CHECK(half.sigma.x() == Approx(0.5 * (top.sigma.x() + base.sigma.x())));
  }
  // figure 7 at 7500 ft, ft/s
  CHECK(dryden_scales_at(Turbulence::light, 7500 * ft).sigma.x() / ft == Approx(6.7));
  CHECK(dryden_scales_at(Turbulence::severe, 7500 * ft).sigma.x() / ft == Approx(23.6));
}

TEST_CASE("spectra and deviations at three heights are those of MIL-F-8785C" *
          doctest::test_suite("amounts")) {
  const bool whole = std::getenv("FULMAR_LONG") != nullptr;
  const double near = whole ? 0.02 : 0.05;
  std::uint64_t seed = 11;
  for (const Height& h : heights) {
    Dryden dryden(dryden_scales(Turbulence::moderate), seed++);
    dryden.set_scales(dryden_scales_at(Turbulence::moderate, h.m));
    for (const double dt : {0.5, 0.02}) {  // low and high frequencies
      constexpr std::size_t n = 1024;
      const auto density = welch(dryden, dt, n, whole ? 8000 : 700);
      for (int axis = 0; axis < 3; ++axis) {
        const double L = axis < 2 ? h.L_u : h.L_w, sigma = axis < 2 ? h.sigma_u : h.sigma_w;
        const std::vector<double> of_welch = expected_of_welch(axis, L, sigma, dt, n);
        // far above the corner the leakage is small, and the method gives the density itself
        CHECK(of_welch[300] / book(axis, L, sigma, 300 / (n * dt), dt) == Approx(1).epsilon(0.005));
        for (const auto& [from, to] : {std::pair{4, 12}, {12, 40}, {40, 120}, {120, 400}}) {
          double measured = 0, expected = 0;
          for (int k = from; k < to; ++k) {
            measured += density[std::size_t(axis)][std::size_t(k)];
            expected += of_welch[std::size_t(k)];
          }
          CAPTURE(h.m);
          CAPTURE(axis);
          const double lowest_hz = from / (n * dt);
          CAPTURE(lowest_hz);
          CHECK(measured / expected == Approx(1).epsilon(near));
        }
      }
    }
    Vector3d sum = Vector3d::Zero();
    const int samples = whole ? 2000000 : 200000;
    for (int i = 0; i < samples; ++i) sum += dryden.advance(5, Va).cwiseAbs2();
    const Vector3d sigma = (sum / samples).cwiseSqrt();
    CHECK(sigma.x() / h.sigma_u == Approx(1).epsilon(near));
    CHECK(sigma.y() / h.sigma_u == Approx(1).epsilon(near));
    CHECK(sigma.z() / h.sigma_w == Approx(1).epsilon(near));
  }
}

}  // namespace dryden_height_test
