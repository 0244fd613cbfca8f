// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Severity : std::uint8_t { info, warning, error, critical };

/// Subject of a notice, the same for all components that report it: one alert for each. Those of SafetyState
/// have the name of its flag. New ones are appended.
enum class Cause : std::uint8_t {
  none,
  fence,
  gnss_lost,
  pitot_lost,
  radio_lost,
  link_lost,
  battery_low,
  battery_empty,
  attitude_excessive,
  engine_failed,
  wind_excessive,
  estimator_failed,
  engine_weak,
  drifting,
  gyro,
  accelerometer,
  magnetometer,
  barometer,
  gnss_velocity,
  inertial,
  bank,
  pitch
};

/// One line for the terminal and the log. A port of notices is printed if the mission lists it under `tell:`.
struct Notice {
  Text<96> text;                       ///< text of the notice
  Severity severity = Severity::info;  ///< severity of the notice
  Cause cause = Cause::none;           ///< subject of the notice; with `info`: end of the alert
};

template <>
inline constexpr std::string_view appended_from<Notice> = "cause";

}  // namespace fulmar
