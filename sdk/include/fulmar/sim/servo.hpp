// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/second_order.hpp"

namespace fulmar::sim {

/// A servo: first-order lag, or second order, with rate limit and stops. Solved exactly for a constant
/// command over a step.
class Servo {
 public:
  explicit Servo(const Surface& s)
      : min_(stops(s).min),
        max_(stops(s).max),
        rate_(s.rate_limit_radps),
        tau_(s.time_constant_s),
        play_(0.5 * s.dead_band_rad),
        second_(s.natural_frequency_radps, s.damping_ratio),
        plain_(play_ <= 0 && s.natural_frequency_radps <= 0) {}

  void advance(double command, double dt) {
    command = std::clamp(command, min_, max_);
    if (!plain_) return advance_other(command, dt);
    follow(command, dt);
  }
  double angle() const { return angle_; }
  double min() const { return min_; }
  double max() const { return max_; }
  /// Sets the angle, at rest.
  void set(double angle) {
    angle_ = aim_ = std::clamp(angle, min_, max_);
    second_.rest();
  }

 private:
  void follow(double command, double dt) {
    const double error = command - angle_, lag = rate_ * tau_;  // beyond `lag` the rate limit applies
    if (std::abs(error) > lag) {
      const double time_to_lag = (std::abs(error) - lag) / rate_;
      angle_ += std::copysign(rate_ * std::min(dt, time_to_lag), error);
      if (dt <= time_to_lag) return;
      dt -= time_to_lag;
    }
    angle_ = tau_ > 0 ? command + (angle_ - command) * decay(dt) : command;
  }

  /// A separate function, so that a plain servo has no additional cost. The dead band is a backlash: the
  /// target is constant while the command is within half of the band.
  [[gnu::noinline]] void advance_other(double command, double dt) {
    aim_ = std::clamp(aim_, command - play_, command + play_);
    if (!second_.given()) return follow(aim_, dt);
    angle_ = second_.advance(angle_, aim_, rate_, dt);
    if (angle_ >= min_ && angle_ <= max_) return;
    angle_ = std::clamp(angle_, min_, max_);
    second_.rest();
  }

  double decay(double dt) {
    if (dt != decay_dt_) {
      decay_dt_ = dt;
      decay_ = std::exp(-dt / tau_);
    }
    return decay_;
  }
  double min_, max_, rate_, tau_, play_;
  double angle_ = 0, aim_ = 0;
  double decay_dt_ = -1, decay_ = 0;
  SecondOrder second_;
  bool plain_;
};

}  // namespace fulmar::sim
