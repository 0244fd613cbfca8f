// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sim_aero_messages {

inline constexpr MessageText aileron_without_effect{
    "sim_aero.aileron_without_effect", "the aileron does not roll the aircraft. Set aero.roll.aileron"};
inline constexpr MessageText aircraft_crashed{
    "sim_aero.aircraft_crashed", "the aircraft has crashed and cannot arm: start the flight again"};
inline constexpr MessageText balance_impossible{
    "sim_aero.balance_impossible",
    "no angles and deflections balance all forces and moments. Choose another airspeed, or check the "
    "coefficients with 'fulmar aero check'"};
inline constexpr MessageText brake_too_small{"sim_aero.brake_too_small",
                                             "the propeller would have to brake more than it does at zero "
                                             "throttle. Correct the drag, or choose another airspeed"};
inline constexpr MessageText elevator_without_effect{
    "sim_aero.elevator_without_effect", "the elevator does not pitch the aircraft. Set aero.pitch.elevator"};
inline constexpr MessageText fault_ramp_out_of_range{
    "sim_aero.fault_ramp_out_of_range", {"found"}, "{found} s is outside the range of 0 to 3600 s"};
inline constexpr MessageText fault_size_out_of_range{
    "sim_aero.fault_size_out_of_range", {"found", "range"}, "{found} is outside the range of {range}"};
inline constexpr MessageText fault_time_out_of_range{
    "sim_aero.fault_time_out_of_range", {"found"}, "{found} s is outside the range of 0 to 1000000 s"};
inline constexpr MessageText fault_unknown{
    "sim_aero.fault_unknown", {"target", "kind", "valid"}, "{target} has no fault '{kind}'; valid: {valid}"};
inline constexpr MessageText fault_without_size{
    "sim_aero.fault_without_size", {"kind"}, "the fault '{kind}' has no size: leave it at 0"};
inline constexpr MessageText flow_beyond_tables{"sim_aero.flow_beyond_tables",
                                                {"angle", "value", "ends"},
                                                "{angle} {value} is beyond the tables of the airframe{ends}. "
                                                "Extend airframe.aero.tables, or avoid this angle"};
inline constexpr MessageText ground_slope_unsupported{
    "sim_aero.ground_slope_unsupported",
    "earth: wgs84 does not permit a slope of the ground. Set ground_slope to 0, or earth to flat or gravity"};
inline constexpr MessageText icing_rate_missing{
    "sim_aero.icing_rate_missing", "icing requires its rate as the size: give a share per second above 0"};
inline constexpr MessageText inertia_not_definite{
    "sim_aero.inertia_not_definite",
    {"xz", "limit"},
    "xz is {xz} kg m2, so the inertia is not positive definite. Give a magnitude below {limit}, the square "
    "root of xx times zz"};
inline constexpr MessageText instability_too_small{
    "sim_aero.instability_too_small",
    {"found", "limit"},
    "a bias instability is {found} (SI unit), less than the {limit} that noise and walk of this gyro or "
    "accelerometer cause. Increase instability or instability_time, or reduce noise or walk"};
inline constexpr MessageText jitter_too_large{"sim_aero.jitter_too_large",
                                              {"sensor", "jitter", "limit"},
                                              "{sensor}.timing.jitter is {jitter} s, more than 0.45 of the "
                                              "time between two samples. Give at most {limit} s"};
inline constexpr MessageText latency_too_large{"sim_aero.latency_too_large",
                                               {"sensor", "latency", "limit"},
                                               "{sensor}.timing.latency is {latency} s, longer than 63 "
                                               "samples. Give at most {limit} s, or a lower rate"};
inline constexpr MessageText launch_in_air{"sim_aero.launch_in_air",
                                           "start_height begins the flight in the air, where no launch is "
                                           "possible. Set launch to none, or start_height to 0"};
inline constexpr MessageText level_flight_impossible{"sim_aero.level_flight_impossible",
                                                     {"airspeed", "reason"},
                                                     "no level flight at {airspeed} m/s: {reason}"};
inline constexpr MessageText lift_missing{"sim_aero.lift_missing",
                                          "the airframe has no lift: set aero.lift.alpha above 0"};
inline constexpr MessageText motion_diverged{
    "sim_aero.motion_diverged",
    {"speed", "rate"},
    "the motion has left the model: speed {speed} m/s, body rate {rate} rad/s. Check coefficients and "
    "inertia of the airframe with 'fulmar aero check', or increase the rate of the loop"};
inline constexpr MessageText pilot_flies{"sim_aero.pilot_flies", "the pilot flies"};
inline constexpr MessageText pilot_hands_over{"sim_aero.pilot_hands_over", "the pilot hands over"};
inline constexpr MessageText propeller_without_thrust{
    "sim_aero.propeller_without_thrust",
    "the propeller has no thrust. Set propulsion.ct0 or propulsion.disc"};
inline constexpr MessageText start_below_ground{
    "sim_aero.start_below_ground",
    {"found", "least"},
    "{found} m is below the ground at this place. Start at {least} m or more, or reduce ground_slope"};
inline constexpr MessageText surface_too_small{
    "sim_aero.surface_too_small",
    {"airspeed", "needed", "surface", "limit"},
    "no level flight at {airspeed} m/s: it takes {needed} of {surface}, which moves {limit}; correct the "
    "airspeed, or the limit or effect of {surface}"};
inline constexpr MessageText thrust_missing{
    "sim_aero.thrust_missing", "the airframe has no thrust: set propulsion.ct0 or propulsion.disc"};
inline constexpr MessageText thrust_too_small{
    "sim_aero.thrust_too_small",
    "level flight takes more thrust than full throttle gives. Choose a lower airspeed, or correct the "
    "propulsion, the drag or the mass"};
inline constexpr MessageText wind_reference_low{"sim_aero.wind_reference_low",
                                                {"reference", "roughness"},
                                                "{reference} m is not above wind_roughness, {roughness} m. "
                                                "Set wind_reference above it for the log profile"};
inline constexpr MessageText wing_stalls{"sim_aero.wing_stalls",
                                         {"needed", "limit"},
                                         "the wing stalls: it needs CL {needed}, and its maximum is {limit}. "
                                         "Choose a higher airspeed, or correct the mass or the lift"};

}  // namespace fulmar::sim_aero_messages
