// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What guidance wants of the outer loops.
struct GuidanceCommand {
  double course_rad = 0;
  double height_m = 0;              ///< above the origin
  double climb_rate_mps = 0;        ///< feed-forward: slope of the path at the present ground speed
  double airspeed_mps = 0;          ///< true airspeed
  double roll_feedforward_rad = 0;  ///< bank that the path's curvature needs at the present ground speed
};

}  // namespace fulmar
