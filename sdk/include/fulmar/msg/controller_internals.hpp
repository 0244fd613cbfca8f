// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class OuterLaw : std::uint8_t { hold, takeoff, roll_out };

/// Internal signals of an outer law, for the log and for tuning.
struct ControllerInternals {
  OuterLaw law = OuterLaw::hold;     ///< active law
  double course_error_rad = 0;       ///< course error
  double height_error_m = 0;         ///< height error
  double airspeed_error_mps = 0;     ///< airspeed error
  double roll_rad = 0;               ///< roll command
  double pitch_rad = 0;              ///< pitch command
  bool roll_saturated = false;       ///< saturation of the roll command
  bool pitch_saturated = false;      ///< saturation of the pitch command
  bool throttle_saturated = false;   ///< saturation of the throttle
  bool stalled = false;              ///< stall recovery: height and course are not held
  bool airspeed_raised = false;      ///< airspeed raised above the command: load factor, mass or angle of
                                     ///< attack
  bool bank_limited = false;         ///< bank limited by the lift at this airspeed
  bool height_uncontrolled = false;  ///< sink at the limit of the commands of the law
};

template <>
inline constexpr std::string_view appended_from<ControllerInternals> = "stalled";

}  // namespace fulmar
