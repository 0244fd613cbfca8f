// SPDX-License-Identifier: BSD-3-Clause
// A hand-over of the actuators without a step.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/airframe.hpp>

namespace fulmar::slc {

/// What the integrals do not take up of a hand-over fades: the rudder, the throttle, and what is beyond
/// their bounds. As an exponential, not at a rate as in Airspeed and the outer laws: what is left is known
/// only once this law has stepped, most of it is gone at once, and no surface is too fast for its servo.
class HandOverFade {
 public:
  void stop() { fading_ = false; }
  /// `last`: the actuators that this law takes over from now, or null.
  void step(const Actuators* last, const Airframe& a, bool flying, double dt, Actuators& u) {
    constexpr double within_s = 0.5, forgotten = 1e-6;
    if (last) fading_ = true;
    if (!flying) fading_ = false;
    if (!fading_) return;
    fading_ = false;
    const double decay = std::exp(-dt / within_s);
    const auto one = [&](double Actuators::*of, double least, double most) {
      left_.*of = last ? last->*of - u.*of : decay * left_.*of;
      u.*of = std::clamp(u.*of + left_.*of, least, most);
      fading_ = fading_ || std::abs(left_.*of) > forgotten;
    };
    one(&Actuators::aileron_rad, -a.aileron.limit_rad, a.aileron.limit_rad);
    one(&Actuators::elevator_rad, -a.elevator.limit_rad, a.elevator.limit_rad);
    one(&Actuators::rudder_rad, -a.rudder.limit_rad, a.rudder.limit_rad);
    one(&Actuators::throttle_frac, 0, 1);
  }

 private:
  Actuators left_;  ///< of a hand-over, to be forgotten
  bool fading_ = false;
};

}  // namespace fulmar::slc
