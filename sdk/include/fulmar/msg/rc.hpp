// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// The pilot's sticks and switches. Positive: right roll, nose up, nose right.
struct Rc {
  double roll_frac = 0;      ///< roll stick
  double pitch_frac = 0;     ///< pitch stick
  double yaw_frac = 0;       ///< yaw stick
  double throttle_frac = 0;  ///< throttle stick, 0 to 1
  double aux1_frac = 0;      ///< first switch
  double aux2_frac = 0;      ///< second switch
  double aux3_frac = 0;      ///< third switch
  double aux4_frac = 0;      ///< fourth switch
  bool link = false;         ///< link of the transmitter: frames arrive
};

}  // namespace fulmar
