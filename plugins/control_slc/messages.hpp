// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::slc_messages {
inline constexpr MessageText airspeed_high{"slc.airspeed_high", "airspeed is above the maximum"};
inline constexpr MessageText airspeed_low{"slc.airspeed_low", "airspeed is near the stall"};
inline constexpr MessageText axis_kept{"slc.axis_kept",
                                       {"gains", "gain_margin", "phase_margin"},
                                       "{gains}  # kept: {gain_margin} dB, {phase_margin} deg measured"};
inline constexpr MessageText axis_not_tuned{
    "slc.axis_not_tuned", {"axis", "reason"}, "{axis}: not tuned: {reason}"};
inline constexpr MessageText axis_oscillates{
    "slc.axis_oscillates",
    {"axis", "factor"},
    "{axis} oscillates: its gains are multiplied by {factor} until they are changed"};
inline constexpr MessageText axis_reverted{
    "slc.axis_reverted", {"axis", "reason"}, "{axis}: old gains: {reason}"};
inline constexpr MessageText commands_ignored{"slc.commands_ignored", "commands do not move the aircraft"};
inline constexpr MessageText estimate_unknown{"slc.estimate_unknown",
                                              "attitude, height or airspeed is not known"};
inline constexpr MessageText gain_zero{"slc.gain_zero",
                                       "its gain is 0, and multiples of it are all that is tried"};
inline constexpr MessageText gains_missing{"slc.gains_missing", "no gains have the margins"};
inline constexpr MessageText gains_set{"slc.gains_set", "gains were set"};
inline constexpr MessageText height_moved{"slc.height_moved", "height has moved by height_bound"};
inline constexpr MessageText margins_not_held{"slc.margins_not_held", "the margins do not hold"};
inline constexpr MessageText other_component_active{"slc.other_component_active",
                                                    "another component was active"};
inline constexpr MessageText pitch_beyond_bound{"slc.pitch_beyond_bound", "pitch is beyond pitch_bound"};
inline constexpr MessageText roll_beyond_bound{"slc.roll_beyond_bound", "roll is beyond roll_bound"};
inline constexpr MessageText surface_at_limit{"slc.surface_at_limit", "the surface was at its limit"};
inline constexpr MessageText surface_missing{"slc.surface_missing", "the aircraft has no such surface"};
inline constexpr MessageText surface_without_answer{"slc.surface_without_answer",
                                                    "the surface does not act as it should"};
inline constexpr MessageText time_limit_over{"slc.time_limit_over", "time_limit is over"};
inline constexpr MessageText time_missing{"slc.time_missing", "time_limit leaves no time"};
inline constexpr MessageText tune_switched_off{"slc.tune_switched_off", "tune is switched off"};
inline constexpr MessageText turbulence_high{"slc.turbulence_high",
                                             "turbulence hides the answer to the excitation"};

}  // namespace fulmar::slc_messages
