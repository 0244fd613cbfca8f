// SPDX-License-Identifier: BSD-3-Clause
// The alarms of SafetyState: flag, cause and text, the worst first. Every component that reports an alarm
// uses this table.
#pragma once
#include <array>

#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/safety_state.hpp"

namespace fulmar {

/// One alarm: its flag in SafetyState, the cause in notices, and the text for the pilot.
struct NamedAlarm {
  bool SafetyState::*flag;
  Cause cause;
  const char* words;
  bool SafetyState::*worse = nullptr;  ///< includes this one
};

inline constexpr std::array<NamedAlarm, 13> alarms{{
    {&SafetyState::engine_failed, Cause::engine_failed, "no thrust from the motor"},
    {&SafetyState::engine_weak, Cause::engine_weak, "weak motor", &SafetyState::engine_failed},
    {&SafetyState::battery_empty, Cause::battery_empty, "battery empty"},
    {&SafetyState::attitude_excessive, Cause::attitude_excessive, "excessive attitude"},
    {&SafetyState::estimator_failed, Cause::estimator_failed, "attitude, height or velocity not valid"},
    {&SafetyState::gnss_lost, Cause::gnss_lost, "no position"},
    {&SafetyState::battery_low, Cause::battery_low, "battery low", &SafetyState::battery_empty},
    {&SafetyState::pitot_lost, Cause::pitot_lost, "no airspeed"},
    {&SafetyState::wind_excessive, Cause::wind_excessive, "wind above the limit"},
    {&SafetyState::radio_lost, Cause::radio_lost, "pilot's radio lost"},
    {&SafetyState::link_lost, Cause::link_lost, "no vehicle status"},
    {&SafetyState::drifting, Cause::drifting, "wind above the top airspeed"},
    {&SafetyState::fence, Cause::fence, "fence"},
}};

/// The entry of `alarms` with this flag; the last entry when no alarm has it.
constexpr const NamedAlarm& alarm(bool SafetyState::*flag) {
  for (const NamedAlarm& a : alarms)
    if (a.flag == flag) return a;
  return alarms.back();
}

/// True when the flag is set and no worse alarm includes it.
constexpr bool is_raised(const NamedAlarm& a, const SafetyState& s) {
  return s.*a.flag && !(a.worse && s.*a.worse);
}

}  // namespace fulmar
