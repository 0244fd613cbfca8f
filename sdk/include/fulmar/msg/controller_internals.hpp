// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class OuterLaw : std::uint8_t { hold, takeoff, roll_out };

/// What an outer loop thinks, for the log and for tuning.
struct ControllerInternals {
  OuterLaw law = OuterLaw::hold;
  double course_error_rad = 0;
  double height_error_m = 0;
  double airspeed_error_mps = 0;
  double roll_rad = 0;   ///< commanded
  double pitch_rad = 0;  ///< commanded
  bool roll_saturated = false;
  bool pitch_saturated = false;
  bool throttle_saturated = false;
};

}  // namespace fulmar
