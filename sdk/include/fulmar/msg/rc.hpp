// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// The pilot's sticks and switches. Positive: right roll, nose up, nose right.
struct Rc {
  double roll_frac = 0;
  double pitch_frac = 0;
  double yaw_frac = 0;
  double throttle_frac = 0;  ///< 0 to 1
  double aux1_frac = 0;
  double aux2_frac = 0;
  double aux3_frac = 0;
  double aux4_frac = 0;
  bool link = false;  ///< frames arrive
};

}  // namespace fulmar
