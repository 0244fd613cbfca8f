// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class LateralMode : std::uint8_t {
  course,       ///< hold `course_rad`
  acceleration  ///< fly `lateral_acceleration_mps2`
};

/// Command of guidance to the outer loops. Guidance with an acceleration also fills course and bank, with the
/// course flown and the bank of that acceleration, for outer laws without acceleration commands.
struct GuidanceCommand {
  double course_rad = 0;                      ///< course command
  double height_m = 0;                        ///< height command above the origin
  double climb_rate_mps = 0;                  ///< feed-forward climb rate: slope of the path at the present
                                              ///< ground speed
  double airspeed_mps = 0;                    ///< true airspeed command
  double roll_feedforward_rad = 0;            ///< feed-forward bank for the curvature of the path at the
                                              ///< present ground speed
  LateralMode lateral = LateralMode::course;  ///< mode of the lateral command
  double lateral_acceleration_mps2 = 0;       ///< horizontal acceleration command normal to the heading,
                                              ///< right positive: g tan(bank)
};

template <>
inline constexpr std::string_view appended_from<GuidanceCommand> = "lateral";

}  // namespace fulmar
