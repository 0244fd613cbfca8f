// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText aileron_without_roll{
    "aero.aileron_without_roll",
    {"place"},
    "the aileron gives no roll moment; set aero.roll.aileron ({place})"};
inline constexpr MessageText airframe_map_expected{
    "aero.airframe_map_expected",
    {"found"},
    "expected a map with the fields of an airframe, such as mass, wing and aero; found {found}"};
inline constexpr MessageText airspeed_out_of_range{
    "aero.airspeed_out_of_range", {"found"}, "'{found}' is outside 1 .. 200 m/s"};
inline constexpr MessageText airspeed_range_reversed{
    "aero.airspeed_range_reversed",
    {"found"},
    "'{found}': the first speed is above the last one; exchange them"};
inline constexpr MessageText altitude_out_of_range{
    "aero.altitude_out_of_range", {"found"}, "'{found}' is outside -1000 .. 20000 m"};
inline constexpr MessageText bandwidth_loop_unknown{
    "aero.bandwidth_loop_unknown",
    {"found", "choices"},
    "'{found}' does not begin with a loop, as in \"roll=8 rad/s\".{choices}"};
inline constexpr MessageText bandwidth_too_high{
    "aero.bandwidth_too_high",
    {"loop", "found", "actuator", "actuator_lag", "half_step", "delay", "lag", "limit", "place"},
    "{loop}: {found} rad/s is above {limit} rad/s, the limit of the {actuator}. Its lag is {lag}: "
    "{actuator_lag}, half a step {half_step} and delay {delay} ({place}). Reduce --bandwidth"};
inline constexpr MessageText braking_insufficient{
    "aero.braking_insufficient",
    {"required", "available", "place"},
    "the flight requires a braking force of {required} N, and the propeller brakes with {available} N at "
    "zero throttle. Descend less steeply, or fly faster{place}"};
inline constexpr MessageText climb_too_steep{
    "aero.climb_too_steep", {"found"}, "'{found}' is steeper than 80 deg at this airspeed"};
inline constexpr MessageText climb_unit_invalid{
    "aero.climb_unit_invalid",
    {"found"},
    "'{found}' is neither an angle, as in \"5 deg\", nor a rate, as in \"2 m/s\""};
inline constexpr MessageText closed_loops_unstable{
    "aero.closed_loops_unstable",
    {"count"},
    "the closed loops are unstable: {count} of their poles grow. Reduce --bandwidth"};
inline constexpr MessageText command_unknown{"aero.command_unknown",
                                             {"command", "choices"},
                                             "fulmar aero: the command '{command}' does not exist.{choices}"};
inline constexpr MessageText component_unknown{
    "aero.component_unknown",
    {"component", "choices"},
    "params: the component '{component}' does not exist.{choices}"};
inline constexpr MessageText elevator_without_pitch{
    "aero.elevator_without_pitch",
    {"place"},
    "the elevator gives no pitch moment; set aero.pitch.elevator ({place})"};
inline constexpr MessageText entry_form_unsupported{
    "aero.entry_form_unsupported",
    {"entry"},
    "this command cannot edit the form of {entry}; the file is unchanged. Write a number on the line of its "
    "key without quotes or anchor, and a section as a map without alias"};
inline constexpr MessageText equilibrium_missing{
    "aero.equilibrium_missing",
    {"file"},
    "no angles and deflections balance all forces and moments. Correct the coefficients that `fulmar aero "
    "check {file}` reports. If it reports none, choose another airspeed, bank or climb"};
inline constexpr MessageText flight_acceptable{"aero.flight_acceptable", "flown; the gains are in the file"};
inline constexpr MessageText flight_condition{
    "aero.flight_condition",
    {"condition", "airspeed", "altitude"},
    "{condition} at {airspeed} m/s, {altitude} m above mean sea level"};
inline constexpr MessageText flight_folder_missing{
    "aero.flight_folder_missing",
    {"folder", "reason"},
    "the folder {folder} of the flight cannot be made: {reason}. Set TMPDIR to a writable folder"};
inline constexpr MessageText flight_impossible{"aero.flight_impossible",
                                               {"condition", "reason", "default_hint"},
                                               "no {condition}: {reason}{default_hint}"};
inline constexpr MessageText flight_skipped{
    "aero.flight_skipped", {"command"}, "not flown: `fulmar aero {command}` has failed"};
inline constexpr MessageText flight_unacceptable{"aero.flight_unacceptable", "flown, with faults"};
inline constexpr MessageText fulmar_program_missing{
    "aero.fulmar_program_missing",
    "fulmar aero tune --verify: the program fulmar is missing in the folder of this program; install Fulmar "
    "again"};
inline constexpr MessageText gain_form_unsupported{
    "aero.gain_form_unsupported",
    {"component", "gain"},
    "this command cannot edit the form of {component}.{gain}; the file is unchanged. Write it as a number on "
    "the line of its key"};
inline constexpr MessageText gain_increase_small{
    "aero.gain_increase_small",
    {"loop", "place", "margin"},
    "{loop}, broken at the {place}: the gain margin is {margin} dB upwards; at least 6 dB are required. "
    "Reduce its --bandwidth"};
inline constexpr MessageText gain_reduction_small{
    "aero.gain_reduction_small",
    {"loop", "place", "margin"},
    "{loop}, broken at the {place}: the gain margin is {margin} dB downwards; at least 6 dB are required. "
    "Change its --bandwidth"};
inline constexpr MessageText hourglass_bound_missed{
    "aero.hourglass_bound_missed",
    {"figure", "found", "unit", "bound"},
    "{figure} on the hourglass is {found} {unit}; required: {bound}. Change --bandwidth"};
inline constexpr MessageText hourglass_not_flown{
    "aero.hourglass_not_flown", {"result"}, "the hourglass was not flown: {result}"};
inline constexpr MessageText hourglass_result{
    "aero.hourglass_result", {"result"}, "hourglass in light turbulence: {result}"};
inline constexpr MessageText inertia_not_positive_definite{
    "aero.inertia_not_positive_definite",
    {"xz_squared", "xx_zz"},
    "inertia: the tensor is not positive definite: xz^2 = {xz_squared} must be less than xx zz = {xx_zz}. "
    "Correct xz, xx or zz"};
inline constexpr MessageText output_not_writable{
    "aero.output_not_writable",
    "the file cannot be written. Check that its folder exists and is writable, and that the disk has space"};
inline constexpr MessageText parameter_unknown{"aero.parameter_unknown",
                                               {"parameter", "choices"},
                                               "the parameter '{parameter}' does not exist.{choices}"};
inline constexpr MessageText params_empty{
    "aero.params_empty", "params: the key has no entries; remove the key, and the command writes it"};
inline constexpr MessageText phase_margin_small{"aero.phase_margin_small",
                                                {"loop", "place", "margin"},
                                                "{loop}, broken at the {place}: the phase margin is {margin} "
                                                "deg; at least 45 deg are required. Reduce its --bandwidth"};
inline constexpr MessageText picture_not_writable{
    "aero.picture_not_writable",
    {"file"},
    "'{file}' cannot be written. Check that its folder exists and is writable, and that the disk has space"};
inline constexpr MessageText propeller_without_thrust{
    "aero.propeller_without_thrust", {"place"}, "the propeller has no thrust; set propulsion.ct0 ({place})"};
inline constexpr MessageText shipped_file_read_only{
    "aero.shipped_file_read_only",
    "files of the installation are read-only; copy the file and name the copy"};
inline constexpr MessageText speed_step_invalid{
    "aero.speed_step_invalid", {"limit"}, "the step must be above 0 and give at most {limit} speeds"};
inline constexpr MessageText stall_airspeed_required{
    "aero.stall_airspeed_required", {"airspeed"}, "; this CL requires {airspeed} m/s"};
inline constexpr MessageText stall_in_flight{
    "aero.stall_in_flight",
    {"time", "airspeed", "bank", "limit"},
    "stalled at {time} s: at {airspeed} m/s and {bank} of bank, the angle of attack exceeds the {limit} of "
    "maximum lift and stays there"};
inline constexpr MessageText surface_throw_exceeded{
    "aero.surface_throw_exceeded",
    {"required", "surface", "throw_limit", "place"},
    "the flight requires {required} of {surface}, which moves {throw_limit} either way ({place}). Choose "
    "another airspeed, bank or climb, or correct the throw"};
inline constexpr MessageText table_invalid{
    "aero.table_invalid", {"index", "reason"}, "aero.tables[{index}].{reason}"};
inline constexpr MessageText thrust_insufficient{
    "aero.thrust_insufficient",
    {"required", "available", "place"},
    "the flight requires {required} N of thrust, and full throttle gives {available} N. Choose another "
    "airspeed or a smaller climb or bank, or correct the thrust{place}"};
inline constexpr MessageText tuning_assumptions{
    "aero.tuning_assumptions",
    {"step", "delay", "aileron", "elevator", "throttle"},
    "assumed: a step of {step}, delay {delay}; with the servos' lag, aileron {aileron}, elevator {elevator}, "
    "throttle {throttle}"};
inline constexpr MessageText tuning_out_of_range{"aero.tuning_out_of_range",
                                                 {"found", "minimum", "maximum", "unit"},
                                                 "'{found}' is outside {minimum} .. {maximum} {unit}"};
inline constexpr MessageText turn_out_of_range{
    "aero.turn_out_of_range",
    {"found"},
    "'{found}' is outside the range of turns; give a bank up to 80 deg or a radius from 1 m"};
inline constexpr MessageText turn_unit_invalid{
    "aero.turn_unit_invalid",
    {"found"},
    "'{found}' is neither a bank, as in \"30 deg\", nor a radius, as in \"80 m\""};
inline constexpr MessageText value_not_positive{
    "aero.value_not_positive",
    {"found", "unit"},
    "{found}{unit} is not above 0; the aircraft model requires a positive value"};
inline constexpr MessageText wing_stalls{"aero.wing_stalls",
                                         {"required", "maximum", "alpha", "hint", "place"},
                                         "the wing stalls: the flight requires CL {required}, and the "
                                         "maximum is {maximum} at {alpha}{hint} ({place})"};

}  // namespace fulmar::aero_messages
