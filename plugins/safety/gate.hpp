// SPDX-License-Identifier: BSD-3-Clause
// What speaks against a take-off.
#pragma once
#include <cmath>

#include "fulmar/msg/safety_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::safety {

struct GateLimits {
  Param take_off_wind{0.55, "ratio", 0, 5, "wind over cruise airspeed, above which it is not ready"};
  Param motor_test{3, "s", 0, 60,
                   "open throttle without motion before a take-off, until the motor has failed"};
};

/// What only a take-off run shows, kept until a hand-over or a disarming: a motor that does not move the
/// aircraft, and a tail wind.
class RunUp {
 public:
  bool failed() const { return failed_; }
  bool tail_wind() const { return tail_wind_; }
  void step(bool obeyed, double throttle_frac, double ground_speed_mps, bool windy, double within_s,
            double dt) {
    constexpr double open_frac = 0.5, moves_mps = 1.5, rolls_mps = 2;
    if (!obeyed) {
      *this = {};
      return;
    }
    const bool stands = throttle_frac > open_frac && ground_speed_mps < moves_mps;
    open_s_ = stands ? open_s_ + dt : 0;
    failed_ = failed_ || open_s_ >= within_s;
    tail_wind_ = tail_wind_ || (windy && throttle_frac > open_frac && ground_speed_mps > rolls_mps);
  }

 private:
  double open_s_ = 0;
  bool failed_ = false, tail_wind_ = false;
};

inline bool any(const NotReady& n) {
  return n.estimator || n.position || n.pitot || n.radio || n.battery || n.wind || n.fence || n.height ||
         n.motor;
}

}  // namespace fulmar::safety
