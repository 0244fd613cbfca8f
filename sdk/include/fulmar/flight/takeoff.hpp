// SPDX-License-Identifier: BSD-3-Clause
// What every outer loop shares near the ground and near the stall: is the aircraft standing, how far may the
// nose rise, and the take-off run.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/angles.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar {

/// On the ground and not moving. Without airspeed only what is low counts: a slow ground speed may as well be
/// a strong head wind.
inline bool standing(const VehicleState& state) {
  constexpr double slow_mps = 3, low_m = 3;
  if (state.ground_speed_mps >= slow_mps || std::abs(state.climb_rate_mps) >= slow_mps) return false;
  return state.airspeed_valid ? state.airspeed_mps < slow_mps : state.height_m < low_m;
}

/// Highest pitch command that speed permits: the limit above the minimum airspeed, level flight at 4/5 of it.
inline double pitch_ceiling(const VehicleState& state, const FlightLimits& limits) {
  if (!state.airspeed_valid) return limits.pitch_max_rad;
  return limits.pitch_max_rad *
         smoothly(state.airspeed_mps, 0.8 * limits.airspeed_min_mps, limits.airspeed_min_mps);
}

struct TakeoffTuning {
  double throttle_frac = 1;
  double pitch_rad = 0.2;  ///< after rotation
  double rotate_mps = 12;  ///< airspeed, or ground speed without it
  double course_kp = 1;    ///< roll per course error, airborne
  double roll_max_rad = 0.15;
};

/// Wings level, full throttle; after the rotation speed the nose comes up and a small bank keeps the course
/// captured at the start.
class TakeoffRun {
 public:
  void begin(const VehicleState& state) {
    // Before the wheels roll the course is noise: the nose points down the runway.
    by_nose_ = state.ground_speed_mps <= 3;
    course_ = by_nose_ ? state.yaw_rad : state.course_rad;
    resets_ = state.reset_count;
    rotated_ = false;
  }

  AttitudeCommand step(const VehicleState& state, const TakeoffTuning& tuning, const FlightLimits& limits) {
    const double speed = state.airspeed_valid ? state.airspeed_mps : state.ground_speed_mps;
    // The runway has not turned: the yaw that it was captured by was wrong.
    if (state.reset_count != resets_ && by_nose_) course_ = wrap_pi(course_ + state.reset_yaw_rad);
    resets_ = state.reset_count;
    rotated_ = rotated_ || speed >= tuning.rotate_mps;
    AttitudeCommand command;
    command.throttle_frac = std::clamp(tuning.throttle_frac, 0.0, 1.0);
    if (!rotated_) return command;
    error_ = angle_difference(course_, state.course_rad);
    command.roll_rad = std::clamp(tuning.course_kp * error_, -tuning.roll_max_rad, tuning.roll_max_rad);
    command.pitch_rad = std::min(tuning.pitch_rad, pitch_ceiling(state, limits));
    return command;
  }

  double course_rad() const { return course_; }
  double error_rad() const { return error_; }
  bool rotated() const { return rotated_; }

 private:
  double course_ = 0, error_ = 0;
  std::uint32_t resets_ = 0;  ///< of the state, seen so far
  bool rotated_ = false, by_nose_ = false;
};

}  // namespace fulmar
