// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Truth of a simulator: what touches the ground. For figures and reports, never for control.
struct ContactTruth {
  bool touching = false;  ///< a wheel or another part is on the ground
  bool crashed = false;   ///< since the first contact that the airframe does not survive
  Text<32> part;          ///< what touched last: "nose wheel", "left wing tip"; empty: nothing yet
  /// Flight time of the last touch-down after 0.5 s in the air, or of the contact that ended the flight;
  /// -1: none yet. The fields below belong to it.
  double touched_s = -1;
  Vec3<Ned> position_m;
  double sink_mps = 0;  ///< of the centre of gravity, down is positive
  double ground_speed_mps = 0;
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0, course_rad = 0;
};

}  // namespace fulmar
