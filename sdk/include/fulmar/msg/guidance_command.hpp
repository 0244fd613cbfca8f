// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class LateralMode : std::uint8_t {
  course,       ///< hold `course_rad`
  acceleration  ///< fly `lateral_acceleration_mps2`
};

/// What guidance wants of the outer loops. Whoever commands an acceleration fills course and bank all the
/// same, as the course that is flown and the bank that it takes: an outer law that knows no acceleration goes
/// by these.
struct GuidanceCommand {
  double course_rad = 0;
  double height_m = 0;              ///< above the origin
  double climb_rate_mps = 0;        ///< feed-forward: slope of the path at the present ground speed
  double airspeed_mps = 0;          ///< true airspeed
  double roll_feedforward_rad = 0;  ///< bank that the path's curvature needs at the present ground speed
  LateralMode lateral = LateralMode::course;
  double lateral_acceleration_mps2 = 0;  ///< level, square to the heading, right positive: g tan(bank)
};

template <>
inline constexpr std::string_view appended_from<GuidanceCommand> = "lateral";

}  // namespace fulmar
