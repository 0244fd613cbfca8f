// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Of a circle that is flown to wait, to climb or to come down.
struct LoiterProgress {
  double cross_m = 0;         ///< outside the circle is positive
  double height_error_m = 0;  ///< above the height wanted is positive
  double laps_ratio = 0;      ///< flown round it since it was taken up
  bool there = false;         ///< on the circle, at its height
};

}  // namespace fulmar
