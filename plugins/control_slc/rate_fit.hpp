// SPDX-License-Identifier: BSD-3-Clause
// Smooths a record by a model: the effect of turbulence differs from line to line, but the response of the
// aircraft does not. A low-order rate response with delay, fitted to a record, removes most of the noise: (b0
// + b1 s) e^(-s tau) / (1 + a1 s + a2 s^2), by the iteration of Sanathanan & Koerner, IEEE Trans. Automatic
// Control 8 (1963), for several delays.
#pragma once
#include "gain_search.hpp"

namespace fulmar::slc {

class RateFit {
 public:
  static constexpr int unknown = 5;             ///< tau with them
  static constexpr double model_error = 0.015;  ///< of 1 + L, the residual of any low-order model
  static constexpr double max_misfit = 2.5;     ///< beyond it the aircraft fits no model

  /// `gains`: those of the record. `more`: the law feeds back more than attitude and rate.
  void begin(const LoopRecord& record, const AxisGains& gains, bool more) {
    record_ = record;
    gains_ = gains;
    more_ = more;
    next_ = 0;
    misfit_ = 1e300;
    for (std::size_t i = 0; i < Lines::count; ++i) {
      const double noise = 1.3 * smoothed(record.noise, i) + model_error;
      const Complex L = record.loop[i];
      weight_[i] = std::abs(L) / (noise * std::abs(1.0 + L) * std::abs(record.rate[i]));
    }
  }
  /// Tries one delay. Returns true when all have been tried.
  bool step() {
    if (next_ > delays) return true;
    Each fitted{};
    const double tau = 0.005 * next_++, off = fit(tau, fitted);
    if (off < misfit_) {
      misfit_ = off;
      best_ = fitted;
    }
    return false;
  }
  /// Mean square of the residual, in variances of the noise: 1 when the model fits.
  double misfit() const { return misfit_; }

  /// The record with most of the noise removed; unchanged when no model fits.
  LoopRecord record() const {
    LoopRecord r = record_;
    if (!(misfit_ < max_misfit)) return r;
    for (std::size_t i = 0; i < Lines::count; ++i) {
      r.rate[i] = best_[i];
      if (gains_.damper()) {
        // the factor from rate to loop is exact: it belongs to the law
        r.loop[i] *= best_[i] / record_.rate[i];
      } else {
        const Complex back = std::polar(1.0, -Lines::radps(i) * r.step_s), integral = r.step_s / (1.0 - back);
        r.attitude[i] = best_[i] * integral * 0.5 * (1.0 + back);
        const auto law = [&](const LoopRecord& of) {
          return of.scale * ((gains_.kp + gains_.ki * integral) * of.attitude[i] + gains_.kd * of.rate[i]);
        };
        r.loop[i] = law(r) + (more_ ? record_.loop[i] - law(record_) : 0.0);
      }
      r.noise[i] *= std::sqrt(std::clamp(misfit_, 0.2, max_misfit) * unknown / (2.0 * Lines::count));
    }
    return r;
  }

 private:
  using Each = std::array<Complex, Lines::count>;
  static constexpr int delays = 20, iterations = 4;
  static constexpr std::size_t n = 4;

  double fit(double tau, Each& fitted) const {
    Each below;
    below.fill(1.0);
    std::array<double, n> x{};
    for (int k = 0; k < iterations; ++k) {
      std::array<std::array<double, n + 1>, n> A{};
      for (std::size_t i = 0; i < Lines::count; ++i) {
        const auto row = row_of(i, tau);
        const double w = weight_[i] * weight_[i] / std::norm(below[i]);
        for (std::size_t a = 0; a < n; ++a) {
          for (std::size_t b = 0; b < n; ++b) A[a][b] += w * (std::conj(row[a]) * row[b]).real();
          A[a][n] += w * (std::conj(row[a]) * record_.rate[i]).real();
        }
      }
      if (!solve(A, x)) return 1e300;
      for (std::size_t i = 0; i < Lines::count; ++i) {
        const Complex s = s_of(i);
        below[i] = 1.0 + s * (x[2] + s * x[3]);
      }
    }
    double sum = 0;
    for (std::size_t i = 0; i < Lines::count; ++i) {
      const auto row = row_of(i, tau);
      fitted[i] = (row[0] * x[0] + row[1] * x[1]) / below[i];
      sum += weight_[i] * weight_[i] * std::norm(fitted[i] - record_.rate[i]);
    }
    return sum / (2.0 * Lines::count - unknown);
  }
  static Complex s_of(std::size_t i) { return {0, Lines::radps(i) / 10}; }  // of 10 rad/s: near 1
  std::array<Complex, n> row_of(std::size_t i, double tau) const {
    const Complex s = s_of(i), late = std::polar(1.0, -Lines::radps(i) * tau);
    return {late, s * late, -record_.rate[i] * s, -record_.rate[i] * s * s};
  }
  /// Gauss elimination; the matrix is positive definite.
  static bool solve(std::array<std::array<double, n + 1>, n>& A, std::array<double, n>& x) {
    for (std::size_t c = 0; c < n; ++c) {
      if (!(A[c][c] > 0)) return false;
      for (std::size_t r = c + 1; r < n; ++r) {
        const double by = A[r][c] / A[c][c];
        for (std::size_t k = c; k <= n; ++k) A[r][k] -= by * A[c][k];
      }
    }
    for (std::size_t c = n; c-- > 0;) {
      double sum = A[c][n];
      for (std::size_t k = c + 1; k < n; ++k) sum -= A[c][k] * x[k];
      x[c] = sum / A[c][c];
    }
    return true;
  }

  LoopRecord record_;
  AxisGains gains_;
  bool more_ = false;
  std::array<double, Lines::count> weight_{};
  Each best_{};
  double misfit_ = 1e300;
  int next_ = 0;
};

}  // namespace fulmar::slc
