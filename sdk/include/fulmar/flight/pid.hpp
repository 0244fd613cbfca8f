// SPDX-License-Identifier: BSD-3-Clause
// PID with a known rate of the measurement, feed-forward, and conditional integration that lets a saturated
// integrator unwind. Åström & Hägglund, Advanced PID Control (2006), chapter 3: the derivative acts on the
// measurement, the integral is kept in output units.
#pragma once
#include <algorithm>

namespace fulmar {

struct PidGains {
  double kp = 0, ki = 0, kd = 0;
};

struct PidInput {
  double error = 0;
  double rate = 0;  ///< time derivative of the measurement: damps, and does not kick when the set-point steps
  double feedforward = 0;
  double min = -1, max = 1;  ///< of the output
};

class Pid {
 public:
  /// u = feedforward + kp e + I - kd rate, within [min, max]. `dt_s` is the time since the last step; 0
  /// integrates nothing.
  double step(const PidGains& gains, const PidInput& in, double dt_s) {
    const double direct = in.feedforward + gains.kp * in.error - gains.kd * in.rate;
    const double increment = gains.ki * in.error * dt_s;
    const double u = direct + integral_;
    // Only growth into the limit is refused: an error of the other sign always unwinds.
    const bool deepens =
        (increment > 0 && u + increment > in.max) || (increment < 0 && u + increment < in.min);
    if (!deepens) integral_ += increment;
    const double wanted = direct + integral_;
    saturated_ = deepens || wanted < in.min || wanted > in.max;
    return std::clamp(wanted, in.min, in.max);
  }

  /// Bumpless start: the next step with the same input and dt 0 returns `output`. The integral takes up the
  /// difference, at most `integral_limit` of it: a hand-over far from trim must not leave a bias that takes
  /// long to unwind.
  void reset_to(double output, const PidGains& gains = {}, const PidInput& in = {},
                double integral_limit = 1e300) {
    const double direct = in.feedforward + gains.kp * in.error - gains.kd * in.rate;
    integral_ = std::clamp(output - direct, -integral_limit, integral_limit);
    saturated_ = false;
  }
  void reset() { integral_ = 0, saturated_ = false; }

  double integral() const { return integral_; }  ///< in units of the output
  bool saturated() const { return saturated_; }  ///< at a limit, or kept from growing into one

 private:
  double integral_ = 0;
  bool saturated_ = false;
};

}  // namespace fulmar
