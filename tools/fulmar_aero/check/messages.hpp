// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::aero_messages {

inline constexpr MessageText adverse_yaw_high{
    "aero.adverse_yaw_high",
    {"value", "ratio"},
    "Cn_da is {value}, {ratio} of Cl_da: the adverse yaw is very high; aircraft have up to 0.15 of Cl_da. "
    "Check its value and axes"};
inline constexpr MessageText airspeeds_not_increasing{
    "aero.airspeeds_not_increasing",
    {"minimum", "cruise", "maximum"},
    "the airspeeds {minimum}, {cruise} and {maximum} m/s must increase: limits.airspeed_min, "
    "airspeed_cruise, airspeed_max. Correct one of them"};
inline constexpr MessageText angle_in_degrees{
    "aero.angle_in_degrees", {"angle"}, ". The value may be in degrees; write '{angle} deg'"};
inline constexpr MessageText angle_too_large{
    "aero.angle_too_large",
    {"angle", "in_degrees", "limit", "hint"},
    "the angle is {angle} rad, {in_degrees}; valid: up to {limit}{hint}"};
inline constexpr MessageText area_unit_suspect{"aero.area_unit_suspect", "The area may be in another unit"};
inline constexpr MessageText aspect_ratio_unusual{
    "aero.aspect_ratio_unusual",
    {"aspect_ratio"},
    "the aspect ratio b^2/S is {aspect_ratio}; wings have 2 to 40. Check span and area, and their units"};
inline constexpr MessageText coefficient_zero{
    "aero.coefficient_zero", {"symbol"}, "{symbol} is 0 or missing, which no aircraft has; set it"};
inline constexpr MessageText coefficients_copied{
    "aero.coefficients_copied",
    {"same", "total", "aircraft"},
    "{same} of {total} coefficients are exactly those of the {aircraft}, but wing area or span is not. They "
    "may be copies; check them"};
inline constexpr MessageText cross_derivative_nonzero{
    "aero.cross_derivative_nonzero",
    {"value"},
    "the value is {value}, and a symmetric aircraft has 0: the analysis has not converged, or the column is "
    "another one. Set it to 0, or correct the analysis"};
inline constexpr MessageText cruise_lift_unusual{"aero.cruise_lift_unusual",
                                                 {"lift_coefficient"},
                                                 "CL in cruise is {lift_coefficient}; the usual range is 0.2 "
                                                 "to 0.9. Mass, area or airspeed is in another unit"};
inline constexpr MessageText cruise_throttle_invalid{
    "aero.cruise_throttle_invalid",
    {"throttle"},
    "the cruise throttle is {throttle}; valid: a fraction of full throttle, 0 to 1"};
inline constexpr MessageText dead_band_unusual{
    "aero.dead_band_unusual",
    {"dead_band"},
    "the dead band is {dead_band}; servos have 0.1 to 1 deg. The value may be in degrees"};
inline constexpr MessageText derivative_converted_twice{
    "aero.derivative_converted_twice",
    {"corrected"},
    ": the value may be converted from degrees twice; it would then be {corrected} per rad"};
inline constexpr MessageText derivative_omitted{
    "aero.derivative_omitted",
    {"symbol"},
    "{symbol} is 0; the coefficient may be missing. Set it if it is known"};
inline constexpr MessageText derivative_outside_class{
    "aero.derivative_outside_class",
    {"symbol", "value", "low", "high", "distance"},
    "{symbol} {value} ({low} to {high}, off by {distance} of that range)"};
inline constexpr MessageText derivative_per_degree{
    "aero.derivative_per_degree",
    {"corrected"},
    ": the value may be per degree; it would then be {corrected} per rad"};
inline constexpr MessageText derivative_sign_wrong{"aero.derivative_sign_wrong",
                                                   {"symbol", "value", "sign", "consequence"},
                                                   "{symbol} is {value}, but must be {sign}: {consequence}"};
inline constexpr MessageText derivative_unusual{"aero.derivative_unusual",
                                                {"symbol", "value", "low", "high", "hint"},
                                                "{symbol} is {value}; aircraft have {low} to {high}{hint}"};
inline constexpr MessageText drag_sided{
    "aero.drag_sided",
    {"value"},
    "the value is {value}: the drag of a symmetric aircraft cannot increase to one side and decrease to the "
    "other. A term of the square belongs in drag_squared"};
inline constexpr MessageText elevator_drag_excessive{
    "aero.elevator_drag_excessive",
    {"change", "parasite_drag"},
    "full elevator reduces CD by {change}, more than the parasite drag {parasite_drag}: the elevator would "
    "drive the aircraft. The term is linear; the value may be that of a square, CD_de de^2"};
inline constexpr MessageText elevator_trim_unusual{
    "aero.elevator_trim_unusual",
    {"trim", "required"},
    "the value is {trim}, but level cruise requires {required}; set it to {required}"};
inline constexpr MessageText forward_thrust_missing{
    "aero.forward_thrust_missing", "the propellers together give no forward thrust; check tilt and toe"};
inline constexpr MessageText gyration_radius_unusual{
    "aero.gyration_radius_unusual",
    {"radius", "ratio", "hint"},
    "this inertia gives a radius of gyration of {radius} m, {ratio} of the span; aircraft have 0.08 to 0.2, "
    "a bare rod 0.29{hint}"};
inline constexpr MessageText induced_drag_doubled{
    "aero.induced_drag_doubled",
    "this term must be 0: drag always includes CL^2/(pi e AR), and C_D_alpha counts it twice. Set it to 0 "
    "and fit C_D_0 and e"};
inline constexpr MessageText inertia_moments_impossible{
    "aero.inertia_moments_impossible",
    {"smallest", "middle", "largest", "xz", "xx", "yy"},
    "the principal moments are {smallest}, {middle} and {largest} kg m^2. The largest is more than the sum "
    "of the others, which no body has. xz ({xz}) may be wrong, or xx ({xx}) exchanged with yy ({yy})"};
inline constexpr MessageText inertia_not_definite{
    "aero.inertia_not_definite",
    {"moment", "limit"},
    "the inertia is not positive definite: one principal moment is {moment} kg m^2. The magnitude of xz must "
    "be less than {limit}"};
inline constexpr MessageText inertia_unit_suspect{
    "aero.inertia_unit_suspect",
    {"unit", "corrected"},
    ". The value may be in {unit}; it would then be {corrected} kg m^2"};
inline constexpr MessageText level_flight_impossible{
    "aero.level_flight_impossible",
    {"airspeed", "reason", "default_hint"},
    "no level flight at {airspeed} m/s: {reason}{default_hint}"};
inline constexpr MessageText limit_defaulted{
    "aero.limit_defaulted",
    {"default_value"},
    "; the file does not set this limit, and the default is {default_value}"};
inline constexpr MessageText mass_unit_suspect{"aero.mass_unit_suspect",
                                               "The mass may be in grams, or the area in ft^2"};
inline constexpr MessageText minimum_airspeed_low{
    "aero.minimum_airspeed_low",
    {"airspeed", "stall_airspeed"},
    "the minimum airspeed is {airspeed} m/s, and the wing stalls at {stall_airspeed} m/s. Set it to about "
    "1.2 times the stall airspeed"};
inline constexpr MessageText mode_damping_low{
    "aero.mode_damping_low",
    {"mode", "damping_ratio", "limit", "consequence"},
    "the damping ratio of the {mode} is {damping_ratio}, less than {limit}: {consequence}. Check these "
    "derivatives, mass and inertia"};
inline constexpr MessageText mode_unstable{
    "aero.mode_unstable",
    {"mode", "doubling_time", "consequence"},
    "the {mode} doubles in {doubling_time} s: {consequence}. Check these derivatives, mass and inertia"};
inline constexpr MessageText oswald_factor_unusual{
    "aero.oswald_factor_unusual", {"factor"}, "Oswald's factor is {factor}; wings have 0.6 to 1"};
inline constexpr MessageText pack_resistance_unusual{
    "aero.pack_resistance_unusual",
    {"ratio"},
    "the resistance is {ratio} times that of the motors; the value may be in milliohm"};
inline constexpr MessageText paired_servos_differ{
    "aero.paired_servos_differ",
    {"left", "right", "part"},
    "'{left}' and '{right}' are the left and the right {part}, and their servos differ. Give both the same "
    "limits, rates and time constants"};
inline constexpr MessageText parasite_drag_doubled{
    "aero.parasite_drag_doubled",
    {"parasite_drag"},
    "parasite drag counts twice, here and as parasite_drag {parasite_drag}: C_D_0 and C_D_p belong to two "
    "different polars. Keep one"};
inline constexpr MessageText pitch_coefficient_digit{
    "aero.pitch_coefficient_digit",
    {"found", "aircraft", "original"},
    "Cm_0 is {found}, ten times the {aircraft}'s {original}, and other coefficients are the same. A digit "
    "may be missing"};
inline constexpr MessageText pitch_limits_reversed{
    "aero.pitch_limits_reversed",
    {"minimum", "maximum"},
    "the minimum pitch, {minimum}, is not below the maximum, {maximum}. Correct pitch_min or pitch_max"};
inline constexpr MessageText pitch_power_low{
    "aero.pitch_power_low",
    {"alpha", "required", "limit"},
    "maximum lift, at {alpha}, requires {required} of elevator, which moves {limit}: the aircraft cannot "
    "slow to the stall. Check the value and the throw"};
inline constexpr MessageText pitch_rate_doubled{
    "aero.pitch_rate_doubled",
    {"corrected"},
    ": the rate may be q c/V instead of q c/2V; the value would then be {corrected}"};
inline constexpr MessageText pitch_rate_drag_unusual{
    "aero.pitch_rate_drag_unusual",
    {"found"},
    "the value is {found}; aircraft have about 0. Check it, or set it to 0"};
inline constexpr MessageText proverse_yaw{
    "aero.proverse_yaw",
    {"value", "ratio"},
    "Cn_da is {value}, {ratio} of Cl_da: the aileron would yaw into the turn, and adverse yaw (negative) is "
    "usual. The value may be in stability axes or in XFLR5's axes"};
inline constexpr MessageText rate_by_span{
    "aero.rate_by_span",
    {"corrected"},
    ": the value may belong with the span b/2V instead of the chord c/2V; it would then be {corrected}"};
inline constexpr MessageText roll_power_low{
    "aero.roll_power_low",
    {"helix", "rate"},
    "full aileron holds only p b/2V = {helix}, {rate} deg/s; at least 0.07 is recommended. Check the value "
    "and the throw of the aileron"};
inline constexpr MessageText roll_rate_doubled{
    "aero.roll_rate_doubled",
    {"corrected"},
    ": the rate may be p b/V instead of p b/2V; the value would then be {corrected}"};
inline constexpr MessageText rudder_derivative_zero{
    "aero.rudder_derivative_zero", {"symbol", "hint"}, "{symbol} is 0{hint}"};
inline constexpr MessageText rudder_ineffective{
    "aero.rudder_ineffective",
    ": the rudder has no effect; set the value, or the aircraft turns without rudder"};
inline constexpr MessageText rudder_missing{
    "aero.rudder_missing",
    ": the aircraft has no rudder and no yaw control; it turns with the ailerons alone"};
inline constexpr MessageText rudder_signs_equal{
    "aero.rudder_signs_equal",
    {"side", "yaw"},
    "CY_dr is {side} and Cn_dr {yaw}: the same sign, as with a rudder in front of the centre of gravity. One "
    "of them has the wrong sign"};
inline constexpr MessageText servo_damping_unusual{
    "aero.servo_damping_unusual",
    {"damping_ratio"},
    "the damping ratio is {damping_ratio}; servos have 0.5 to 2"};
inline constexpr MessageText servo_frequency_in_degrees{"aero.servo_frequency_in_degrees",
                                                        ". The value may be in deg/s"};
inline constexpr MessageText servo_frequency_in_hertz{
    "aero.servo_frequency_in_hertz",
    {"corrected"},
    ". The value may be in Hz; it would then be {corrected} rad/s"};
inline constexpr MessageText servo_frequency_unusual{
    "aero.servo_frequency_unusual",
    {"frequency", "hint"},
    "the natural frequency is {frequency} rad/s; servos have 30 to 200{hint}"};
inline constexpr MessageText servo_range_small{
    "aero.servo_range_small",
    {"minimum", "maximum", "throw_limit"},
    "the servo moves from {minimum} to {maximum}, but controllers command up to the throw, {throw_limit} "
    "either way. Reduce limit, or correct min and max"};
inline constexpr MessageText servo_rate_not_positive{
    "aero.servo_rate_not_positive",
    "the rate limit is not above 0, so the servo does not move; servos have 3 to 15 rad/s"};
inline constexpr MessageText servo_rate_unusual{
    "aero.servo_rate_unusual",
    {"rate"},
    "the rate limit is {rate} rad/s; servos have 3 to 15 rad/s. The value may be in deg/s"};
inline constexpr MessageText sideslip_drag_asymmetric{
    "aero.sideslip_drag_asymmetric",
    {"linear", "square", "sideslip"},
    "CD_beta is {linear} beside a square of {square}: drag is least at {sideslip} of sideslip, not at 0. Set "
    "CD_beta, the remainder of a fit, to 0"};
inline constexpr MessageText squared_drag_negative{
    "aero.squared_drag_negative",
    {"found"},
    "the value is {found}: the deflection would drive the aircraft; valid: 0 or above"};
inline constexpr MessageText stall_angle_low{
    "aero.stall_angle_low",
    {"alpha"},
    "the stall angle is {alpha}; wings stall at 10 to 18 deg. With this value the wing stalls in cruise"};
inline constexpr MessageText standing_bank_unusual{
    "aero.standing_bank_unusual",
    {"bank"},
    "the aircraft stands on one side, with a bank of {bank}; a contact may have the wrong sign of y"};
inline constexpr MessageText standing_pitch_unusual{
    "aero.standing_pitch_unusual",
    {"pitch"},
    "the aircraft stands with a pitch of {pitch}; check z (down) of all contacts"};
inline constexpr MessageText static_margin_high{
    "aero.static_margin_high",
    {"margin"},
    "the static margin -Cm_alpha/CL_alpha is {margin} of the chord; the usual range is 0.05 to 0.3. The "
    "aircraft is very stable in pitch, or the chord is not the mean chord"};
inline constexpr MessageText static_margin_low{
    "aero.static_margin_low",
    {"margin"},
    "the static margin -Cm_alpha/CL_alpha is {margin} of the chord; the usual range is 0.05 to 0.3. Check "
    "Cm_alpha and the centre of gravity"};
inline constexpr MessageText throw_too_small{
    "aero.throw_too_small", {"throw_limit"}, "the throw is only {throw_limit}; surfaces move 15 to 45 deg"};
inline constexpr MessageText thrust_off_centre{
    "aero.thrust_off_centre",
    {"direction", "arm"},
    "the propellers together turn the nose {direction}: their thrust acts {arm} m beside the centre of "
    "gravity. One propeller may have the wrong sign of y"};
inline constexpr MessageText time_constant_unusual{
    "aero.time_constant_unusual",
    {"time_constant"},
    "the time constant is {time_constant} s; servos have 0.01 to 0.1 s. The value may be in ms"};
inline constexpr MessageText trim_beyond_throw{
    "aero.trim_beyond_throw",
    {"trim", "throw_limit"},
    "the trim is {trim}, beyond the throw of {throw_limit}. Reduce trim, or increase limit"};
inline constexpr MessageText turning_bias{"aero.turning_bias",
                                          {"value"},
                                          "the value is {value}, and a symmetric aircraft has 0: the "
                                          "aircraft would turn without a control input. Set it to 0"};
inline constexpr MessageText wing_dimensions_inconsistent{
    "aero.wing_dimensions_inconsistent",
    {"ratio"},
    "chord times span is {ratio} of the area; the same wing has 0.7 to 1.5. One of the three is wrong or in "
    "another unit"};
inline constexpr MessageText wing_loading_unusual{
    "aero.wing_loading_unusual",
    {"loading", "hint"},
    "the wing loading is {loading} kg/m2; small aircraft have 1 to 60. {hint}"};
inline constexpr MessageText yaw_power_low{"aero.yaw_power_low",
                                           {"sideslip"},
                                           "full rudder holds only {sideslip} of sideslip; 5 deg or more are "
                                           "usual. Check the value and the throw of the rudder"};
inline constexpr MessageText zero_lift_unusual{
    "aero.zero_lift_unusual",
    {"lift_coefficient", "alpha", "corrected"},
    "CL_0 is {lift_coefficient}: the angle of zero lift is {alpha}; the usual range is -5 to 0 deg. The "
    "value may be CL at the analysed angle, as tools print it. CL_0 is CL - CL_alpha alpha; for an analysis "
    "at 3 deg it would be {corrected}"};

}  // namespace fulmar::aero_messages
