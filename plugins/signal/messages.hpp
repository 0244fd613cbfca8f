// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::signal_messages {
inline constexpr MessageText aborted_by_acceleration{
    "signal.aborted_by_acceleration", "signal aborted: guidance asks for an acceleration, not for a course"};
inline constexpr MessageText aborted_by_airspeed_high{
    "signal.aborted_by_airspeed_high", "signal aborted: airspeed is above the airframe's maximum"};
inline constexpr MessageText aborted_by_airspeed_low{"signal.aborted_by_airspeed_low",
                                                     "signal aborted: airspeed is below 1.1 times the stall"};
inline constexpr MessageText aborted_by_estimate{"signal.aborted_by_estimate",
                                                 "signal aborted: attitude, height or airspeed is not valid"};
inline constexpr MessageText aborted_by_height{"signal.aborted_by_height",
                                               "signal aborted: height has moved by height_bound"};
inline constexpr MessageText aborted_by_pilot{"signal.aborted_by_pilot",
                                              "signal aborted: commands do not move the aircraft"};
inline constexpr MessageText aborted_by_pitch{"signal.aborted_by_pitch",
                                              "signal aborted: pitch is beyond pitch_bound"};
inline constexpr MessageText aborted_by_roll{"signal.aborted_by_roll",
                                             "signal aborted: roll is beyond roll_bound"};

}  // namespace fulmar::signal_messages
