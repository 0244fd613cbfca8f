// SPDX-License-Identifier: BSD-3-Clause
// Signals of identification flights, as functions of time of size 1. The README gives the equations.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "fulmar/plugin.hpp"

namespace fulmar::signal {

enum class Shape : std::uint8_t { none, step, doublet, square, sine, chirp, d3211, multisine };

struct SignalParams {
  Choice<Shape> shape{Shape::none, "shape of the signal; a change of shape, channel or a size restarts it"};
  Param delay{1, "s", 0, 600, "time from the request to the start of the signal"};
  Param duration{4, "s", 0.02, 600,
                 "duration of the signal; square and sine: the whole periods in it, at least one"};
  Param frequency{0.5, "Hz", 0.005, 50,
                  "frequency of square and sine; start of a chirp; lowest frequency of a multisine"};
  Param frequency_end{3, "Hz", 0.005, 50, "end frequency of a chirp; highest frequency of a multisine"};
  Count every{
      1, 1, 64,
      "step between the harmonics of 1 / duration in a multisine; other signals may use those between"};
  Count run{0, 0, 1000000, "number of the run; a change repeats the signal"};
};

/// One signal. `at` is within -1 and 1, and exactly 0 before 0 s and from end_s() on.
class Waveform {
 public:
  static constexpr int max_harmonics = 64;

  Waveform() = default;
  explicit Waveform(const SignalParams& p)
      : shape_(p.shape), end_s_(p.duration), f0_(p.frequency), f1_(p.frequency_end) {
    if (shape_ == Shape::none) end_s_ = 0;
    if (shape_ == Shape::square || shape_ == Shape::sine)
      end_s_ = std::max(1.0, std::floor(p.duration * f0_ + rounding)) / f0_;
    if (shape_ == Shape::multisine) set_harmonics(p.every);
  }

  Shape shape() const { return shape_; }
  double end_s() const { return end_s_; }
  int harmonics() const { return count_; }
  /// Frequency of the i-th harmonic, Hz.
  double harmonic(int i) const { return (first_ + i * stride_) / end_s_; }

  double at(double t) const {
    if (t < -rounding || t >= end_s_ - rounding) return 0;
    constexpr double turn = 2 * std::numbers::pi;
    switch (shape_) {
      case Shape::none: return 0;
      case Shape::step: return 1;
      case Shape::doublet: return part(t, end_s_ / 2) == 0 ? 1 : -1;
      case Shape::square: return part(t, 0.5 / f0_) % 2 == 0 ? 1 : -1;
      case Shape::sine: return std::sin(turn * f0_ * t);
      case Shape::chirp: return fade(t) * std::sin(chirp_phase(t));
      case Shape::d3211: {
        const int unit = part(t, end_s_ / 7);  // durations of the four levels: three, two, one, one units
        return unit < 3 || unit == 5 ? 1 : -1;
      }
      case Shape::multisine: return std::clamp(sum(t + zero_s_) / peak_, -1.0, 1.0);
    }
    return 0;
  }

  /// Phase of a chirp, rad: its derivative is 2 pi f0 (f1 / f0)^(t / T), the logarithmic sweep.
  double chirp_phase(double t) const {
    constexpr double turn = 2 * std::numbers::pi;
    const double octaves = std::log(f1_ / f0_);
    if (std::abs(octaves) < 1e-9) return turn * f0_ * t;
    return turn * f0_ * end_s_ / octaves * std::expm1(octaves * t / end_s_);
  }

 private:
  static constexpr double rounding = 1e-7;  // s: a tick on an edge counts as behind it
  static constexpr int max_points = 2048;
  static constexpr double faded = 0.05;  // faded share of a chirp, at either end

  static int part(double t, double length) { return static_cast<int>((t + rounding) / length); }
  double fade(double t) const {
    const double from_end = std::min(t, end_s_ - t) / (faded * end_s_);
    return from_end >= 1 ? 1 : 0.5 * (1 - std::cos(std::numbers::pi * from_end));
  }

  double sum(double t) const {
    double s = 0;
    for (int i = 0; i < count_; ++i)
      s += std::cos(2 * std::numbers::pi * harmonic(i) * t + phase_[static_cast<std::size_t>(i)]);
    return s;
  }

  /// Harmonics k / T, with the phases of Schroeder (1970) for equal amplitudes, which keep the peak low. The
  /// signal begins at a zero of the sum, as in Morelli (2003), so that it also ends at one.
  void set_harmonics(std::int64_t every) {
    const double T = end_s_, low = std::min(f0_, f1_), high = std::max(f0_, f1_);
    first_ = std::max(1, static_cast<int>(std::ceil(low * T - rounding)));
    const int last = std::max(first_, static_cast<int>(std::floor(high * T + rounding)));
    const int all = (last - first_) / static_cast<int>(every) + 1;
    stride_ = static_cast<int>(every) * ((all + max_harmonics - 1) / max_harmonics);
    count_ = (last - first_) / stride_ + 1;
    for (int i = 0; i < count_; ++i)
      phase_[static_cast<std::size_t>(i)] = -std::numbers::pi * i * (i + 1) / count_;
    find_peak_and_zero(std::clamp(24 * last, 128, max_points));
  }

  /// The recursion cos(a + b) = 2 cos(a) cos(b) - cos(a - b) keeps the time of a step short.
  void find_peak_and_zero(int points) {
    std::array<double, max_points + 1> s{};
    const double dt = end_s_ / points;
    for (int i = 0; i < count_; ++i) {
      const double by = 2 * std::numbers::pi * harmonic(i) * dt, cosine = std::cos(by);
      double now = std::cos(phase_[static_cast<std::size_t>(i)]),
             before = std::cos(phase_[static_cast<std::size_t>(i)] - by);
      for (int m = 0; m <= points; ++m) {
        s[static_cast<std::size_t>(m)] += now;
        before = std::exchange(now, 2 * cosine * now - before);
      }
    }
    int rising = 0;
    for (int m = points; m > 0; --m) {
      const auto at = static_cast<std::size_t>(m);
      peak_ = std::max(peak_, std::abs(s[at]));
      if (s[at - 1] < 0 && s[at] >= 0) rising = m;
    }
    peak_ *= 1.01;  // between the points the sum is at most 1 - cos(pi / 24) higher
    zero_s_ = rising_zero((rising - 1) * dt, rising * dt);
  }
  double rising_zero(double low, double high) const {
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (sum(middle) < 0 ? low : high) = middle;
    }
    return high;
  }

  Shape shape_ = Shape::none;
  double end_s_ = 0, f0_ = 1, f1_ = 1;
  int first_ = 1, stride_ = 1, count_ = 0;  // of the harmonics, in units of 1 / T
  std::array<double, max_harmonics> phase_{};
  double peak_ = 1e-9, zero_s_ = 0;
};

}  // namespace fulmar::signal
