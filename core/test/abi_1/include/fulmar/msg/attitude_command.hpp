// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What the outer loops want of the inner ones.
struct AttitudeCommand {
  double roll_rad = 0;
  double pitch_rad = 0;
  double throttle_frac = 0;  ///< 0 to 1
};

}  // namespace fulmar
