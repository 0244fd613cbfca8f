// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sim_messages {

inline constexpr MessageText batch_empty{"sim.batch_empty", "a batch has one aircraft or more"};
inline constexpr MessageText batch_threads_invalid{"sim.batch_threads_invalid",
                                                   "a batch has 1 to 256 threads"};
inline constexpr MessageText battery_capacity_missing{"sim.battery_capacity_missing",
                                                      "it needs the battery's `capacity`"};
inline constexpr MessageText battery_curve_mismatched{
    "sim.battery_curve_mismatched",
    {"used", "open"},
    "{used} values of `used` and {open} of `open`: there must be as many"};
inline constexpr MessageText battery_curve_not_rising{
    "sim.battery_curve_not_rising",
    {"value", "before"},
    "the list has to rise, and {value} comes after {before}"};
inline constexpr MessageText battery_curve_start_wrong{
    "sim.battery_curve_start_wrong", {"full"}, "it must begin with the full battery: used 0, open {full} V"};
inline constexpr MessageText battery_empty_high{
    "sim.battery_empty_high",
    {"empty", "full"},
    "it is {empty} V, more than the {full} V of the full battery"};
inline constexpr MessageText command_not_finite{
    "sim.command_not_finite", {"command", "found"}, "{command} is {found}"};
inline constexpr MessageText contacts_beside{
    "sim.contacts_beside", {"where"}, "all of them are {where} the centre of gravity: it would tip over"};
inline constexpr MessageText contacts_few{
    "sim.contacts_few", {"count"}, "an aircraft stands on at least 3 contacts, and here are {count}"};
inline constexpr MessageText contacts_on_line{"sim.contacts_on_line",
                                              "all of them are on one line: it would fall over"};
inline constexpr MessageText contacts_shares_wrong{
    "sim.contacts_shares_wrong",
    {"sum"},
    "their shares of the weight, `carries`, sum to {sum} and must to 1"};
inline constexpr MessageText contacts_without_rest{"sim.contacts_without_rest",
                                                   "it does not come to rest on them"};
inline constexpr MessageText number_count_invalid{
    "sim.number_count_invalid",
    {"aircraft", "columns", "found"},
    "{aircraft} x {columns} numbers are expected, {found} were given"};
inline constexpr MessageText propeller_in_middle{
    "sim.propeller_in_middle",
    "a propeller at y = 0 does not yaw the aircraft. Set its differential to 0, or move it to one side."};
inline constexpr MessageText propeller_without_rudder{
    "sim.propeller_without_rudder", "it is a part of full throttle at full rudder, and rudder.limit is 0"};
inline constexpr MessageText servo_fixed{
    "sim.servo_fixed",
    {"lower", "upper"},
    "the servo would stop at {lower} rad below and at {upper} rad above: it cannot move"};
inline constexpr MessageText state_beyond_model{
    "sim.state_beyond_model",
    "the state is beyond the model, which ends at 1e5 m/s and rad/s and 1e8 m from the origin"};
inline constexpr MessageText state_not_finite{"sim.state_not_finite",
                                              "the state has a number that is not finite"};
inline constexpr MessageText state_not_normalised{"sim.state_not_normalised",
                                                  "the attitude's quaternion is not of length 1"};
inline constexpr MessageText step_invalid{
    "sim.step_invalid", {"step"}, "dt is {step} s and must be in (0, 0.1] s"};
inline constexpr MessageText table_ends{
    "sim.table_ends", {"lower", "upper"}, ", which end at {lower} and {upper} deg"};

}  // namespace fulmar::sim_messages
