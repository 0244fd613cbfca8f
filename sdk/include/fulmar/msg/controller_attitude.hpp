// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// A flight controller's own estimate. Its heading drifts: nothing corrects it there.
struct ControllerAttitude {
  Quat attitude;          ///< body to NED
  Vec3<Body> rate_radps;  ///< filtered
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
};

}  // namespace fulmar
