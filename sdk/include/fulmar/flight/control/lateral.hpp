// SPDX-License-Identifier: BSD-3-Clause
// Course or lateral acceleration to roll: Beard & McLain, Small Unmanned Aircraft (2012), section 6.3.2, with
// the bank of the path's curvature fed forward. A bank phi turns the course at g tan(phi) / Vg, so the gain
// grows with ground speed to keep one bandwidth up wind and down wind.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/pid.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar {

/// Gains and limits of CourseHold. `kp` is roll per course error, rad/rad.
struct CourseTuning {
  double kp = 2, ki = 0;  ///< at the cruise speed; ki per second
  double cruise_mps = 15;
  double roll_max_rad = 0.785;
  double roll_rate_max_radps = 1;  ///< limit of the command, within the bandwidth of the roll loop
  double smoothing_s = 0.1;        ///< time constant of the command
};

/// Course hold, B&M section 6.3.2. Output: roll command in rad, right positive, limited, smoothed and
/// rate-limited.
class CourseHold {
 public:
  /// Roll command. `feedforward_rad` is the bank that the path needs.
  double step(const VehicleState& state, double course_rad, double feedforward_rad,
              const CourseTuning& tuning, double dt_s) {
    error_ = angle_difference(course_rad, state.course_rad);
    beyond_ = false;
    const double speed_ratio =
        std::clamp(state.ground_speed_mps / std::max(tuning.cruise_mps, 1.0), 0.5, 2.0);
    const PidInput in{.error = error_,
                      .rate = 0,
                      .feedforward = feedforward_rad,
                      .min = -tuning.roll_max_rad,
                      .max = tuning.roll_max_rad};
    return shape(pid_.step({tuning.kp * speed_ratio, tuning.ki * speed_ratio, 0}, in, dt_s), tuning, dt_s);
  }

  /// Roll command of a level acceleration to the right, for any course: that of a coordinated turn, B&M
  /// (9.14) times the speed. It resets the integral of the course.
  double accelerate(double acceleration_mps2, const CourseTuning& tuning, double dt_s) {
    constexpr double g = 9.80665;
    const double roll = std::atan(acceleration_mps2 / g);
    pid_ = {};
    error_ = 0;
    beyond_ = std::abs(roll) > tuning.roll_max_rad;
    return shape(roll, tuning, dt_s);
  }

  /// Any other roll target, with the same smoothing and limits.
  double shape(double target_rad, const CourseTuning& tuning, double dt_s) {
    const double bounded = std::clamp(target_rad, -tuning.roll_max_rad, tuning.roll_max_rad);
    const double pole = tuning.smoothing_s > 0 ? decay_.of(dt_s / tuning.smoothing_s) : 0;
    return limiter_.step(bounded + pole * (limiter_.value() - bounded), tuning.roll_rate_max_radps, dt_s);
  }

  /// Continues from a roll command in force.
  void reset_to(double roll_rad) {
    pid_.reset();
    beyond_ = false;
    limiter_.reset_to(roll_rad);
  }
  double error_rad() const { return error_; }
  bool saturated() const { return beyond_ || pid_.saturated(); }

 private:
  Pid pid_;
  RateLimiter limiter_;
  Decay decay_;
  double error_ = 0;
  bool beyond_ = false;  // acceleration beyond the roll limit
};

}  // namespace fulmar
