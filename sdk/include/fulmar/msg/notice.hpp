// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Severity : std::uint8_t { info, warning, error, critical };

/// What a notice is about, the same for all components that report it: an alert for each. Those of
/// SafetyState have the name of its flag. New ones are appended.
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

/// One line for the person at the terminal and for the log. A port of notices is told when the mission lists
/// it under `tell:`.
struct Notice {
  Text<96> text;
  Severity severity = Severity::info;
  Cause cause = Cause::none;  ///< with `info`: it is over
};

template <>
inline constexpr std::string_view appended_from<Notice> = "cause";

}  // namespace fulmar
