// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/msg/airframe.hpp"

namespace fulmar::sim {

/// A servo: first-order lag, limited in rate and throw. Solved exactly for a command that is constant over a
/// step.
class Servo {
 public:
  explicit Servo(const Surface& s)
      : limit_(s.limit_rad), rate_(s.rate_limit_radps), tau_(s.time_constant_s) {}

  void advance(double command, double dt) {
    command = std::clamp(command, -limit_, limit_);
    const double error = command - angle_, lag = rate_ * tau_;  // beyond `lag` the rate limit rules
    if (std::abs(error) > lag) {
      const double time_to_lag = (std::abs(error) - lag) / rate_;
      angle_ += std::copysign(rate_ * std::min(dt, time_to_lag), error);
      if (dt <= time_to_lag) return;
      dt -= time_to_lag;
    }
    angle_ = tau_ > 0 ? command + (angle_ - command) * decay(dt) : command;
  }
  double angle() const { return angle_; }
  void set(double angle) { angle_ = std::clamp(angle, -limit_, limit_); }

 private:
  double decay(double dt) {
    if (dt != decay_dt_) {
      decay_dt_ = dt;
      decay_ = std::exp(-dt / tau_);
    }
    return decay_;
  }
  double limit_, rate_, tau_;
  double angle_ = 0;
  double decay_dt_ = -1, decay_ = 0;
};

}  // namespace fulmar::sim
