// SPDX-License-Identifier: BSD-3-Clause
// PID with a known rate of the measurement, feed-forward, and conditional integration that unwinds a
// saturated integrator. Åström & Hägglund, Advanced PID Control (2006), chapter 3: the derivative acts on the
// measurement, the integral has output units.
#pragma once
#include <algorithm>

namespace fulmar {

/// Gains, in units of the output per unit of error, per error and second, and per rate.
struct PidGains {
  double kp = 0, ki = 0, kd = 0;
};

/// Input of one step. `error` is set-point minus measurement; `feedforward` has the unit of the output.
struct PidInput {
  double error = 0;
  double rate = 0;  ///< time derivative of the measurement: damping without a kick at a step of the set-point
  double feedforward = 0;
  double min = -1, max = 1;  ///< limits of the output
};

/// One PID loop. Units are those of the gains; Åström & Hägglund (2006), chapter 3.
class Pid {
 public:
  /// u = feedforward + kp e + I - kd rate, within [min, max]. `dt_s` is the time since the last step; with 0
  /// nothing is integrated.
  double step(const PidGains& gains, const PidInput& in, double dt_s) {
    const double direct = in.feedforward + gains.kp * in.error - gains.kd * in.rate;
    const double increment = gains.ki * in.error * dt_s;
    const double u = direct + integral_;
    // Only growth into the limit is blocked: an error of the other sign unwinds.
    const bool deepens =
        (increment > 0 && u + increment > in.max) || (increment < 0 && u + increment < in.min);
    if (!deepens) integral_ += increment;
    const double wanted = direct + integral_;
    saturated_ = deepens || wanted < in.min || wanted > in.max;
    return std::clamp(wanted, in.min, in.max);
  }

  /// Bumpless start: the next step with the same input and dt 0 returns `output`. The integral takes up the
  /// difference, at most `integral_limit`: a switch far from trim must not leave a large bias.
  void reset_to(double output, const PidGains& gains = {}, const PidInput& in = {},
                double integral_limit = 1e300) {
    const double direct = in.feedforward + gains.kp * in.error - gains.kd * in.rate;
    integral_ = std::clamp(output - direct, -integral_limit, integral_limit);
    saturated_ = false;
  }
  void reset() {
    integral_ = 0;
    saturated_ = false;
  }

  double integral() const { return integral_; }  ///< integral in units of the output
  bool saturated() const { return saturated_; }  ///< at a limit, or blocked from growing into one

 private:
  double integral_ = 0;
  bool saturated_ = false;
};

/// While a limit governs a demand, its error is not integrated; but an old integral must not prevent the
/// demand for long. If less than half of the demand is met for some seconds, this class returns the missing
/// part for integration. Upwards it does so only while the integral is below 0, since a climb beyond the
/// power of the engine must not be integrated. Downwards it does so to `least`.
class LateDemand {
 public:
  /// `demanded` and `flown` have one unit; `integral` and `least` that of the output.
  double missing(bool limited, double demanded, double flown, double integral, double least, double dt_s) {
    const bool late = limited && flown * demanded < 0.5 * demanded * demanded;
    late_s_ = std::clamp(late ? late_s_ + dt_s : late_s_ - dt_s, 0.0, patience_s);
    if (!late || late_s_ < patience_s) return 0;
    const bool may = demanded > 0 ? integral < 0 : integral > least;
    return may ? demanded - flown : 0;
  }
  void reset() { late_s_ = 0; }

 private:
  static constexpr double patience_s = 5;  // tolerates gusts
  double late_s_ = 0;
};

}  // namespace fulmar
