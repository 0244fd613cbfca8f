// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Progress on a circle for waiting, climb or descent.
struct LoiterProgress {
  double cross_m = 0;         ///< cross-track error; outside the circle is positive
  double height_error_m = 0;  ///< height error; above the command is positive
  double laps_ratio = 0;      ///< number of laps since the activation
  bool there = false;         ///< on the circle, at its height
};

}  // namespace fulmar
