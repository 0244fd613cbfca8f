// SPDX-License-Identifier: BSD-3-Clause
// Measurement of a loop with a known transfer function, and the gains that are chosen from it.
#include <doctest/doctest.h>

#include <fulmar/random.hpp>
#include <vector>

#include "plugins/control_slc/rate_fit.hpp"

namespace loop_lines_test {

using namespace fulmar;
using namespace fulmar::slc;

namespace {

constexpr double T = 0.01, degree = std::numbers::pi / 180;
constexpr double lag = 12, power = 40;  // of the axis: rate = power / (s + lag), held and late by one step

/// An axis of known transfer function under the law, with its excitation and record.
struct Axis {
  AxisGains gains{1.5, 0.4, 0.05};
  double noise = 0;             ///< of the surface, white through a lag of 0.3 s: its deviation, rad
  double sign = 1, passes = 1;  ///< of the surface's commands
  Random random{1};
  LoopRecord fly() {
    LoopLines lines;
    double angle = 0, rate = 0, integral = 0, before = 0, disturbance = 0;
    const double keep = std::exp(-lag * T), calm = std::exp(-T / 0.3);
    for (int k = 0; k <= 1200; ++k) {
      const double e = 0.1 * lines.at(T * k);
      integral += gains.ki * -angle * T;
      const double feedback = -gains.kp * angle - gains.kd * rate + integral, total = feedback + e;
      if (k == 200) lines.begin();
      if (k == 1200) lines.close(feedback, total, angle, rate);
      if (k >= 200 && k < 1200) lines.add(feedback, total, angle, rate, 1, false, T);
      disturbance = calm * disturbance + std::sqrt(1 - calm * calm) * noise * random.normal();
      const double u = passes * before + disturbance;
      const double next = keep * rate + (1 - keep) / lag * power * sign * u;
      angle += T * (rate + next) / 2;  // of the trapezoid, as the fit takes it
      rate = next;
      before = total;
    }
    return lines.record();
  }
  /// The closed form of the same difference equations.
  static Complex rate(double w) {
    const Complex back = std::polar(1.0, -w * T);
    const double keep = std::exp(-lag * T);
    return (1 - keep) / lag * power * back * back / (1.0 - keep * back);
  }
  static Complex attitude(double w) {
    const Complex back = std::polar(1.0, -w * T);
    return rate(w) * (T / 2) * (1.0 + back) / (1.0 - back);
  }
  static Complex loop(double w, const AxisGains& g) {
    return (g.kp + g.ki * T / (1.0 - std::polar(1.0, -w * T))) * attitude(w) + g.kd * rate(w);
  }
};

/// Margins on a grid two hundred times as fine.
Margins exact(const AxisGains& g) {
  std::vector<LoopSample> all;
  for (double w = 0.3; w < 300; w *= 1.002) all.push_back({w, Axis::loop(w, g)});
  return fulmar::margins_of(all);
}

LoopRecord fitted(const LoopRecord& r, const AxisGains& g, double* misfit = nullptr) {
  RateFit fit;
  fit.begin(r, g, false);
  while (!fit.step()) {
  }
  if (misfit) *misfit = fit.misfit();
  return fit.record();
}
AxisGains searched(const LoopRecord& r, const AxisGains& from, const MarginsWanted& wanted) {
  GainSearch search;
  search.begin(r, from, wanted);
  while (!search.step()) {
  }
  REQUIRE(search.found());
  return search.best();
}

}  // namespace

TEST_CASE("without noise the loop and the responses are those of the closed form") {
  Axis axis;
  const LoopRecord r = axis.fly(), f = fitted(r, axis.gains);
  CHECK(r.step_s == doctest::Approx(T));
  CHECK(r.limited == 0);
  for (std::size_t i = 0; i < Lines::count; ++i) {
    const double w = Lines::radps(i);
    CAPTURE(w);
    CHECK(std::abs(r.loop[i] / Axis::loop(w, axis.gains) - 1.0) < 0.01);
    CHECK(std::abs(r.rate[i] / Axis::rate(w) - 1.0) < 0.01);
    CHECK(std::abs(r.attitude[i] / Axis::attitude(w) - 1.0) < 0.06);  // of the slow integral's decay
    CHECK(std::abs(f.loop[i] / Axis::loop(w, axis.gains) - 1.0) < 0.02);
    CHECK(r.noise[i] < 0.02);
    const AxisGains other{0.7, 1.2, 0.2};
    CHECK(std::abs(loop_with(r, axis.gains, other)[i] / Axis::loop(w, other) - 1.0) < 0.02);
  }
  const Margins measured = slc::margins_of(r.loop), true_ones = exact(axis.gains);
  CHECK(std::abs(measured.phase_rad - true_ones.phase_rad) < 2 * degree);
  CHECK(std::abs(measured.crossover_radps / true_ones.crossover_radps - 1) < 0.03);
}

TEST_CASE("the excitation has size 1, is periodic and ends where it began") {
  LoopLines lines;
  double most = 0, sum = 0;
  for (int k = 0; k < 500; ++k) {
    const double x = lines.at(T * k);
    most = std::max(most, std::abs(x));
    sum += x * x;
    CHECK(std::abs(x - lines.at(T * k + Lines::record_s / 2)) < 1e-9);
  }
  CHECK(most < 1.02);
  CHECK(most > 0.9);
  CHECK(std::sqrt(sum / 500) > 0.5);  // a peak below twice the root mean square
}

TEST_CASE("a drift over the record leaks into no line") {
  LoopLines lines;
  lines.begin();
  for (int k = 0; k <= 1000; ++k) {
    const double e = 0.1 * lines.at(T * k), back = 0.5 * lines.at(T * k - 0.02) * 0.1;
    lines.at(T * k);
    const double drift = 0.3 + 0.02 * T * k;
    if (k < 1000)
      lines.add(drift - back, e + drift - back, 0, e, 1, k % 10 == 0, T);
    else
      lines.close(drift - back, e + drift - back, 0, e);
  }
  const LoopRecord r = lines.record();
  CHECK(std::abs(r.limited - 0.1) < 1e-9);
  for (std::size_t i = 0; i < Lines::count; ++i) {
    const Complex closed = -0.5 * std::polar(1.0, -0.02 * Lines::radps(i));  // u_fb / e
    CHECK(std::abs(r.loop[i] + closed / (1.0 + closed)) < 1e-3);
    CHECK(r.noise[i] < 1e-3);
  }
}

TEST_CASE("beyond the last line the gain margin is no more than what is left there") {
  std::array<Complex, Lines::count> loop;
  constexpr double K = 5;
  for (std::size_t i = 0; i < Lines::count; ++i) loop[i] = K / Complex(0, Lines::radps(i));  // an integrator
  const Margins m = slc::margins_of(loop);
  CHECK(std::abs(m.phase_rad - 90 * degree) < 0.1 * degree);
  CHECK(std::abs(m.gain_db - 20 * std::log10(Lines::radps(Lines::count - 1) / K)) < 1e-6);
}

TEST_CASE("noise is told as large as it is, the estimate has no bias to speak of, the fit takes most of it" *
          doctest::test_suite("amounts")) {
  Axis axis;
  axis.noise = 0.01;
  constexpr int flights = 60;
  std::array<Complex, Lines::count> mean{};
  double reported = 0, was = 0, after = 0, max_bias = 0, misfits = 0;
  for (int k = 0; k < flights; ++k) {
    const LoopRecord r = axis.fly();
    double misfit = 0;
    const LoopRecord f = fitted(r, axis.gains, &misfit);
    misfits += misfit / flights;
    for (std::size_t i = 0; i < Lines::count; ++i) {
      const Complex exact_loop = Axis::loop(Lines::radps(i), axis.gains);
      mean[i] += f.loop[i] / exact_loop / double(flights);
      reported += r.noise[i] * r.noise[i];
      was += std::norm((r.loop[i] - exact_loop) / (1.0 + exact_loop));
      after += std::norm((f.loop[i] - exact_loop) / (1.0 + exact_loop));
    }
  }
  for (std::size_t i = 0; i < Lines::count; ++i) max_bias = std::max(max_bias, std::abs(mean[i] - 1.0));
  CAPTURE(std::sqrt(was / flights / Lines::count));
  CHECK(std::sqrt(reported / was) > 0.6);
  CHECK(std::sqrt(reported / was) < 1.7);
  CHECK(after < was / 2.5);
  CHECK(max_bias < 0.08);
  CHECK(misfits > 0.1);
  CHECK(misfits < 2);
}

TEST_CASE("an axis that answers stands out of the noise, and one that does not never does") {
  const LoopRecord calm = Axis{}.fly();
  CHECK(calm.answer > 1000);
  double sum = 0, most = 0;
  constexpr int flights = 100;
  for (int k = 0; k < flights; ++k) {
    Axis stuck;
    stuck.noise = 0.02;
    stuck.random = Random(static_cast<std::uint64_t>(k + 1));
    stuck.passes = 0;
    const double answer = stuck.fly().answer;
    sum += answer;
    most = std::max(most, answer);
  }
  CHECK(std::abs(sum / flights - 1) < 0.3);
  CHECK(most < 2.5);
  Axis noisy;
  noisy.noise = 0.02;
  CHECK(noisy.fly().answer > 10);
}

TEST_CASE("an axis that no fit describes stays as it was measured") {
  Axis axis;
  LoopRecord r = axis.fly();
  for (std::size_t i = 0; i < Lines::count; ++i) {
    r.noise[i] = 0.01;
    r.rate[i] *= i % 2 == 0 ? 2 : 0.5;  // a comb
  }
  double misfit = 0;
  const LoopRecord f = fitted(r, axis.gains, &misfit);
  CHECK(misfit > RateFit::max_misfit);
  for (std::size_t i = 0; i < Lines::count; ++i) CHECK(f.loop[i] == r.loop[i]);
}

TEST_CASE("what the law feeds back beside attitude and rate stays in the loop") {
  Axis axis;
  LoopRecord r = axis.fly();
  for (Complex& gain : r.loop) gain += Complex(0.3, 0.1);
  RateFit fit;
  fit.begin(r, axis.gains, true);
  while (!fit.step()) {
  }
  const LoopRecord f = fit.record();
  for (std::size_t i = 0; i < Lines::count; ++i)
    CHECK(std::abs(f.loop[i] - Axis::loop(Lines::radps(i), axis.gains) - Complex(0.3, 0.1)) < 0.05);
}

TEST_CASE(
    "the gains found have the margins in the closed form, no more would, and the start does not matter") {
  const MarginsWanted wanted{8, 55 * degree, 0.05};
  double kp_half = 0;
  for (const double factor : {0.5, 1.0, 2.0}) {
    Axis axis;
    axis.gains = {3 * factor, 0.8 * factor, 0.1 * factor};
    const AxisGains best = searched(axis.fly(), axis.gains, wanted);
    CAPTURE(factor);
    CAPTURE(best.kp);
    const Margins m = exact(best), more = exact({1.3 * best.kp, 1.3 * best.ki, 1.3 * best.kd});
    CHECK(m.min_gain_db() > 8);
    CHECK(m.phase_rad > 53.5 * degree);
    CHECK(m.delay_s > 0.047);
    CHECK_FALSE((more.phase_rad > 57 * degree && more.delay_s > 0.052));
    CHECK(std::abs(best.ki / best.kp - 0.4 / 1.5) < 1e-9);
    CHECK(best.kd / best.kp < 2.01 * 0.05 / 1.5);
    CHECK(best.kd / best.kp > 0.49 * 0.05 / 1.5);
    if (factor == 0.5) kp_half = best.kp;
    CHECK(best.kp / kp_half > 0.85);
    CHECK(best.kp / kp_half < 1.18);
  }
}

TEST_CASE("each wanted margin binds: without it the gains are higher") {
  Axis axis;
  const LoopRecord r = axis.fly();
  const double phase = searched(r, axis.gains, {3, 70 * degree, 0}).kp,
               delay = searched(r, axis.gains, {3, 40 * degree, 0.12}).kp,
               gain = searched(r, axis.gains, {18, 40 * degree, 0}).kp,
               free = searched(r, axis.gains, {3, 40 * degree, 0}).kp;
  CHECK(phase < 0.9 * free);
  CHECK(delay < 0.9 * free);
  CHECK(gain < 0.9 * free);
}

TEST_CASE("a damper gets the gain whose loop is nearest to 1.25 at its peak, or what the margins leave") {
  LoopRecord r;
  for (std::size_t i = 0; i < Lines::count; ++i) {
    const Complex s(0, Lines::radps(i));
    r.rate[i] = s * 5.0 / (s * s + 2.0 * 0.25 * 6.0 * s + 36.0);  // peak 5 / 3 at 6 rad/s
    r.loop[i] = 0.3 * r.rate[i] * std::exp(-0.02 * s);
  }
  const AxisGains from{0, 0, 0.3}, best = searched(r, from, {});
  CHECK(std::abs(best.kd / (1.25 * 3 / 5) - 1) < 0.08);
  CHECK(best.kp == 0);
  CHECK(searched(r, from, {28, 0.96, 0}).kd < 0.7 * best.kd);
}

TEST_CASE("an axis that leaves no margin at all has no gains") {
  LoopRecord r;
  for (std::size_t i = 0; i < Lines::count; ++i) {
    r.loop[i] = -20.0;
    r.rate[i] = -1.0;
    r.attitude[i] = 0;
  }
  GainSearch search;
  search.begin(r, {0, 0, 0.3}, {});
  while (!search.step()) {
  }
  CHECK_FALSE(search.found());
}

TEST_CASE("the noise that counts is that of the lines near |L| = 1, or of the highest") {
  LoopRecord r;
  for (std::size_t i = 0; i < Lines::count; ++i) {
    r.loop[i] = 50;
    r.noise[i] = 0.9;
  }
  r.loop[7] = 1;
  r.noise[7] = 0.1;
  r.loop[8] = 0.01;
  CHECK(std::abs(noise_of(r) - 0.1) < 1e-12);
  for (std::size_t i = 0; i < Lines::count; ++i) r.loop[i] = 0.001;
  r.loop[7] = 0.05;  // a weak damper
  CHECK(std::abs(noise_of(r) - 0.1) < 1e-12);
  r.loop.fill(50);
  CHECK(noise_of(r) > 1e6);  // no line of the margins was measured
}

}  // namespace loop_lines_test
