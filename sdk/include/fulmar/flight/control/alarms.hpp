// SPDX-License-Identifier: BSD-3-Clause
// The alarms of SafetyState: flag, cause and text, the worst first. Every component that reports an alarm
// uses this table.
#pragma once
#include <array>

#include "fulmar/flight/messages.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/safety_state.hpp"

namespace fulmar {

/// One alarm: its flag in SafetyState, the cause in notices, and the text for the pilot.
struct [[gnu::visibility("hidden")]] NamedAlarm {
  bool SafetyState::*flag;
  Cause cause;
  const MessageText<0>* message;
  bool SafetyState::*worse = nullptr;  ///< worse alarm that includes this one

  const char* words() const { return message->c_str(); }
};

inline constexpr std::array<NamedAlarm, 13> alarms{{
    {&SafetyState::engine_failed, Cause::engine_failed, &flight_messages::engine_failed},
    {&SafetyState::engine_weak, Cause::engine_weak, &flight_messages::engine_weak,
     &SafetyState::engine_failed},
    {&SafetyState::battery_empty, Cause::battery_empty, &flight_messages::battery_empty},
    {&SafetyState::attitude_excessive, Cause::attitude_excessive, &flight_messages::attitude_excessive},
    {&SafetyState::estimator_failed, Cause::estimator_failed, &flight_messages::estimator_failed},
    {&SafetyState::gnss_lost, Cause::gnss_lost, &flight_messages::gnss_lost},
    {&SafetyState::battery_low, Cause::battery_low, &flight_messages::battery_low,
     &SafetyState::battery_empty},
    {&SafetyState::pitot_lost, Cause::pitot_lost, &flight_messages::pitot_lost},
    {&SafetyState::wind_excessive, Cause::wind_excessive, &flight_messages::wind_excessive},
    {&SafetyState::radio_lost, Cause::radio_lost, &flight_messages::radio_lost},
    {&SafetyState::link_lost, Cause::link_lost, &flight_messages::link_lost},
    {&SafetyState::drifting, Cause::drifting, &flight_messages::drifting},
    {&SafetyState::fence, Cause::fence, &flight_messages::fence},
}};

/// Entry of `alarms` with this flag; the last entry if no alarm has it.
constexpr const NamedAlarm& alarm(bool SafetyState::*flag) {
  for (const NamedAlarm& a : alarms)
    if (a.flag == flag) return a;
  return alarms.back();
}

/// True if the flag is set and no worse alarm includes it.
constexpr bool is_raised(const NamedAlarm& a, const SafetyState& s) {
  return s.*a.flag && !(a.worse && s.*a.worse);
}

}  // namespace fulmar
