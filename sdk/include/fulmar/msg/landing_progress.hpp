// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class LandingStage : std::uint8_t {
  join,       ///< to the circle that touches the final approach where it begins, and down on it
  approach,   ///< on the glide slope
  flare,      ///< the sink rate falls with the height
  roll_out,   ///< touched down
  go_around,  ///< climbs along the runway, then joins again
  stopped
};

struct LandingProgress {
  LandingStage stage = LandingStage::join;
  double along_m = 0;   ///< to the point where the glide slope meets the runway; negative beyond it
  double cross_m = 0;   ///< right of the centre line is positive
  double height_m = 0;  ///< above the runway
  std::uint32_t go_arounds = 0;
};

}  // namespace fulmar
