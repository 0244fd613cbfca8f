// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Attitude estimate of a flight controller. Its heading drifts, since the controller does not correct it.
struct ControllerAttitude {
  Quat attitude;                                    ///< attitude, body to NED
  Vec3<Body> rate_radps;                            ///< filtered body rate
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< 3-2-1 Euler angles of `attitude`
};

}  // namespace fulmar
