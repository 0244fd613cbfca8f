// SPDX-License-Identifier: BSD-3-Clause
// Bumpless transfer of the actuators.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/airframe.hpp>

namespace fulmar::slc {

/// Fades the part of a hand-over that the integrals cannot take up: the rudder, the throttle, and what
/// exceeds the bounds of the integrals. The fade is exponential, not at a fixed rate as in Airspeed and the
/// outer laws. The remainder is known only after the first step, and the servos follow the fast beginning.
class HandOverFade {
 public:
  void stop() { fading_ = false; }
  /// `last`: the actuators of the law before, or null without a hand-over in this step.
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
  Actuators left_;  ///< remainder of a hand-over
  bool fading_ = false;
};

}  // namespace fulmar::slc
