// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Truth of a simulator: deflections and the resulting accelerations. For identification and figures, never
/// for control.
struct MotionTruth {
  double aileron_rad = 0, elevator_rad = 0, rudder_rad = 0, flap_rad = 0;  ///< deflections after lag, rate
                                                                           ///< limit and stops
  double propeller_radps = 0;                                              ///< speed of the first motor
  Vec3<Body> angular_acceleration_radps2;  ///< angular acceleration relative to inertial space
};

}  // namespace fulmar
