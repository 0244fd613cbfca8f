// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "fulmar/message.hpp"

namespace fulmar {

/// Deflections of the surfaces and throttle, as in the aerodynamics. The vehicle converts them to servo
/// commands. Beard & McLain, chapter 4.
struct Actuators {
  double throttle_frac = 0;  ///< throttle, 0 to 1
  double aileron_rad = 0;    ///< aileron deflection; positive rolls right
  double elevator_rad = 0;   ///< elevator deflection; positive is trailing edge down, nose down
  double rudder_rad = 0;     ///< rudder deflection; positive is trailing edge left, nose left
};

/// A surface turns by less than 90 deg: a larger value is an angle in degrees.
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<Actuators>{
    {{"aileron_rad", -std::numbers::pi / 2, std::numbers::pi / 2},
     {"elevator_rad", -std::numbers::pi / 2, std::numbers::pi / 2},
     {"rudder_rad", -std::numbers::pi / 2, std::numbers::pi / 2}}};

}  // namespace fulmar
