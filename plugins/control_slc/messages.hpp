// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::control_slc_messages {
inline constexpr MessageText airspeed_high{"control_slc.airspeed_high", "airspeed is above the maximum"};
inline constexpr MessageText airspeed_low{"control_slc.airspeed_low", "airspeed is near the stall"};
inline constexpr MessageText axis_kept{"control_slc.axis_kept",
                                       {"gains", "gain_margin", "phase_margin"},
                                       "{gains}  # kept: {gain_margin} dB, {phase_margin} deg measured"};
inline constexpr MessageText axis_not_tuned{
    "control_slc.axis_not_tuned", {"axis", "reason"}, "{axis}: not tuned: {reason}"};
inline constexpr MessageText axis_oscillates{
    "control_slc.axis_oscillates",
    {"axis", "factor"},
    "{axis} oscillates: its gains are multiplied by {factor} until they are changed"};
inline constexpr MessageText axis_reverted{
    "control_slc.axis_reverted", {"axis", "reason"}, "{axis}: old gains restored: {reason}"};
inline constexpr MessageText commands_ignored{"control_slc.commands_ignored",
                                              "commands do not move the aircraft"};
inline constexpr MessageText estimate_unknown{"control_slc.estimate_unknown",
                                              "attitude, height or airspeed is not valid"};
inline constexpr MessageText gain_zero{"control_slc.gain_zero",
                                       "its gain is 0, and the search multiplies it: set it above 0"};
inline constexpr MessageText gains_missing{"control_slc.gains_missing", "no gains reach the margins"};
inline constexpr MessageText gains_set{"control_slc.gains_set", "gains were set"};
inline constexpr MessageText height_moved{"control_slc.height_moved", "height has moved by height_bound"};
inline constexpr MessageText margins_not_held{"control_slc.margins_not_held",
                                              "the measured margins are too small"};
inline constexpr MessageText other_component_active{"control_slc.other_component_active",
                                                    "another component was active"};
inline constexpr MessageText pitch_beyond_bound{"control_slc.pitch_beyond_bound",
                                                "pitch is beyond pitch_bound"};
inline constexpr MessageText roll_beyond_bound{"control_slc.roll_beyond_bound", "roll is beyond roll_bound"};
inline constexpr MessageText surface_at_limit{"control_slc.surface_at_limit", "the surface was at its limit"};
inline constexpr MessageText surface_missing{"control_slc.surface_missing",
                                             "the aircraft has no such surface"};
inline constexpr MessageText surface_without_answer{"control_slc.surface_without_answer",
                                                    "the aircraft does not follow the surface"};
inline constexpr MessageText time_limit_over{"control_slc.time_limit_over", "time_limit is over"};
inline constexpr MessageText time_missing{"control_slc.time_missing", "time_limit is too short: increase it"};
inline constexpr MessageText tune_switched_off{"control_slc.tune_switched_off", "tune is switched off"};
inline constexpr MessageText turbulence_high{"control_slc.turbulence_high",
                                             "turbulence hides the answer to the excitation"};

}  // namespace fulmar::control_slc_messages
