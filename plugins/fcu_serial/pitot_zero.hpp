// SPDX-License-Identifier: BSD-3-Clause
// The controller's zero of its pitot, which it takes at each boot, in any wind.
#pragma once
#include <string_view>

namespace fulmar::fcu {

inline constexpr std::string_view pitot_zero = "DIFF_PRESS_BIAS";  ///< a parameter of the firmware, Pa
// beyond it, 7 m/s, the zero was taken in wind or in the air
inline constexpr double pitot_zero_limit_pa = 30;

}  // namespace fulmar::fcu
