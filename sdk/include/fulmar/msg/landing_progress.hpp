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

/// Why an approach was not begun, or was broken off.
enum class LandingReason : std::uint8_t {
  none,
  commanded,    ///< by the parameter go_around
  position,     ///< position or height are not valid
  cross_track,  ///< farther from the centre line than cross_limit
  height,       ///< farther from the glide slope than height_limit
  flare_long,   ///< no touch-down while there is runway left to stop on
  crosswind,    ///< more than crosswind_limit
  runway_short  ///< with this wind the aircraft does not stop on the runway
};

struct LandingProgress {
  LandingStage stage = LandingStage::join;
  double along_m = 0;   ///< to the point where the glide slope meets the runway; negative beyond it
  double cross_m = 0;   ///< right of the centre line is positive
  double height_m = 0;  ///< above the runway
  std::uint32_t go_arounds = 0;
  LandingReason reason = LandingReason::none;  ///< of the last go-around, or why the approach is not begun
  double head_wind_mps = 0;                    ///< along the runway; negative: tail wind
  double cross_wind_mps = 0;                   ///< from the left is positive
  double needed_m = 0;                         ///< from the threshold to a stop, in this wind
  double runway_rad = 0;                       ///< its heading
  double beyond_threshold_m = 0;               ///< along it; negative before it
};

template <>
inline constexpr std::string_view appended_from<LandingProgress> = "reason";

}  // namespace fulmar
