// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/earth/dryden.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <numbers>
#include <vector>

namespace dryden_test {

using namespace fulmar;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

std::vector<Vector3d> gusts(std::uint64_t seed, double dt, double Va, std::size_t n) {
  Dryden dryden(dryden_scales(Turbulence::moderate), seed);
  std::vector<Vector3d> out;
  for (std::size_t i = 0; i < n; ++i) out.push_back(dryden.advance(dt, Va));
  return out;
}

/// Spectral density of component `axis` at `f` Hz (one-sided), averaged over segments with a Hann window.
double density(const std::vector<Vector3d>& g, int axis, double dt, double f, std::size_t segment) {
  double sum = 0, window = 0;
  int count = 0;
  for (std::size_t i = 0; i < segment; ++i)
    window += std::pow(std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(segment)), 4);
  for (std::size_t begin = 0; begin + segment <= g.size(); begin += segment / 2, ++count) {
    std::complex<double> s = 0;
    for (std::size_t i = 0; i < segment; ++i) {
      const double t = static_cast<double>(i),
                   w = std::pow(std::sin(std::numbers::pi * t / static_cast<double>(segment)), 2);
      s += w * g[begin + i](axis) * std::polar(1.0, -2 * std::numbers::pi * f * dt * t);
    }
    sum += 2 * dt * std::norm(s) / window;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("the gusts have the deviations of the table" * doctest::test_suite("amounts")) {
  CHECK(dryden_scales(Turbulence::light).sigma.isApprox(Vector3d(1.06, 1.06, 0.7)));
  CHECK(dryden_scales(Turbulence::moderate).sigma.isApprox(Vector3d(2.12, 2.12, 1.4)));
  Vector3d sum = Vector3d::Zero();
  std::size_t n = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const Vector3d& g : gusts(seed, 0.1, 17, 40000)) {
      sum += g.cwiseAbs2();
      ++n;
    }
  const Vector3d sigma = (sum / static_cast<double>(n)).cwiseSqrt();
  CHECK(sigma.x() == Approx(2.12).epsilon(0.03));
  CHECK(sigma.y() == Approx(2.12).epsilon(0.03));
  CHECK(sigma.z() == Approx(1.4).epsilon(0.03));
}

TEST_CASE("the deviation does not depend on the step and survives a changing airspeed" *
          doctest::test_suite("amounts")) {
  Vector3d sum = Vector3d::Zero();
  std::size_t n = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Dryden dryden(dryden_scales(Turbulence::light), seed);
    for (int i = 0; i < 200000; ++i, ++n)
      sum += dryden.advance(0.0025, 15 + 10 * std::sin(0.001 * i)).cwiseAbs2();
  }
  const Vector3d sigma = (sum / static_cast<double>(n)).cwiseSqrt();
  CHECK(sigma.x() == Approx(1.06).epsilon(0.08));
  CHECK(sigma.y() == Approx(1.06).epsilon(0.08));
  CHECK(sigma.z() == Approx(0.7).epsilon(0.08));
}

TEST_CASE("the spectra are those of MIL-F-8785C" * doctest::test_suite("amounts")) {
  const double dt = 0.05, Va = 17, two_pi = 2 * std::numbers::pi;
  const auto g = gusts(3, dt, Va, 400000);
  for (double f : {0.05, 0.2, 1.0}) {
    // one-sided, per Hz, from the spatial densities: sigma^2 2L/(pi V) 1/(1+(L w/V)^2) and sigma^2 L/(pi V)
    // (1+3(L w/V)^2)/(1+(L w/V)^2)^2 per rad/s
    const double u = 200 * two_pi * f / Va, w = 50 * two_pi * f / Va;
    const double longitudinal = two_pi * 2.12 * 2.12 * 2 * 200 / (std::numbers::pi * Va) / (1 + u * u);
    const double lateral =
        two_pi * 2.12 * 2.12 * 200 / (std::numbers::pi * Va) * (1 + 3 * u * u) / std::pow(1 + u * u, 2);
    const double vertical =
        two_pi * 1.4 * 1.4 * 50 / (std::numbers::pi * Va) * (1 + 3 * w * w) / std::pow(1 + w * w, 2);
    CHECK(density(g, 0, dt, f, 4000) == Approx(longitudinal).epsilon(0.25).scale(0));
    CHECK(density(g, 1, dt, f, 4000) == Approx(lateral).epsilon(0.25).scale(0));
    CHECK(density(g, 2, dt, f, 4000) == Approx(vertical).epsilon(0.25).scale(0));
  }
}

TEST_CASE("the first gust is as strong as all others, and air that an aircraft stands in moves, too") {
  Vector3d sum = Vector3d::Zero();
  constexpr int seeds = 20000;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    sum += Dryden(dryden_scales(Turbulence::light), seed).gust().cwiseAbs2();
  const Vector3d sigma = (sum / seeds).cwiseSqrt();
  CHECK(sigma.x() == Approx(1.06).epsilon(0.02));
  CHECK(sigma.y() == Approx(1.06).epsilon(0.02));
  CHECK(sigma.z() / 0.7 == Approx(1).epsilon(0.02));
  Dryden standing(dryden_scales(Turbulence::light), 4), taxiing(dryden_scales(Turbulence::light), 4);
  for (int i = 0; i < 100; ++i) CHECK(standing.advance(0.01, 0) == taxiing.advance(0.01, 5));
  Dryden faster(dryden_scales(Turbulence::light), 4);
  CHECK(standing.gust() != faster.advance(0.01, 6));
}

TEST_CASE("calm air has no gusts, and one seed always the same") {
  Dryden calm(dryden_scales(Turbulence::none), 1);
  CHECK(calm.advance(0.0025, 17) == Vector3d::Zero());
  CHECK(gusts(5, 0.0025, 17, 100) == gusts(5, 0.0025, 17, 100));
  CHECK(gusts(5, 0.0025, 17, 100) != gusts(6, 0.0025, 17, 100));
}

}  // namespace dryden_test
