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
  bool stalled = false;              ///< it recovers from a stall: height and course are not held
  bool airspeed_raised = false;      ///< more than commanded is held: load factor, mass or angle of attack
  bool bank_limited = false;         ///< by what the wing carries at this airspeed
  bool height_uncontrolled = false;  ///< it sinks at the limit of what the law can ask for
};

template <>
inline constexpr std::string_view appended_from<ControllerInternals> = "stalled";

}  // namespace fulmar
