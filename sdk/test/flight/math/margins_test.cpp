// SPDX-License-Identifier: BSD-3-Clause
// Margins against closed forms: Åström & Murray, Feedback Systems (2008), chapter 9.
#include <doctest/doctest.h>

#include <fulmar/flight/math/margins.hpp>
#include <vector>

namespace margins_test {

using namespace fulmar;
using doctest::Approx;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

namespace {
template <class L>
Margins of(L&& gain, double first = 1e-3, double last = 1e3, int n = 2000) {
  std::vector<LoopSample> samples;
  for (int i = 0; i < n; ++i) {
    const double w = first * std::pow(last / first, i / (n - 1.0));
    samples.push_back({w, gain(Complex(0, w))});
  }
  return margins_of(samples);
}
}  // namespace

TEST_CASE("an integrator with a delay: all three margins in closed form") {
  const double k = 2, tau = 0.1;  // L = k exp(-s tau)/s
  const Margins m = of([&](Complex s) { return k * std::exp(-s * tau) / s; });
  CHECK(m.crossover_radps == Approx(k).epsilon(1e-4).scale(0));
  CHECK(m.phase_rad == Approx(pi / 2 - k * tau).epsilon(1e-4).scale(0));
  CHECK(m.delay_s == Approx((pi / 2 - k * tau) / k).epsilon(1e-4).scale(0));
  CHECK(m.gain_db == Approx(20 * std::log10(pi / (2 * k * tau))).epsilon(1e-3).scale(0));
  CHECK(m.reduction_db == Margins::none);
  CHECK(m.min_gain_db() == m.gain_db);
}

TEST_CASE("three equal lags: the gain may grow to 8") {
  const Margins m = of([](Complex s) { return 4.0 / std::pow(1.0 + s, 3); });
  CHECK(m.gain_db == Approx(20 * std::log10(2.0)).epsilon(1e-3).scale(0));
  const double w = std::sqrt(std::pow(4, 2.0 / 3) - 1);
  CHECK(m.crossover_radps == Approx(w).epsilon(1e-4).scale(0));
  CHECK(m.phase_rad == Approx(pi - 3 * std::atan(w)).epsilon(1e-3).scale(0));
}

TEST_CASE("what the loop keeps stable asks for gain: it may fall by so much only") {
  // an unstable pair with rate feedback: s^2 - 0.4 s + 1 + k s, stable from k = 0.4 on
  const Margins pair = of([](Complex s) { return 1.2 * s / (s * s - 0.4 * s + 1.0); });
  CHECK(pair.reduction_db == Approx(20 * std::log10(3.0)).epsilon(2e-3).scale(0));
  CHECK(pair.gain_db == Margins::none);
  CHECK(pair.min_gain_db() == pair.reduction_db);
}

TEST_CASE("the phase margin is the least of all crossovers, whether by lag or by lead") {
  // a resonance above the crossover: |L| is 1 three times
  const auto loop = [](Complex s) {
    return 1.0 / s + 0.3 * s / (s * s + 0.2 * s + 25.0) * 5.0 * std::exp(-s * 0.5);
  };
  const Margins m = of(loop, 1e-2, 1e2, 20000);
  double least = 10, highest = 0;
  double before = 10;
  for (double w = 0.5; w < 20; w += 1e-4) {  // by brute force
    const Complex L = loop(Complex(0, w));
    if ((std::abs(L) < 1) != (before < 1)) {
      least = std::min(least, pi - std::abs(std::arg(L)));
      highest = w;
    }
    before = std::abs(L);
  }
  CHECK(highest > 4);
  CHECK(m.phase_rad == Approx(least).epsilon(5e-3).scale(0));
  CHECK(m.crossover_radps == Approx(highest).epsilon(1e-3).scale(0));
}

TEST_CASE("a loop that is never 1 has no phase margin to lose") {
  const Margins m = of([](Complex s) { return 0.5 / (1.0 + s); });
  CHECK(m.phase_rad == Margins::none);
  CHECK(m.delay_s == Margins::none);
  CHECK(m.crossover_radps == 0);
  CHECK(margins_of({}).gain_db == Margins::none);
}

TEST_CASE("poles of the closed loop are counted, delays included") {
  const auto closed = [](double k, double tau) {
    return unstable_poles([&](Complex s) { return 1.0 + k * std::exp(-s * tau) / s; }, 0, 1e-3, 1e4);
  };
  CHECK(closed(2, 0.1) == 0);
  CHECK(closed(pi / 0.2 * 0.97, 0.1) == 0);  // the limit is pi/(2 tau)
  CHECK(closed(pi / 0.2 * 1.03, 0.1) == 2);
  CHECK(closed(-1, 0.1) == 1);  // positive feedback
  // one pole of the open loop at +1: 1 + k/(s - 1)
  const auto held = [](double k) {
    return unstable_poles([&](Complex s) { return 1.0 + k / (s - 1.0); }, 1, 1e-3, 1e4);
  };
  CHECK(held(0.9) == 1);
  CHECK(held(1.1) == 0);
  // an unstable sharp resonance: s^2 - 0.002 s + 9
  CHECK(unstable_poles([](Complex s) { return 1.0 + 0.02 * s / (s * s - 0.01 * s + 9.0); }, 2, 1e-3, 1e3) ==
        0);
  CHECK(unstable_poles([](Complex s) { return 1.0 + 0.002 * s / (s * s - 0.01 * s + 9.0); }, 2, 1e-3, 1e3) ==
        2);
}

}  // namespace margins_test
