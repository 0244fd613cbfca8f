// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// Command of the outer loops to the inner loops.
struct AttitudeCommand {
  double roll_rad = 0;       ///< roll command
  double pitch_rad = 0;      ///< pitch command
  double throttle_frac = 0;  ///< throttle command, 0 to 1
};

/// Larger angles repeat the same attitudes: such a value is an angle in degrees.
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<AttitudeCommand>{
    {{"roll_rad", -std::numbers::pi, std::numbers::pi},
     {"pitch_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
