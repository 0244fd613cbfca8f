// SPDX-License-Identifier: BSD-3-Clause
// The frequency response of a closed loop at the lines of a multisine. A periodic excitation e is added to
// the surface: u = u_fb + e. At its lines L = -U_fb / U is the loop broken there, with all others closed, and
// Y / U is the response of the aircraft to the surface. Between the lines there is only turbulence. Pintelon
// & Schoukens, System Identification (2012), sections 2.4, 5.3 (multisines, noise between the lines).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fulmar/flight/math/margins.hpp>
#include <numbers>

namespace fulmar::slc {

using Complex = std::complex<double>;

/// Harmonics of 1 / period, recorded for two periods: bins 2 k of the record are excited, 2 k - 1 and 2 k + 1
/// are not.
struct Lines {
  static constexpr std::size_t count = 15;
  static constexpr std::array<int, count> harmonics{2, 3, 4, 5, 6, 7, 9, 11, 13, 16, 20, 25, 31, 38, 48};
  static constexpr double record_s = 10;

  static constexpr double radps(std::size_t i) { return 2 * std::numbers::pi * 2 * harmonics[i] / record_s; }
  /// The amplitude follows the spectrum of turbulence.
  static double amplitude(std::size_t i) { return std::pow(harmonics[i], -0.6); }
  /// Quadratic phases as those of Schroeder (1970) for equal lines. They give a low peak, 1.9 times the root
  /// mean square. Both constants were found by a search.
  static double phase(std::size_t i) {
    const double k = static_cast<double>(i);
    return -(0.465 * k + 0.8) * k;
  }
};

/// Frequency responses at the lines.
struct LoopRecord {
  std::array<Complex, Lines::count> loop{};      ///< L
  std::array<Complex, Lines::count> attitude{};  ///< rad/rad
  std::array<Complex, Lines::count> rate{};      ///< (rad/s)/rad
  std::array<double, Lines::count> noise{};      ///< relative standard error of 1 + L
  double scale = 1;                              ///< mean scale of the gains in the law
  double step_s = 0.01;                          ///< mean
  double limited = 0;                            ///< share of the record with the surface at its limit
  // mean power of the feedback at the lines over that between them; 1 without a response
  double answer = 0;
};

/// Geometric mean of a line and two on either side: two neighbour bins alone give a poor estimate of a
/// standard deviation.
inline double smoothed(const std::array<double, Lines::count>& deviation, std::size_t i) {
  const std::size_t first = i < 2 ? 0 : i - 2, last = std::min(i + 2, Lines::count - 1);
  double sum = 0;
  for (std::size_t k = first; k <= last; ++k) sum += std::log(std::max(deviation[k], 1e-12));
  return std::exp(sum / static_cast<double>(last - first + 1));
}

/// Excites and records.
class LoopLines {
 public:
  LoopLines() {
    double peak = 1e-9;
    for (int k = 0; k < 2000; ++k) {
      move_to(Lines::record_s / 2 * k / 2000);
      peak = std::max(peak, std::abs(sum()));
    }
    size_ = 1 / peak;
  }

  /// Excitation of size 1 at `t_s` of its period.
  double at(double t_s) {
    move_to(t_s);
    return size_ * sum();
  }
  void begin() {
    sums_ = {};
    drift_ = {};
    samples_ = limited_ = 0;
    scale_ = step_s_ = 0;
  }
  /// Adds a sample at the time of the last `at`. A record is whole periods; `close` takes the sample that
  /// would be next.
  void add(double feedback, double total, double attitude, double rate, double scale, bool limited,
           double step_s) {
    const std::array<double, signals> now{feedback, total, attitude, rate};
    if (samples_ == 0) first_ = now;
    std::array<double, signals> x;
    for (std::size_t j = 0; j < signals; ++j) x[j] = now[j] - first_[j];
    for (std::size_t i = 0; i < Lines::count; ++i) {
      const Complex back = std::conj(at_line_[i]);
      Sums& s = sums_[i];
      for (std::size_t j = 0; j < signals; ++j) s.line[j] += x[j] * back;
      s.below += x[0] * std::conj(at_below_[i]);
      s.above += x[0] * std::conj(at_above_[i]);
    }
    ++samples_;
    limited_ += limited;
    scale_ += scale;
    step_s_ += step_s;
  }
  void close(double feedback, double total, double attitude, double rate) {
    drift_ = {feedback - first_[0], total - first_[1], attitude - first_[2], rate - first_[3]};
  }
  LoopRecord record() const {
    LoopRecord r;
    const double n = std::max(samples_, 1);
    std::array<double, Lines::count> at, off;
    for (std::size_t i = 0; i < Lines::count; ++i) {
      const Sums& s = sums_[i];
      const int bin = 2 * Lines::harmonics[i];
      const Complex feedback = s.line[0] - ramp(0, bin), total = s.line[1] - ramp(1, bin);
      r.loop[i] = -feedback / total;
      r.attitude[i] = (s.line[2] - ramp(2, bin)) / total;
      r.rate[i] = (s.line[3] - ramp(3, bin)) / total;
      // U_fb = -T e + S n and U = S (e + n). To first order the error of 1 + L is n / e, and the bins between
      // the lines hold S n.
      const double between =
          std::sqrt(0.5 * (std::norm(s.below - ramp(0, bin - 1)) + std::norm(s.above - ramp(0, bin + 1))));
      r.noise[i] = between * std::abs(1.0 + r.loop[i]) / std::abs(total - feedback);
      at[i] = std::abs(feedback);
      off[i] = between;
    }
    r.scale = scale_ / n;
    r.step_s = step_s_ / n;
    r.limited = limited_ / n;
    // 1.15: from the geometric mean to the root mean square of two bins of noise.
    for (std::size_t i = 0; i < Lines::count; ++i)
      r.answer += std::pow(at[i] / (1.15 * smoothed(off, i)), 2) / Lines::count;
    return r;
  }

 private:
  using Each = std::array<Complex, Lines::count>;
  static constexpr std::size_t signals = 4;  // feedback, total, attitude, rate
  struct Sums {
    std::array<Complex, signals> line{};
    Complex below, above;  // of the feedback
  };

  /// Part of a bin that comes from a drift of the signal over the record: a periodic signal ends where it
  /// began.
  Complex ramp(std::size_t signal, int bin) const {
    return drift_[signal] / (std::polar(1.0, -2 * std::numbers::pi * bin / std::max(samples_, 2)) - 1.0);
  }

  void move_to(double t_s) {
    const Complex turn = std::polar(1.0, 2 * std::numbers::pi * t_s / Lines::record_s);
    Complex now = 1;
    int at = 0;
    const auto go = [&](int bin) {
      for (; at < bin; ++at)
        now = {now.real() * turn.real() - now.imag() * turn.imag(),
               now.real() * turn.imag() + now.imag() * turn.real()};
      return now;
    };
    for (std::size_t i = 0; i < Lines::count; ++i) {
      at_below_[i] = go(2 * Lines::harmonics[i] - 1);
      at_line_[i] = go(2 * Lines::harmonics[i]);
      at_above_[i] = at_line_[i] * turn;
    }
  }
  double sum() const {
    double s = 0;
    for (std::size_t i = 0; i < Lines::count; ++i) s += (at_line_[i] * phase_[i]).real();
    return s;
  }
  static Each phases() {
    Each p;
    for (std::size_t i = 0; i < Lines::count; ++i) p[i] = std::polar(Lines::amplitude(i), Lines::phase(i));
    return p;
  }

  Each phase_ = phases();
  Each at_below_{}, at_line_{}, at_above_{};
  std::array<Sums, Lines::count> sums_{};
  std::array<double, signals> first_{}, drift_{};
  double size_ = 1, scale_ = 0, step_s_ = 0;
  int samples_ = 0, limited_ = 0;
};

/// Margins of a loop at the lines. The loop is assumed to fall beyond the last line: the gain margin is at
/// most 1 / |L| there.
inline Margins margins_of(const std::array<Complex, Lines::count>& loop) {
  std::array<LoopSample, Lines::count> samples;
  for (std::size_t i = 0; i < Lines::count; ++i) samples[i] = {Lines::radps(i), loop[i]};
  Margins m = fulmar::margins_of(samples);
  m.gain_db = std::min(m.gain_db, -20 * std::log10(std::abs(loop.back())));
  return m;
}

/// Relative standard error of 1 + L, root mean square over the lines that margins come from: the octaves
/// round |L| = 1, or where it is largest.
inline double noise_of(const LoopRecord& r) {
  double most = 0, sum = 0;
  for (const Complex& gain : r.loop) most = std::max(most, std::abs(gain));
  int n = 0;
  for (std::size_t i = 0; i < Lines::count; ++i) {
    const double gain = std::abs(r.loop[i]);
    if (gain < std::min(0.3, 0.5 * most) || gain > 3) continue;
    sum += r.noise[i] * r.noise[i];
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : 1e9;
}

}  // namespace fulmar::slc
