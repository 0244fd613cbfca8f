// SPDX-License-Identifier: BSD-3-Clause
// Filters for a variable step. The discretisation is exact: the pole is exp(-dt / tau) for any dt. Each
// filter starts at its first input, without a transient from zero.
#pragma once
#include <algorithm>
#include <cmath>

namespace fulmar {

/// exp(-x), recomputed when x changes: most steps have equal length.
class Decay {
 public:
  double of(double x) {
    if (x != x_) {
      x_ = x;
      decay_ = std::exp(-x);
    }
    return decay_;
  }

 private:
  double x_ = 0, decay_ = 1;
};

/// y' = (u - y) / tau, exact for an input that is constant over the step.
class LowPass {
 public:
  double step(double u, double time_constant_s, double dt_s) {
    if (!started_) return reset_to(u);
    const double pole = time_constant_s > 0 ? decay_.of(dt_s / time_constant_s) : 0;
    return y_ = pole * y_ + (1 - pole) * u;
  }
  double reset_to(double y) {
    started_ = true;
    return y_ = y;
  }
  void reset() {
    started_ = false;
    y_ = 0;
  }
  double value() const { return y_; }

 private:
  Decay decay_;
  double y_ = 0;
  bool started_ = false;
};

/// Wash-out: y = s / (s + pole) u. It passes changes, and a constant input decays. Exact for an input that is
/// linear over the step.
class WashOut {
 public:
  double step(double u, double pole_radps, double dt_s) {
    if (!started_) return reset_to(u);
    const double x = pole_radps * dt_s;
    const double decay = decay_.of(x);
    const double gain =
        x > 1e-6 ? (1 - decay) / x : 1 - x / 2;  // integral of the decay over the step, per step
    y_ = decay * y_ + gain * (u - u_);
    u_ = u;
    return y_;
  }
  double reset_to(double u) {
    started_ = true;
    u_ = u;
    return y_ = 0;
  }  ///< `u` counts as constant in the past
  void reset() {
    started_ = false;
    u_ = 0;
    y_ = 0;
  }
  double value() const { return y_; }

 private:
  Decay decay_;
  double u_ = 0, y_ = 0;
  bool started_ = false;
};

/// y'' = w^2 (u - y) - 2 z w y', for an input that is constant over the step. It also gives the filtered
/// derivative. Exact up to the damping 1; a larger value counts as 1, since it needs two first-order filters.
class SecondOrder {
 public:
  double step(double u, double natural_frequency_radps, double damping_ratio, double dt_s) {
    if (!started_) return reset_to(u);
    const double w = natural_frequency_radps, z = std::min(damping_ratio, 1.0);
    const double decay = std::exp(-z * w * dt_s), wd = w * std::sqrt(std::max(1 - z * z, 0.0));
    const double c = std::cos(wd * dt_s), s = wd * dt_s > 1e-9 ? std::sin(wd * dt_s) / wd : dt_s;
    const double e = y_ - u, v = rate_;  // free motion about the input
    y_ = u + decay * (e * (c + z * w * s) + v * s);
    rate_ = decay * (v * (c - z * w * s) - e * w * w * s);
    return y_;
  }
  double reset_to(double y) {
    started_ = true;
    rate_ = 0;
    return y_ = y;
  }
  void reset() {
    started_ = false;
    y_ = 0;
    rate_ = 0;
  }
  double value() const { return y_; }
  double rate() const { return rate_; }

 private:
  double y_ = 0, rate_ = 0;
  bool started_ = false;
};

/// Derivative of a measured signal, band-limited: y = s / (tau s + 1) u.
class Differentiator {
 public:
  double step(double u, double time_constant_s, double dt_s) {
    if (dt_s <= 0 || time_constant_s <= 0) return filter_.value() / std::max(time_constant_s, 1e-9);
    return filter_.step(u, 1 / time_constant_s, dt_s) / time_constant_s;
  }
  void reset_to(double u) { filter_.reset_to(u); }
  void reset() { filter_.reset(); }

 private:
  WashOut filter_;
};

/// Follows its input at most at `rate` per second, in both directions.
class RateLimiter {
 public:
  double step(double u, double rate, double dt_s) { return step(u, -rate, rate, dt_s); }
  double step(double u, double fall_rate, double rise_rate, double dt_s) {
    if (!started_) return reset_to(u);
    return y_ = std::clamp(u, y_ + fall_rate * dt_s, y_ + rise_rate * dt_s);
  }
  double reset_to(double y) {
    started_ = true;
    return y_ = y;
  }
  void reset() {
    started_ = false;
    y_ = 0;
  }
  double value() const { return y_; }

 private:
  double y_ = 0;
  bool started_ = false;
};

}  // namespace fulmar
