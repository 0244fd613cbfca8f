// SPDX-License-Identifier: BSD-3-Clause
// Stability margins of a loop from samples of its frequency response. The closed loop is 1 + L: L is the loop
// response with the sign of negative feedback. Åström & Murray, Feedback Systems (2008), section 9.3. They
// hold for a stable closed loop, which unstable_poles() checks.
#pragma once
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

namespace fulmar {

/// The open loop at one frequency.
struct LoopSample {
  double radps = 0;
  std::complex<double> gain;  ///< L(j omega)
};

/// Margins; infinite where no value makes the loop unstable.
struct Margins {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double gain_db = none;       ///< upward gain margin
  double reduction_db = none;  ///< downward gain margin: finite if only the loop stabilises
  double phase_rad = none;     ///< least phase margin over all crossovers, for lag or lead
  double delay_s = none;       ///< additional delay
  double crossover_radps = 0;  ///< highest frequency at which |L| is 1; 0: none

  double min_gain_db() const { return std::min(gain_db, reduction_db); }
};

namespace detail {

/// Crossing of the real axis left of 0 between two samples.
inline void add_axis(Margins& m, const LoopSample& a, const LoopSample& b) {
  const double x = a.gain.imag(), y = b.gain.imag();
  if ((x < 0) == (y < 0) || x == y) return;
  const double part = x / (x - y), re = a.gain.real() + part * (b.gain.real() - a.gain.real());
  if (re >= 0) return;
  const double db = -20 * std::log10(-re);
  if (db >= 0)
    m.gain_db = std::min(m.gain_db, db);
  else
    m.reduction_db = std::min(m.reduction_db, -db);
}

/// Crossing of the unit circle between two samples.
inline void add_circle(Margins& m, const LoopSample& a, const LoopSample& b) {
  const double x = std::log(std::abs(a.gain)), y = std::log(std::abs(b.gain));
  if ((x < 0) == (y < 0) || !std::isfinite(x) || !std::isfinite(y)) return;
  const double part = x / (x - y), w = a.radps * std::pow(b.radps / a.radps, part);
  const double turn = std::arg(a.gain) + part * std::arg(b.gain / a.gain);
  constexpr double pi = std::numbers::pi;
  const double lag = turn + pi - 2 * pi * std::floor((turn + pi) / (2 * pi));  // until -180 deg, 0 .. 2 pi
  m.phase_rad = std::min(m.phase_rad, std::min(lag, 2 * pi - lag));
  m.delay_s = std::min(m.delay_s, lag / w);
  m.crossover_radps = std::max(m.crossover_radps, w);
}

}  // namespace detail

/// `loop`: at rising frequencies, with a rotation of L well below 90 deg between two samples.
inline Margins margins_of(std::span<const LoopSample> loop) {
  Margins m;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    detail::add_axis(m, loop[i - 1], loop[i]);
    detail::add_circle(m, loop[i - 1], loop[i]);
  }
  return m;
}

/// Number of poles of the closed loop right of the line Re s = `line`, by the argument principle (Nyquist):
/// those of the open loop there, less the turns of `difference`(s). This is det(1 + L), or any function with
/// the poles of the closed loop as zeros, those of the open loop as poles, and a constant value, not 0, at
/// high frequency (`last_radps`). Delays need no approximation.
template <class Difference>
int unstable_poles(Difference&& difference, int open_loop, double line, double last_radps) {
  using Complex = std::complex<double>;
  double turned = 0, w = 0, step = 0.25 * std::max(line, 1e-6);
  Complex here = difference(Complex(line, 0));
  while (w < last_radps) {
    const double next = std::min(w + step, last_radps);
    const Complex there = difference(Complex(line, next));
    const double turn = std::arg(there / here);
    if (std::abs(turn) > 0.3 && step > 1e-9 * (1 + w)) {
      step *= 0.5;
      continue;
    }
    turned += turn;
    w = next;
    here = there;
    if (std::abs(turn) < 0.1) step *= 1.6;
    step = std::min(step, 0.05 * w + 0.25 * line);  // small enough for sharp resonances
  }
  return open_loop - static_cast<int>(std::lround(turned / std::numbers::pi));  // both halves of the line
}

}  // namespace fulmar
