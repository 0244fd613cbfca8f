// SPDX-License-Identifier: BSD-3-Clause
// Conditions that prevent a take-off.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/msg/safety_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct GateLimits {
  Param take_off_wind{0.55, "ratio", 0, 5, "largest ratio of wind to cruise airspeed for a take-off"};
  Param motor_test{
      3, "s", 0, 60,
      "time with open throttle and without motion, before a take-off, that counts as a motor failure"};
};

/// Faults that only a take-off run shows, kept until a hand-over or a disarming: a motor that does not move
/// the aircraft, and a tail wind.
class RunUp {
 public:
  bool failed() const { return failed_; }
  bool tail_wind() const { return tail_wind_; }
  void step(bool obeyed, double throttle_frac, double forward_mps, bool windy, double within_s, double dt) {
    constexpr double open_frac = 0.5, moves_mps = 1.5, rolls_mps = 2;
    if (!obeyed) {
      *this = {};
      return;
    }
    const bool stands = throttle_frac > open_frac && forward_mps < moves_mps;
    open_s_ = stands ? open_s_ + dt : 0;
    failed_ = failed_ || open_s_ >= within_s;
    tail_wind_ = tail_wind_ || (windy && throttle_frac > open_frac && forward_mps > rolls_mps);
  }

 private:
  double open_s_ = 0;
  bool failed_ = false, tail_wind_ = false;
};

/// Ground speed along the nose; negative when a wind rolls a standing aircraft backwards.
inline double forward_speed(const VehicleState& s) {
  return s.velocity_mps.north * std::cos(s.yaw_rad) + s.velocity_mps.east * std::sin(s.yaw_rad);
}

/// Wind along the aircraft before the filter has an estimate. A pitot airspeed above the ground speed is head
/// wind, below it tail wind. Tail wind shows in a take-off run only.
class GroundWind {
 public:
  double mps() const { return mps_; }
  void step(const VehicleState& s, double smoothing_s, double dt) {
    if (!s.velocity_valid) return;
    constexpr double rolls_mps = 2, run_smoothing_s = 0.3;
    const bool stands = forward_speed(s) < rolls_mps;
    const double along = s.airspeed_valid ? std::abs(s.airspeed_mps - forward_speed(s)) : 0;
    const double filter = stands && s.wind_valid ? std::hypot(s.wind_mps.north, s.wind_mps.east) : 0.0;
    since_s_ += dt;
    const double share = 1 - std::exp(-dt / (stands ? smoothing_s : run_smoothing_s));
    mps_ += std::max(share, dt / since_s_) * (std::max(filter, along) - mps_);  // at first the mean
  }

 private:
  double mps_ = 0, since_s_ = 1e-3;
};

inline bool any(const NotReady& n) {
  return n.estimator || n.position || n.pitot || n.radio || n.battery || n.wind || n.fence || n.height ||
         n.motor;
}

}  // namespace fulmar::safety
