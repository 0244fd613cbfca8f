// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::fcu_messages {

inline constexpr MessageText acknowledgement_timeout{
    "fcu.acknowledgement_timeout",
    {"port", "action"},
    "{port} does not respond: it did not acknowledge {action} within 3 s. Check the result with 'fulmar fcu "
    "status', then try again."};
inline constexpr MessageText action_not_acknowledged{
    "fcu.action_not_acknowledged",
    {"port", "action"},
    "{port} does not respond: it did not acknowledge {action}. Check the line to it, then try again."};
inline constexpr MessageText action_refused{
    "fcu.action_refused", {"action", "reason"}, "The controller rejected {action}{reason}"};
inline constexpr MessageText action_refused_armed{
    "fcu.action_refused_armed",
    {"action"},
    "The controller rejected {action}: it is armed. Disarm it, then try again."};
inline constexpr MessageText aircraft_armed{
    "fcu.aircraft_armed", {"action"}, "The aircraft is armed: disarm it before {action}."};
inline constexpr MessageText aircraft_in_motion{
    "fcu.aircraft_in_motion",
    {"acceleration", "rotation"},
    "the aircraft moves ({acceleration} m/s2, {rotation} deg/s rms): put it down, and check again"};
inline constexpr MessageText airspeed_at_rest{
    "fcu.airspeed_at_rest",
    {"found"},
    "{found} m/s at rest: cover the pitot, 'fulmar fcu calibrate airspeed'; in wind this value is valid"};
inline constexpr MessageText airspeed_sensor_silent{
    "fcu.airspeed_sensor_silent",
    "no sensor sends data: check the plug of the pitot; without a pitot this is valid"};
inline constexpr MessageText arm_channel_invalid{
    "fcu.arm_channel_invalid",
    {"channel", "last"},
    "RC_ARM_CHN is {channel}: switches may be on 4 to RC_NUM_CHN - 1 ({last}), or -1 to arm by the sticks"};
inline constexpr MessageText arm_switch_on{"fcu.arm_switch_on", "is on: switch it off"};
inline constexpr MessageText armed_during_test{
    "fcu.armed_during_test",
    "The aircraft is now ARMED: the test has stopped. Disarm it, and keep the arm switch off."};
inline constexpr MessageText arming_blocked{"fcu.arming_blocked",
                                            "the controller does not arm until this is corrected"};
inline constexpr MessageText attitude_not_finite{
    "fcu.attitude_not_finite", "the estimate of the controller is no longer a number: power-cycle it"};
inline constexpr MessageText axes_unequal{
    "fcu.axes_unequal",
    {"factor"},
    "No calibration: the axes would differ by a factor of {factor}. Move away from iron, and start again."};
inline constexpr MessageText barometer_silent{"fcu.barometer_silent", "silent: power-cycle the controller"};
inline constexpr MessageText battery_low{
    "fcu.battery_low",
    {"found", "nominal"},
    "{found} V, and the battery of the airframe has {nominal} V: charge it"};
inline constexpr MessageText battery_not_measured{
    "fcu.battery_not_measured", "not measured: check BATT_VOLT_MULT; the sensor may be missing"};
inline constexpr MessageText biases_zero{"fcu.biases_zero", {"names"}, "{names} are 0"};
inline constexpr MessageText calibration_end_missing{
    "fcu.calibration_end_missing",
    {"calibration", "limit"},
    "The controller accepted the {calibration} calibration, but did not report its end within {limit}. The "
    "calibration is not valid; try again."};
inline constexpr MessageText calibration_failed{
    "fcu.calibration_failed",
    {"calibration", "reply", "remedy"},
    "The {calibration} calibration failed; the controller reports '{reply}'. {remedy} Then try again."};
inline constexpr MessageText calibration_not_successful{
    "fcu.calibration_not_successful",
    {"calibration", "limit", "reply", "remedy"},
    "The {calibration} calibration did not succeed within {limit}; the controller reports '{reply}'. "
    "{remedy}"};
inline constexpr MessageText calibration_stopped{
    "fcu.calibration_stopped", {"fault", "restored"}, "{fault}{restored}"};
inline constexpr MessageText command_without_output{
    "fcu.command_without_output",
    {"command", "row"},
    "No output follows the {command}: set a gain in SEC_MIXER_{row}_*."};
inline constexpr MessageText commands_not_accepted{
    "fcu.commands_not_accepted",
    "The controller does not accept commands from this computer. Check the link with 'fulmar fcu check', or "
    "increase OFFBOARD_TIMEOUT."};
inline constexpr MessageText confirmation_required{
    "fcu.confirmation_required",
    {"flag"},
    "The confirmation requires a terminal: without one, add {flag}. Nothing was changed."};
inline constexpr MessageText controller_armed{
    "fcu.controller_armed", "the controller is ARMED: disarm it, and stay away from the propeller"};
inline constexpr MessageText coverage_low{"fcu.coverage_low",
                                          {"coverage"},
                                          "No calibration: the samples cover {coverage} of all directions, "
                                          "75 % are needed. Turn the aircraft in all directions."};
inline constexpr MessageText failsafe_in_control{
    "fcu.failsafe_in_control", "none: failsafe, motor off and surfaces centred. Switch the transmitter on"};
inline constexpr MessageText field_implausible{
    "fcu.field_implausible",
    {"found"},
    "No calibration: a field of {found} uT is not the field of the Earth, 22 to 67 uT. Check the sensor, and "
    "that its unit is tesla."};
inline constexpr MessageText file_exists{
    "fcu.file_exists", {"file"}, "{file} exists already. Choose another name, or add --replace."};
inline constexpr MessageText file_not_writable{"fcu.file_not_writable",
                                               {"file"},
                                               "{file} cannot be written. Check that its folder exists, that "
                                               "you have the permission, and that the disk is not full."};
inline constexpr MessageText file_parameter_unknown{
    "fcu.file_parameter_unknown",
    {"parameter", "hint"},
    "the controller has no parameter '{parameter}': correct the name, or remove the line.{hint}"};
inline constexpr MessageText file_write_failed{
    "fcu.file_write_failed",
    {"file", "reason"},
    "{file} cannot be written: {reason}. Choose another name or folder."};
inline constexpr MessageText finite_number_expected{"fcu.finite_number_expected",
                                                    {"parameter", "found"},
                                                    "{parameter} cannot be '{found}': give a finite number."};
inline constexpr MessageText firmware_tested{"fcu.firmware_tested", {"version"}, "{version}, as tried"};
inline constexpr MessageText firmware_too_old{
    "fcu.firmware_too_old",
    {"port", "version"},
    "{port} runs firmware {version}: Fulmar requires ROSflight 2.0 or later; flash it."};
inline constexpr MessageText firmware_untested{
    "fcu.firmware_untested",
    {"found", "tested"},
    "Fulmar is tested with firmware {tested}, this controller has {found}: messages, mixers and signs may "
    "differ. Repeat every check on the ground"};
inline constexpr MessageText fit_failed{
    "fcu.fit_failed",
    {"reason"},
    "No calibration: {reason}. Turn the aircraft in all directions, away from iron and cables."};
inline constexpr MessageText fit_scatter_high{
    "fcu.fit_scatter_high",
    {"scatter"},
    "No calibration: the samples scatter by {scatter} about the fit. Move away from iron, cables and motors, "
    "keep telephones off, and turn slowly."};
inline constexpr MessageText fit_uncertain{
    "fcu.fit_uncertain",
    {"uncertainty"},
    "No calibration: its uncertainty would be {uncertainty}. Turn the aircraft further, in all directions."};
inline constexpr MessageText fix_inaccurate{"fcu.fix_inaccurate",
                                            {"fix", "satellites", "accuracy"},
                                            "{fix}, {satellites} satellites, +-{accuracy} m: wait"};
inline constexpr MessageText fix_missing{
    "fcu.fix_missing", {"fix", "satellites"}, "{fix}, {satellites} satellites: wait under open sky"};
inline constexpr MessageText frame_loss_high{"fcu.frame_loss_high",
                                             "check the cable, and increase the baud rate of both ends"};
inline constexpr MessageText gravity_implausible{
    "fcu.gravity_implausible",
    {"found"},
    "gravity is {found} m/s2 at rest, not 9.81: 'fulmar fcu calibrate imu'"};
inline constexpr MessageText heading_sensor_silent{
    "fcu.heading_sensor_silent", "silent: check its plug. Without it the heading comes from GNSS alone"};
inline constexpr MessageText imu_calibrated{
    "fcu.imu_calibrated", {"gravity", "rotation"}, "calibrated; {gravity} m/s2, {rotation} deg/s"};
inline constexpr MessageText imu_not_calibrated{
    "fcu.imu_not_calibrated",
    "not calibrated: lay it level, 'fulmar fcu calibrate imu', then 'params write'"};
inline constexpr MessageText imu_rate_low{
    "fcu.imu_rate_low",
    {"rate"},
    "{rate} Hz of 400: the line loses frames or is too slow. Check the cable and the baud rate"};
inline constexpr MessageText imu_rate_too_low{
    "fcu.imu_rate_too_low",
    {"rate"},
    "{rate} Hz, but the loop requires 400: check the cable and the baud rate"};
inline constexpr MessageText inertial_samples_missing{
    "fcu.inertial_samples_missing",
    {"port"},
    "{port} sends no inertial samples, so a reboot cannot be detected. Power-cycle it."};
inline constexpr MessageText line_load_high{
    "fcu.line_load_high", "increase the baud rate of a UART to 921600; USB ignores the baud rate"};
inline constexpr MessageText mag_matrix_invalid{
    "fcu.mag_matrix_invalid",
    "The MAG_CAL_A parameters are not a valid matrix. Set the identity with 'fulmar fcu params set': 1 on "
    "the diagonal, 0 elsewhere."};
inline constexpr MessageText mag_parameters_not_reported{
    "fcu.mag_parameters_not_reported",
    {"port"},
    "{port} does not report its MAG_ parameters, so the calibration did not start. Check the line to it, "
    "then try again."};
inline constexpr MessageText magnetometer_not_calibrated{
    "fcu.magnetometer_not_calibrated", "not calibrated: 'fulmar fcu calibrate mag', then 'params write'"};
inline constexpr MessageText magnetometer_silent{
    "fcu.magnetometer_silent",
    "The magnetometer sends no data. Check its plug, then power-cycle the controller."};
inline constexpr MessageText mavlink_version_unsupported{
    "fcu.mavlink_version_unsupported",
    {"port"},
    "{port} sends MAVLink 2, as PX4 and ArduPilot do: Fulmar requires a flight controller with ROSflight "
    "firmware 2."};
inline constexpr MessageText mixer_missing{
    "fcu.mixer_missing",
    {"found"},
    "PRIMARY_MIXER is {found}, none: set 9 (fixed wing), 10 (V-tail) or 11 (your own matrix)."};
inline constexpr MessageText mixer_of_multirotor{
    "fcu.mixer_of_multirotor",
    {"found"},
    "PRIMARY_MIXER is {found}, a multirotor's: set 9 (fixed wing), 10 (V-tail) or 11 (your own)."};
inline constexpr MessageText mixers_differ{
    "fcu.mixers_differ",
    {"output", "command", "pilot", "computer", "cause"},
    "Output {output} answers the {command} of the pilot by {pilot} and of the computer by {computer}: "
    "{cause}Set SECONDARY_MIXER to 255 to make them equal."};
inline constexpr MessageText multirotor_configured{
    "fcu.multirotor_configured",
    "FIXED_WING is 0, a multirotor: 'fulmar fcu params set FIXED_WING 1', write, power-cycle"};
inline constexpr MessageText number_expected{
    "fcu.number_expected", {"found"}, "expected a number; found {found}"};
inline constexpr MessageText number_too_large{
    "fcu.number_too_large",
    {"found", "parameter"},
    "{found} is outside the range of {parameter}, a number of 32 bits: give -3.4e38 to 3.4e38."};
inline constexpr MessageText output_kind_wrong{"fcu.output_kind_wrong",
                                               {"output", "command", "kind", "wanted"},
                                               "Output {output} follows the {command} but is set up as a "
                                               "{kind}: set PRI_MIXER_OUT_{output} to {wanted}."};
inline constexpr MessageText output_moved{
    "fcu.output_moved", {"output", "first", "then"}, "output {output} went to {first}, then to {then}"};
inline constexpr MessageText output_not_moved{
    "fcu.output_not_moved",
    {"output", "position"},
    "Output {output} did not follow: the controller reports that it stayed at {position}. Check the mixer "
    "with 'fulmar fcu check'."};
inline constexpr MessageText output_without_command{"fcu.output_without_command",
                                                    "follows none of the four commands"};
inline constexpr MessageText outputs_frozen{
    "fcu.outputs_frozen", "none: without radio frames the outputs are frozen. Switch the transmitter on"};
inline constexpr MessageText override_switch_missing{"fcu.override_switch_missing",
                                                     {"channel", "last"},
                                                     "no override switch: RC_ATT_OVRD_CHN is {channel}. Set "
                                                     "it to a channel from 4 to RC_NUM_CHN - 1 ({last})"};
inline constexpr MessageText override_switch_off{
    "fcu.override_switch_off",
    "off: the computer controls the aircraft as soon as it sends; begin with the pilot"};
inline constexpr MessageText param_file_columns{"fcu.param_file_columns",
                                                "Behind each value: its index and type."};
inline constexpr MessageText param_file_title{
    "fcu.param_file_title",
    {"firmware"},
    "Parameters of a ROSflight flight controller, firmware {firmware}. Load: fulmar fcu params load FILE."};
inline constexpr MessageText param_file_unversioned{
    "fcu.param_file_unversioned",
    "Parameters of a ROSflight flight controller. Load: fulmar fcu params load FILE."};
inline constexpr MessageText param_set{
    "fcu.param_set", {"name", "from", "to"}, "{name}: {from} -> {to}, read back."};
inline constexpr MessageText parameter_duplicate{
    "fcu.parameter_duplicate",
    {"parameter", "line"},
    "{parameter} is in this file twice, first in line {line}. Remove one of them"};
inline constexpr MessageText parameter_key_missing{
    "fcu.parameter_key_missing",
    {"key"},
    "this parameter has no '{key}': write {{name: NAME, type: TYPE, value: VALUE}"};
inline constexpr MessageText parameter_list_expected{
    "fcu.parameter_list_expected",
    {"found"},
    "expected lines 'NAME: value', or a list of {{name, type, value}; found {found}"};
inline constexpr MessageText parameter_list_hint{"fcu.parameter_list_hint",
                                                 " 'fulmar fcu params list' prints all."};
inline constexpr MessageText parameter_name_invalid{
    "fcu.parameter_name_invalid",
    {"parameter"},
    "'{parameter}' is not the name of a parameter: give 1 to 16 characters."};
inline constexpr MessageText parameter_request_unanswered{
    "fcu.parameter_request_unanswered",
    {"port"},
    "{port} does not respond to the request for its parameters. Check the line to it, then try again."};
inline constexpr MessageText parameter_suggestion{
    "fcu.parameter_suggestion", {"suggestion"}, " Did you mean {suggestion}?"};
inline constexpr MessageText parameter_type_invalid{
    "fcu.parameter_type_invalid",
    {"found"},
    "expected the type 6 (whole number) or 9 (number); found {found}"};
inline constexpr MessageText parameter_type_mismatch{
    "fcu.parameter_type_mismatch",
    {"parameter", "type"},
    "{parameter} is of type {type} in the controller. Write this type here."};
inline constexpr MessageText parameter_unknown{
    "fcu.parameter_unknown", {"parameter", "hint"}, "The controller has no parameter '{parameter}'.{hint}"};
inline constexpr MessageText parameters_incomplete{
    "fcu.parameters_incomplete",
    {"received", "expected", "port"},
    "Only {received} of {expected} parameters came from {port}: the link loses too much data. Check it with "
    "'fulmar fcu check'."};
inline constexpr MessageText parameters_not_reported{
    "fcu.parameters_not_reported",
    {"port"},
    "{port} does not report its parameters, so the calibration did not start. Check the line to it, then try "
    "again."};
inline constexpr MessageText parameters_not_taken{
    "fcu.parameters_not_taken",
    {"failed", "total", "first"},
    "{failed} of {total} did not take their values; the first is {first}. Load the file again."};
inline constexpr MessageText pattern_unmatched{
    "fcu.pattern_unmatched",
    {"count", "pattern"},
    "None of the {count} parameters matches '{pattern}'. 'fulmar fcu params list' prints all."};
inline constexpr MessageText pilot_override_active{
    "fcu.pilot_override_active",
    {"overrides"},
    "The pilot controls the outputs ({overrides}). Switch the override off and leave the sticks in the "
    "middle, then try again."};
inline constexpr MessageText pilot_took_over{
    "fcu.pilot_took_over",
    {"overrides"},
    "The pilot took over ({overrides}): the test has stopped. Switch the override off, then try again."};
inline constexpr MessageText pitot_zero_implausible{
    "fcu.pitot_zero_implausible",
    {"found"},
    "the zero of the airspeed sensor, DIFF_PRESS_BIAS, is {found} Pa, as in wind or in the air: 'run' does "
    "not use it. Cover the pitot, 'fulmar fcu calibrate airspeed'"};
inline constexpr MessageText port_silent{
    "fcu.port_silent",
    {"port"},
    "{port} sends no data. Check that the flight controller has power and that this is its port. On a UART "
    "both ends need the same --baud."};
inline constexpr MessageText protocol_unknown{
    "fcu.protocol_unknown",
    {"port", "bytes"},
    "{port} sends data ({bytes} bytes), but not as a ROSflight flight controller does. Correct --baud, or "
    "name another --port."};
inline constexpr MessageText radio_channel_map{
    "fcu.radio_channel_map",
    {"roll", "pitch", "throttle", "yaw", "attitude_override", "throttle_override", "arm"},
    "roll {roll}, pitch {pitch}, throttle {throttle}, yaw {yaw}, override "
    "{attitude_override}{throttle_override}{arm} (counted from 1)"};
inline constexpr MessageText radio_frames_absent{"fcu.radio_frames_absent",
                                                 "no frames: switch the transmitter on; check receiver and "
                                                 "RC_TYPE. Without frames no command reaches the outputs"};
inline constexpr MessageText radio_frames_missing{
    "fcu.radio_frames_missing",
    "The controller receives no radio frames: without them the firmware moves no output. Switch the "
    "transmitter on, and check 'fulmar fcu status'."};
inline constexpr MessageText radio_rate_low{
    "fcu.radio_rate_low",
    {"rate"},
    "{rate} frames a second: commands reach the outputs only with frames; SBUS gives 111"};
inline constexpr MessageText readback_failed{
    "fcu.readback_failed", {"port"}, "{port} did not respond when the parameters were read back: try again."};
inline constexpr MessageText real_number_expected{
    "fcu.real_number_expected",
    {"parameter", "found"},
    "{parameter} cannot be '{found}': give a number, such as 0.5."};
inline constexpr MessageText reboot_not_done{
    "fcu.reboot_not_done",
    "the controller acknowledged but did not restart: firmware 2.0 cannot restart on H7 boards, and its "
    "outputs may now be off. Power-cycle it"};
inline constexpr MessageText reboot_refused{"fcu.reboot_refused",
                                            "The controller rejected the reboot. Power-cycle it."};
inline constexpr MessageText reboot_unanswered{
    "fcu.reboot_unanswered",
    {"controller"},
    "{controller} did not answer and did not restart: power-cycle it."};
inline constexpr MessageText receiver_silent{"fcu.receiver_silent", "silent: check the plug of the receiver"};
inline constexpr MessageText restored_values_unknown{
    "fcu.restored_values_unknown",
    {"fault"},
    "{fault} The controller did not report whether the former values are restored. Compare them with the "
    "list above."};
inline constexpr MessageText reversal_in_file{
    "fcu.reversal_in_file",
    {"surface", "parameter"},
    "the airframe file reverses the {surface} for the computer only, not for the pilot: set {parameter} to 1 "
    "in the controller and remove the entry 'reversed' in the file. Then check both directions on the "
    "ground"};
inline constexpr MessageText rosflight_status_missing{
    "fcu.rosflight_status_missing",
    {"port", "frames"},
    "{port} sends MAVLink ({frames} frames), but no status of ROSflight 2. Flash ROSflight firmware 2, or "
    "choose the right port."};
inline constexpr MessageText rotation_at_rest{
    "fcu.rotation_at_rest", {"found"}, "the gyro reads {found} deg/s at rest: 'fulmar fcu calibrate imu'"};
inline constexpr MessageText round_trip_excessive{"fcu.round_trip_excessive",
                                                  "too slow for flight: increase the baud rate, or use USB"};
inline constexpr MessageText round_trip_long{"fcu.round_trip_long",
                                             "more than 10 ms: increase the baud rate, or use USB"};
inline constexpr MessageText round_trip_missing{"fcu.round_trip_missing",
                                                "no answer to 20 requests within 100 ms, too slow for "
                                                "flight: check the cable, and the baud rate of both ends"};
inline constexpr MessageText sample_line_invalid{
    "fcu.sample_line_invalid",
    {"file", "line"},
    "{file}:{line}: expected three numbers in tesla, x,y,z. Correct or delete the line."};
inline constexpr MessageText sampling_timeout{
    "fcu.sampling_timeout",
    "The magnetometer gave no new sample for two minutes, so the calibration has stopped. The parameters are "
    "unchanged; power-cycle the controller, then try again."};
inline constexpr MessageText sensors_not_started{
    "fcu.sensors_not_started",
    {"count"},
    "{count} did not start: 'fulmar fcu status' lists the silent ones; power-cycle it"};
inline constexpr MessageText set_not_confirmed{"fcu.set_not_confirmed",
                                               {"port", "parameter"},
                                               "{port} does not respond, so it may not have set {parameter}. "
                                               "Check it with 'fulmar fcu params get {parameter}'."};
inline constexpr MessageText set_not_effective{"fcu.set_not_effective",
                                               {"parameter", "wanted", "found"},
                                               "{parameter} did not take {wanted}: it is still {found}. "
                                               "Check that the controller is disarmed, then try again."};
inline constexpr MessageText side_in_progress{
    "fcu.side_in_progress",
    {"progress", "side", "count"},
    "{progress}Now {side}: turn it once around, slowly: {count} of 12."};
inline constexpr MessageText status_lost{
    "fcu.status_lost",
    {"port"},
    "{port} no longer sends its status. Check its plug; after a reboot, try again."};
inline constexpr MessageText status_lost_during_test{
    "fcu.status_lost_during_test",
    {"port"},
    "{port} no longer sends its status, so the test has stopped. Check its plug, then try again."};
inline constexpr MessageText stick_channel_invalid{
    "fcu.stick_channel_invalid",
    {"last"},
    "a stick is on a channel outside of 0 to RC_NUM_CHN - 1 ({last}): correct RC_X_CHN, RC_Y_CHN, RC_Z_CHN, "
    "RC_F_CHN"};
inline constexpr MessageText stick_override_off{
    "fcu.stick_override_off",
    {"found"},
    "RC_OVRD_DEV is {found}: the sticks do not take over, only the switch does. Set a value below 1"};
inline constexpr MessageText sticks_on_one_channel{
    "fcu.sticks_on_one_channel",
    {"channel"},
    "two sticks are on channel {channel}, counted from 1: correct RC_X_CHN, RC_Y_CHN, RC_Z_CHN, RC_F_CHN"};
inline constexpr MessageText subcommand_missing{
    "fcu.subcommand_missing",
    {"command", "choices"},
    "fulmar fcu{command}: the subcommand is missing. Valid: {choices}. See --help."};
inline constexpr MessageText subcommand_unknown{
    "fcu.subcommand_unknown",
    {"command", "found", "choices"},
    "fulmar fcu{command}: there is no subcommand '{found}'.{choices}"};
inline constexpr MessageText surface_reversed_twice{"fcu.surface_reversed_twice",
                                                    {"parameter", "surface"},
                                                    "{parameter} is 1 and the airframe file sets reversed: "
                                                    "together they reverse the {surface} twice; remove one"};
inline constexpr MessageText surface_without_output{
    "fcu.surface_without_output",
    {"surface"},
    "No output follows the {surface}: right only for an aircraft without one."};
inline constexpr MessageText switch_shared{
    "fcu.switch_shared", "one switch both arms and overrides: give RC_ARM_CHN a channel of its own"};
inline constexpr MessageText terminal_required{
    "fcu.terminal_required", "The calibration by hand requires a terminal; without one use --from FILE.csv."};
inline constexpr MessageText text_received{"fcu.text_received",
                                           {"port"},
                                           "{port} sends text, not MAVLink. The device is not a flight "
                                           "controller; it may be a GNSS receiver. Name another --port."};
inline constexpr MessageText throttle_axis_invalid{
    "fcu.throttle_axis_invalid",
    {"found"},
    "RC_F_AXIS is {found}: the throttle of a fixed wing is u[0]; set it to 0"};
inline constexpr MessageText throttle_limited_by_pilot{
    "fcu.throttle_limited_by_pilot",
    "TAKE_MIN_THR is 1: the pilot's stick limits the computer's throttle; set 0, or fly with the stick up"};
inline constexpr MessageText throttle_stick_up{
    "fcu.throttle_stick_up", {"found"}, "at {found} %: pull it down to arm"};
inline constexpr MessageText throttle_switch_missing{
    "fcu.throttle_switch_missing",
    {"channel", "last"},
    "no throttle override switch: RC_THR_OVRD_CHN is {channel}. Set it to a channel from 4 to RC_NUM_CHN - 1 "
    "({last})"};
inline constexpr MessageText timeout_too_long{
    "fcu.timeout_too_long", "the aircraft flies on for this time without a computer. Set it to 100"};
inline constexpr MessageText timeout_too_short{"fcu.timeout_too_short",
                                               "commands may come every 50 ms. Set it to 100"};
inline constexpr MessageText trim_too_large{
    "fcu.trim_too_large",
    {"parameter", "found"},
    "{parameter} is {found}; the controller adds it to every command: trim the linkage instead"};
inline constexpr MessageText v_tail_gain_doubled{"fcu.v_tail_gain_doubled",
                                                 "the firmware's secondary V-tail has twice the gain. "};
inline constexpr MessageText value_not_taken{
    "fcu.value_not_taken", {"parameter"}, "{parameter} did not take its value: try again."};
inline constexpr MessageText value_out_of_range{"fcu.value_out_of_range",
                                                {"parameter", "minimum", "maximum", "found"},
                                                "{parameter} is {minimum} to {maximum}, not {found}: the "
                                                "controller does not work with other values."};
inline constexpr MessageText values_not_restored{
    "fcu.values_not_restored",
    {"fault"},
    "{fault} The former values could not be restored. Set those listed above."};
inline constexpr MessageText values_restored{"fcu.values_restored", " The former values are restored."};
inline constexpr MessageText version_not_reported{"fcu.version_not_reported",
                                                  {"port"},
                                                  "{port} sends data, but does not respond. Check the line "
                                                  "to it; if it is older than ROSflight 2, flash it."};
inline constexpr MessageText version_refused{
    "fcu.version_refused",
    "The controller does not report its version, though it is disarmed. Power-cycle it."};
inline constexpr MessageText version_while_armed{
    "fcu.version_while_armed",
    "The controller reports its version only while disarmed. Disarm it, then try again."};
inline constexpr MessageText version_withheld{
    "fcu.version_withheld", "the controller does not report its version, though disarmed: power-cycle it"};
inline constexpr MessageText whole_number_expected{"fcu.whole_number_expected",
                                                   {"parameter", "found"},
                                                   "{parameter} cannot be '{found}': give a whole number."};
inline constexpr MessageText whole_number_too_large{
    "fcu.whole_number_too_large",
    {"found", "parameter"},
    "{found} is too large for {parameter}: it holds whole numbers from -2147483648 to 2147483647."};
inline constexpr MessageText zeroing_in_progress{
    "fcu.zeroing_in_progress",
    {"age"},
    "booted {age} s ago: it zeroes barometer and airspeed in the first 12 s; keep it still"};

}  // namespace fulmar::fcu_messages
