// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::sim_aero_messages {

inline constexpr MessageText aileron_without_effect{"sim_aero.aileron_without_effect",
                                                    "the aileron does not roll it"};
inline constexpr MessageText aircraft_crashed{"sim_aero.aircraft_crashed", "the aircraft has crashed"};
inline constexpr MessageText balance_impossible{"sim_aero.balance_impossible",
                                                "no angles and deflections balance all forces and moments"};
inline constexpr MessageText brake_too_small{"sim_aero.brake_too_small",
                                             "the propeller would have to brake more than it does"};
inline constexpr MessageText elevator_without_effect{"sim_aero.elevator_without_effect",
                                                     "the elevator does not pitch it"};
inline constexpr MessageText fault_ramp_out_of_range{"sim_aero.fault_ramp_out_of_range",
                                                     "valid is 0 to 3600 s"};
inline constexpr MessageText fault_size_out_of_range{
    "sim_aero.fault_size_out_of_range", {"range"}, "valid is {range}"};
inline constexpr MessageText fault_time_out_of_range{"sim_aero.fault_time_out_of_range",
                                                     "valid is 0 to 1000000 s"};
inline constexpr MessageText fault_unknown{
    "sim_aero.fault_unknown", {"target", "kind", "valid"}, "{target} has no fault '{kind}'; valid: {valid}"};
inline constexpr MessageText fault_without_size{
    "sim_aero.fault_without_size", {"kind"}, "the fault '{kind}' has none"};
inline constexpr MessageText flow_beyond_tables{"sim_aero.flow_beyond_tables",
                                                {"angle", "value", "ends"},
                                                "{angle} {value} is beyond the tables of the airframe{ends}"};
inline constexpr MessageText ground_slope_unsupported{
    "sim_aero.ground_slope_unsupported",
    "the ground of earth: wgs84 follows the ellipsoid; use flat or gravity"};
inline constexpr MessageText icing_rate_missing{"sim_aero.icing_rate_missing",
                                                "icing needs its rate, share per second"};
inline constexpr MessageText inertia_not_definite{
    "sim_aero.inertia_not_definite",
    {"xz", "limit"},
    "the inertia is not positive definite: xz is {xz} kg m2, and its square has to be less than xx zz, so xz "
    "less than {limit} either way"};
inline constexpr MessageText instability_too_small{
    "sim_aero.instability_too_small",
    "a bias instability is below what noise and random walk alone leave within 30 times instability_time; a "
    "longer time, less noise, or a larger instability"};
inline constexpr MessageText jitter_too_large{
    "sim_aero.jitter_too_large",
    {"sensor"},
    "{sensor}.timing.jitter is more than 0.45 of the time between two samples, which would change places"};
inline constexpr MessageText latency_too_large{
    "sim_aero.latency_too_large",
    {"sensor"},
    "{sensor}.timing.latency is more than 63 samples are under way for"};
inline constexpr MessageText launch_in_air{"sim_aero.launch_in_air",
                                           "it begins in the air, by start_height; give one of them"};
inline constexpr MessageText level_flight_impossible{"sim_aero.level_flight_impossible",
                                                     {"airspeed", "reason"},
                                                     "no level flight at {airspeed} m/s: {reason}"};
inline constexpr MessageText lift_missing{"sim_aero.lift_missing",
                                          "the airframe has no lift: aero.lift.alpha is missing"};
inline constexpr MessageText motion_diverged{
    "sim_aero.motion_diverged",
    {"speed", "rate"},
    "the motion has left the model: speed {speed} m/s, body rate {rate} rad/s; a coefficient or inertia of "
    "the airframe is wrong, or the rate of the loop too low for it"};
inline constexpr MessageText pilot_flies{"sim_aero.pilot_flies", "the pilot flies"};
inline constexpr MessageText pilot_hands_over{"sim_aero.pilot_hands_over", "the pilot hands over"};
inline constexpr MessageText propeller_without_thrust{"sim_aero.propeller_without_thrust",
                                                      "the propeller has no thrust"};
inline constexpr MessageText start_below_ground{
    "sim_aero.start_below_ground", "the ground is higher at this place; ground_slope says how high"};
inline constexpr MessageText surface_too_small{
    "sim_aero.surface_too_small",
    {"airspeed", "needed", "surface", "limit"},
    "no level flight at {airspeed} m/s: it takes {needed} of {surface}, which moves {limit}; correct the "
    "airspeed, or the limit or effect of {surface}"};
inline constexpr MessageText thrust_missing{
    "sim_aero.thrust_missing", "the airframe has no thrust: propulsion.ct0 or propulsion.disc is missing"};
inline constexpr MessageText thrust_too_small{"sim_aero.thrust_too_small",
                                              "it takes more thrust than full throttle gives"};
inline constexpr MessageText wind_reference_low{"sim_aero.wind_reference_low",
                                                "the log profile has no wind as low as wind_roughness"};
inline constexpr MessageText wing_stalls{
    "sim_aero.wing_stalls",
    {"needed", "limit"},
    "the wing stalls: it would have to carry CL {needed}, and the most is {limit}"};

}  // namespace fulmar::sim_aero_messages
