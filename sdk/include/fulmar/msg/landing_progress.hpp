// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class LandingStage : std::uint8_t {
  join,       ///< to the circle that is tangent to the final approach at its start, and down on it
  approach,   ///< on the glide slope
  flare,      ///< sink rate falls with the height
  roll_out,   ///< on the runway
  go_around,  ///< climb along the runway, then join
  stopped
};

/// Reason of an approach that was not started or was aborted.
enum class LandingReason : std::uint8_t {
  none,
  commanded,    ///< parameter go_around
  position,     ///< invalid position or height
  cross_track,  ///< cross-track error above cross_limit
  height,       ///< glide slope error above height_limit
  flare_long,   ///< no touch-down within the runway left for the stop
  crosswind,    ///< crosswind above crosswind_limit
  runway_short  ///< stopping distance beyond the runway, in this wind
};

/// Progress of a landing.
struct LandingProgress {
  LandingStage stage = LandingStage::join;     ///< stage of the landing
  double along_m = 0;                          ///< distance to the point where the glide slope meets the
                                               ///< runway; negative beyond it
  double cross_m = 0;                          ///< cross-track error; right of the centre line is positive
  double height_m = 0;                         ///< height above the runway
  std::uint32_t go_arounds = 0;                ///< number of go-arounds
  LandingReason reason = LandingReason::none;  ///< reason of the last go-around, or of a rejected approach
  double head_wind_mps = 0;                    ///< head wind along the runway; negative: tail wind
  double cross_wind_mps = 0;                   ///< crosswind; from the left is positive
  double needed_m = 0;                         ///< distance from the threshold to the stop, in this wind
  double runway_rad = 0;                       ///< heading of the runway
  double beyond_threshold_m = 0;               ///< distance beyond the threshold, along the runway; negative
                                               ///< before it
};

template <>
inline constexpr std::string_view appended_from<LandingProgress> = "reason";

}  // namespace fulmar
