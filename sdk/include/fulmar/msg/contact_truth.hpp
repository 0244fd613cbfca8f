// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Truth of a simulator: contact of the aircraft with the ground. For figures and reports, never for control.
struct ContactTruth {
  bool touching = false;                                            ///< contact of a wheel or another part
                                                                    ///< with the ground
  bool crashed = false;                                             ///< flag of a crash, set by the first
                                                                    ///< contact that the airframe does not
                                                                    ///< survive
  Text<32> part;                                                    ///< part with the last contact: "nose
                                                                    ///< wheel", "left wing tip"; empty: none
                                                                    ///< yet
  double touched_s = -1;                                            ///< flight time of the last touch-down
                                                                    ///< after 0.5 s in the air, or of the
                                                                    ///< contact that ended the flight; -1:
                                                                    ///< none yet; the fields below belong to
                                                                    ///< it
  Vec3<Ned> position_m;                                             ///< position of the touch-down
  double sink_mps = 0;                                              ///< sink rate of the centre of gravity,
                                                                    ///< down is positive
  double ground_speed_mps = 0;                                      ///< ground speed at the touch-down
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0, course_rad = 0;  ///< attitude and course at the
                                                                    ///< touch-down
};

}  // namespace fulmar
