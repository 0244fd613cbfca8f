// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sim_messages {

inline constexpr MessageText batch_empty{"sim.batch_empty",
                                         "the batch has no aircraft: set the count of aircraft to 1 or more"};
inline constexpr MessageText batch_threads_invalid{
    "sim.batch_threads_invalid", {"threads"}, "{threads} threads are outside the range of a batch, 1 to 256"};
inline constexpr MessageText battery_capacity_missing{
    "sim.battery_capacity_missing",
    "a discharge curve requires the capacity of the battery: set `capacity` above 0, or remove the curve"};
inline constexpr MessageText battery_curve_mismatched{
    "sim.battery_curve_mismatched",
    {"used", "open"},
    "`used` has {used} values and `open` has {open}: give both the same number of values"};
inline constexpr MessageText battery_curve_not_rising{
    "sim.battery_curve_not_rising",
    {"value", "before"},
    "{value} follows {before}: each value must exceed the one before it"};
inline constexpr MessageText battery_curve_start_wrong{
    "sim.battery_curve_start_wrong",
    {"full"},
    "the first point is not the full battery: begin `used` with 0 and `open` with {full} V"};
inline constexpr MessageText battery_empty_high{
    "sim.battery_empty_high",
    {"empty", "full"},
    "{empty} V is more than the {full} V of the full battery: give a lower voltage"};
inline constexpr MessageText command_not_finite{
    "sim.command_not_finite", {"command", "found"}, "{command} is {found}: give a finite number"};
inline constexpr MessageText contacts_beside{"sim.contacts_beside",
                                             {"where"},
                                             "all contacts are {where} the centre of gravity, so the "
                                             "aircraft tips over: place the contacts around it"};
inline constexpr MessageText contacts_few{
    "sim.contacts_few",
    {"count"},
    "there are {count} contacts, and an aircraft stands on 3 or more: add contacts"};
inline constexpr MessageText contacts_on_line{
    "sim.contacts_on_line",
    "all contacts are on one line, so the aircraft falls over: move at least one contact off the line"};
inline constexpr MessageText contacts_shares_wrong{
    "sim.contacts_shares_wrong",
    {"sum"},
    "the shares of the weight, `carries`, sum to {sum}: they must sum to 1"};
inline constexpr MessageText contacts_without_rest{
    "sim.contacts_without_rest",
    "the aircraft does not come to rest on these contacts: correct their places `at` and shares `carries`"};
inline constexpr MessageText number_count_invalid{
    "sim.number_count_invalid",
    {"aircraft", "columns", "found"},
    "found {found} numbers; expected {aircraft} x {columns}, one row for each aircraft"};
inline constexpr MessageText propeller_in_middle{
    "sim.propeller_in_middle",
    "a propeller at y = 0 does not yaw the aircraft. Set its differential to 0, or move it to one side."};
inline constexpr MessageText propeller_without_rudder{
    "sim.propeller_without_rudder",
    "a differential of the propellers requires a rudder, and rudder.limit is 0. Set rudder.limit above 0, or "
    "the differential to 0"};
inline constexpr MessageText servo_fixed{"sim.servo_fixed",
                                         {"lower", "upper"},
                                         "the servo cannot move: its lower stop, {lower} rad, is not below "
                                         "its upper stop, {upper} rad. Correct its limit, min or max"};
inline constexpr MessageText state_beyond_model{
    "sim.state_beyond_model",
    "the state is beyond the model: give at most 1e5 m/s and 1e5 rad/s, and at most 1e8 m from the origin"};
inline constexpr MessageText state_not_finite{
    "sim.state_not_finite", "a number of the state is NaN or infinite: give finite numbers"};
inline constexpr MessageText state_not_normalised{
    "sim.state_not_normalised", "the quaternion of the attitude does not have length 1: normalise it"};
inline constexpr MessageText step_invalid{
    "sim.step_invalid", {"step"}, "dt is {step} s: give more than 0 s, and at most 0.1 s"};
inline constexpr MessageText table_ends{
    "sim.table_ends", {"lower", "upper"}, ", which end at {lower} and {upper} deg"};

}  // namespace fulmar::sim_messages
