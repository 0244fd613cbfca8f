// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::joystick_messages {
inline constexpr MessageText device_invalid{
    "joystick.device_invalid",
    {"path"},
    "{path} is neither a device nor a pipe. Name one, such as /dev/input/js0 or /dev/tty"};
inline constexpr MessageText device_missing{
    "joystick.device_missing", "the device is not set. Name one, such as /dev/input/js0 or /dev/tty"};
inline constexpr MessageText permission_missing{"joystick.permission_missing",
                                                "no permission; join the group input"};
inline constexpr MessageText pilot_absent{
    "joystick.pilot_absent", {"device", "reason"}, "{device}: the pilot is not there: {reason}"};
inline constexpr MessageText pilot_back{"joystick.pilot_back", {"device"}, "{device}: the pilot is back"};
inline constexpr MessageText pilot_lost{
    "joystick.pilot_lost", {"device", "reason"}, "{device}: the pilot is lost: {reason}"};
inline constexpr MessageText pilot_present{
    "joystick.pilot_present", {"device"}, "{device}: the pilot is there"};
inline constexpr MessageText records_foreign{"joystick.records_foreign",
                                             "its data is not that of a joystick"};
inline constexpr MessageText sender_missing{"joystick.sender_missing", "no sender"};
inline constexpr MessageText terminal_in_use{"joystick.terminal_in_use",
                                             "the terminal belongs to another program"};
inline constexpr MessageText terminal_setup_failed{"joystick.terminal_setup_failed",
                                                   "the terminal cannot be set up"};

}  // namespace fulmar::joystick_messages
