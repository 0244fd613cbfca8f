// SPDX-License-Identifier: BSD-3-Clause
// Common parts of outer loops near the ground and near the stall: standing, pitch limit, and the take-off
// run.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar {

/// True on the ground without motion. Without airspeed only a low height counts, because a low ground speed
/// may be a strong head wind.
inline bool standing(const VehicleState& state) {
  constexpr double slow_mps = 3, low_m = 3;
  if (state.ground_speed_mps >= slow_mps || std::abs(state.climb_rate_mps) >= slow_mps) return false;
  return state.airspeed_valid ? state.airspeed_mps < slow_mps : state.height_m < low_m;
}

/// Highest pitch command at this airspeed: the limit above the slowest airspeed, level flight at 4/5 of it.
inline double pitch_ceiling(const VehicleState& state, const FlightLimits& limits, double slowest_mps) {
  if (!state.airspeed_valid) return limits.pitch_max_rad;
  return limits.pitch_max_rad * smoothly(state.airspeed_mps, 0.8 * slowest_mps, slowest_mps);
}
/// The same with the airframe's minimum airspeed.
inline double pitch_ceiling(const VehicleState& state, const FlightLimits& limits) {
  return pitch_ceiling(state, limits, limits.airspeed_min_mps);
}

/// Tuning of TakeoffRun. Speeds are true airspeed, m/s, unless a comment names another.
struct TakeoffTuning {
  double throttle_frac = 1;
  double pitch_rad = 0.2;  ///< pitch after rotation
  double rotate_mps = 12;  ///< airspeed, or ground speed without it
  double course_kp = 1;    ///< roll per course error in the air
  double roll_max_rad = 0.15;
  double launch_mps2 = 0;    ///< acceleration along the nose by a throw or a catapult; 0: take-off on wheels
  double launch_mps = 4;     ///< ground speed that counts as launched
  double motor_delay_s = 0;  ///< delay after the end of the push
};

/// Wings level, full throttle. After the rotation speed the nose rises, and a small bank holds the course of
/// the start. With `launch_mps2` the motor waits for a launch: that acceleration for a tenth of a second, and
/// the speed within half a second of it. A stumble has only one of them, a gust neither.
class TakeoffRun {
 public:
  void begin(const VehicleState& state) {
    // Before the wheels roll the course is noise: the nose points along the runway.
    by_nose_ = state.ground_speed_mps <= 3;
    course_ = by_nose_ ? state.yaw_rad : state.course_rad;
    resets_ = state.reset_count;
    rotated_ = launched_ = false;
    pushed_s_ = since_s_ = still_s_ = 0;
    since_push_s_ = 1e9;
  }

  /// `dt_s` is used for a launch alone.
  AttitudeCommand step(const VehicleState& state, const TakeoffTuning& tuning, const FlightLimits& limits,
                       double dt_s = 0) {
    const double speed = state.airspeed_valid ? state.airspeed_mps : state.ground_speed_mps;
    // The runway is constant: a reset shows that the captured yaw was wrong.
    if (state.reset_count != resets_ && by_nose_) course_ = wrap_pi(course_ + state.reset_yaw_rad);
    resets_ = state.reset_count;
    if (tuning.launch_mps2 <= 0) rotated_ = rotated_ || speed >= tuning.rotate_mps;
    AttitudeCommand command;
    if (tuning.launch_mps2 > 0) {
      if (!launched_ && !(launched_ = thrown(state, tuning, dt_s))) return command;
      if (state.specific_force_mps2.x < tuning.launch_mps2) since_s_ += dt_s;  // released from hand or rail
      rotated_ = true;
      if (lies(state, dt_s)) {
        begin(state);
        return command;
      }
    }
    if (since_s_ >= tuning.motor_delay_s || tuning.launch_mps2 <= 0)
      command.throttle_frac = std::clamp(tuning.throttle_frac, 0.0, 1.0);
    if (!rotated_) return command;
    error_ = angle_difference(course_, state.course_rad);
    command.roll_rad = std::clamp(tuning.course_kp * error_, -tuning.roll_max_rad, tuning.roll_max_rad);
    command.pitch_rad = std::min(tuning.pitch_rad, pitch_ceiling(state, limits));
    // After a throw the aircraft has no speed for a climb yet, and the motor may be dead: level until then.
    if (tuning.launch_mps2 > 0 && state.airspeed_valid)
      command.pitch_rad *=
          smoothly(state.airspeed_mps, limits.airspeed_min_mps, 1.2 * limits.airspeed_min_mps);
    return command;
  }

  double course_rad() const { return course_; }
  double error_rad() const { return error_; }
  bool rotated() const { return rotated_; }
  bool launched() const { return launched_; }

 private:
  /// The throw may turn the aircraft: its course is that of the nose at the release.
  bool thrown(const VehicleState& state, const TakeoffTuning& tuning, double dt_s) {
    constexpr double for_s = 0.1, within_s = 0.5;
    const bool pushed = state.specific_force_mps2.x > tuning.launch_mps2;
    pushed_s_ = pushed ? pushed_s_ + dt_s : 0;
    since_push_s_ = pushed_s_ >= for_s ? 0 : since_push_s_ + dt_s;
    // Ground speed, because a head wind is airspeed even in the hand.
    const bool fast = state.velocity_valid ? state.ground_speed_mps >= tuning.launch_mps
                                           : state.airspeed_valid && state.airspeed_mps >= tuning.launch_mps;
    if (since_push_s_ > within_s || !fast) return false;
    course_ = state.yaw_rad;
    return true;
  }

  double course_ = 0, error_ = 0;
  std::uint32_t resets_ = 0;  ///< resets of the state so far
  /// True after a launch that ended on the ground: the motor stops and waits for the next throw.
  bool lies(const VehicleState& state, double dt_s) {
    constexpr double for_s = 2, slow_mps = 1, level_mps = 0.3;
    const bool still = state.ground_speed_mps < slow_mps && std::abs(state.climb_rate_mps) < level_mps;
    still_s_ = still ? still_s_ + dt_s : 0;
    return still_s_ > for_s;
  }

  double pushed_s_ = 0, since_push_s_ = 1e9, since_s_ = 0, still_s_ = 0;
  bool rotated_ = false, by_nose_ = false, launched_ = false;
};

}  // namespace fulmar
