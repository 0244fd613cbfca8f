// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::fcu_messages {

inline constexpr MessageText acknowledgement_timeout{
    "fcu.acknowledgement_timeout",
    {"port", "action"},
    "{port} does not answer: {action} was not acknowledged within 3 s; whether it was done is not known."};
inline constexpr MessageText action_not_acknowledged{
    "fcu.action_not_acknowledged",
    {"port", "action"},
    "{port} does not answer: {action} was not acknowledged."};
inline constexpr MessageText action_refused{
    "fcu.action_refused", {"action", "reason"}, "The controller refused {action}{reason}"};
inline constexpr MessageText action_refused_armed{
    "fcu.action_refused_armed", {"action"}, "The controller refused {action}: it is armed."};
inline constexpr MessageText aircraft_armed{
    "fcu.aircraft_armed", {"action"}, "The aircraft is armed: disarm it before {action}."};
inline constexpr MessageText aircraft_in_motion{
    "fcu.aircraft_in_motion",
    {"acceleration", "rotation"},
    "it is being moved ({acceleration} m/s2, {rotation} deg/s rms): put it down, and check again"};
inline constexpr MessageText airspeed_at_rest{
    "fcu.airspeed_at_rest",
    {"found"},
    "{found} m/s at rest: cover the tube, 'fulmar fcu calibrate airspeed'; in wind this is right"};
inline constexpr MessageText airspeed_sensor_silent{
    "fcu.airspeed_sensor_silent", "no sensor is heard: the pitot tube is unplugged, or there is none"};
inline constexpr MessageText arm_switch_on{"fcu.arm_switch_on", "is on: switch it off"};
inline constexpr MessageText armed_during_test{
    "fcu.armed_during_test", "It got ARMED: the test has stopped. Disarm it, and keep the arm switch off."};
inline constexpr MessageText arming_blocked{"fcu.arming_blocked", "it will not arm"};
inline constexpr MessageText attitude_not_finite{
    "fcu.attitude_not_finite", "the controller's own is not a number any more: power-cycle it"};
inline constexpr MessageText axes_unequal{
    "fcu.axes_unequal",
    {"factor"},
    "No calibration: the axes would differ by a factor of {factor}. There is too much iron near the sensor."};
inline constexpr MessageText barometer_silent{"fcu.barometer_silent", "silent: power-cycle the controller"};
inline constexpr MessageText battery_low{
    "fcu.battery_low", {"found", "nominal"}, "{found} V, and the airframe's has {nominal} V: charge it"};
inline constexpr MessageText battery_not_measured{"fcu.battery_not_measured",
                                                  "not measured: BATT_VOLT_MULT, or no sensor"};
inline constexpr MessageText calibration_end_missing{
    "fcu.calibration_end_missing",
    {"calibration", "limit"},
    "The {calibration} calibration was accepted, but no sign of its end came within {limit}: it does not "
    "count; try again."};
inline constexpr MessageText calibration_failed{
    "fcu.calibration_failed",
    {"calibration", "reply", "remedy"},
    "The {calibration} calibration failed; the controller says: '{reply}'. {remedy} Then try again."};
inline constexpr MessageText calibration_not_successful{
    "fcu.calibration_not_successful",
    {"calibration", "limit", "reply", "remedy"},
    "The {calibration} calibration did not succeed within {limit}; the controller says: '{reply}'. {remedy}"};
inline constexpr MessageText calibration_stopped{
    "fcu.calibration_stopped", {"fault", "restored"}, "{fault}{restored}"};
inline constexpr MessageText commands_not_accepted{
    "fcu.commands_not_accepted",
    "The controller does not take commands from here: do they get lost, or is OFFBOARD_TIMEOUT too short?"};
inline constexpr MessageText confirmation_required{
    "fcu.confirmation_required", {"flag"}, "Nothing was changed: without a terminal to ask on, add {flag}."};
inline constexpr MessageText controller_armed{"fcu.controller_armed",
                                              "it is ARMED: disarm it, and stay away from the propeller"};
inline constexpr MessageText failsafe_in_control{"fcu.failsafe_in_control",
                                                 "nobody: failsafe, motor off and surfaces centred"};
inline constexpr MessageText field_implausible{
    "fcu.field_implausible",
    {"found"},
    "No calibration: a field of {found} uT is not the Earth's, which is 22 to 67 uT. Is the sensor sound, "
    "and the unit tesla?"};
inline constexpr MessageText file_exists{
    "fcu.file_exists", {"file"}, "{file} is there already: choose another name, or add --replace."};
inline constexpr MessageText file_not_writable{
    "fcu.file_not_writable",
    {"file"},
    "{file} cannot be written: no such folder, no permission, or the disk is full."};
inline constexpr MessageText file_parameter_unknown{"fcu.file_parameter_unknown",
                                                    {"parameter", "hint"},
                                                    "the controller has no parameter '{parameter}'.{hint}"};
inline constexpr MessageText file_write_failed{
    "fcu.file_write_failed", {"file", "reason"}, "{file} cannot be written: {reason}."};
inline constexpr MessageText finite_number_expected{"fcu.finite_number_expected",
                                                    {"parameter", "found"},
                                                    "{parameter} must be a finite number, not '{found}'."};
inline constexpr MessageText firmware_too_old{
    "fcu.firmware_too_old",
    {"port", "version"},
    "{port} runs firmware {version}: Fulmar needs ROSflight 2.0 or later; flash it."};
inline constexpr MessageText firmware_untested{"fcu.firmware_untested",
                                               {"found", "tested"},
                                               "{found} was not tried with Fulmar, {tested} was: messages, "
                                               "mixers and signs may differ; go through every step anew"};
inline constexpr MessageText fit_failed{
    "fcu.fit_failed",
    {"reason"},
    "No calibration: {reason}. Turn the aircraft all ways, away from iron and cables."};
inline constexpr MessageText fit_scatter_high{
    "fcu.fit_scatter_high",
    {"scatter"},
    "No calibration: the samples scatter by {scatter} about the fit. Go away from iron, cables and motors, "
    "keep telephones off, and turn slowly."};
inline constexpr MessageText fit_uncertain{
    "fcu.fit_uncertain",
    {"uncertainty"},
    "No calibration: it would be known to {uncertainty} only. Turn the aircraft further, all ways."};
inline constexpr MessageText fix_missing{
    "fcu.fix_missing", {"fix", "satellites"}, "{fix}, {satellites} satellites: wait under open sky"};
inline constexpr MessageText frame_loss_high{"fcu.frame_loss_high", "cable, or a baud rate that is too low"};
inline constexpr MessageText heading_sensor_silent{"fcu.heading_sensor_silent",
                                                   "silent: headings will come from GNSS alone"};
inline constexpr MessageText imu_rate_low{
    "fcu.imu_rate_low", {"rate"}, "{rate} Hz of 400: the line loses or is too slow"};
inline constexpr MessageText imu_rate_too_low{
    "fcu.imu_rate_too_low", {"rate"}, "{rate} Hz: the loop needs 400"};
inline constexpr MessageText inertial_samples_missing{
    "fcu.inertial_samples_missing",
    {"port"},
    "{port} sends no inertial samples: whether it reboots could not be told. Power-cycle it."};
inline constexpr MessageText line_load_high{"fcu.line_load_high", "on a UART take 921600; USB does not care"};
inline constexpr MessageText mag_matrix_invalid{
    "fcu.mag_matrix_invalid", "The MAG_CAL_A parameters are no sound matrix: set the identity first."};
inline constexpr MessageText mag_parameters_not_reported{
    "fcu.mag_parameters_not_reported",
    {"port"},
    "{port} does not tell its MAG_ parameters: the calibration was not begun."};
inline constexpr MessageText magnetometer_not_calibrated{
    "fcu.magnetometer_not_calibrated", "not calibrated: 'fulmar fcu calibrate mag', then 'params write'"};
inline constexpr MessageText magnetometer_silent{
    "fcu.magnetometer_silent", "No magnetometer is heard: there is none, or it did not start."};
inline constexpr MessageText mavlink_version_unsupported{
    "fcu.mavlink_version_unsupported",
    {"port"},
    "{port} talks MAVLink 2, as PX4 and ArduPilot do: Fulmar needs a flight controller with ROSflight "
    "firmware 2."};
inline constexpr MessageText multirotor_configured{
    "fcu.multirotor_configured",
    "FIXED_WING is 0, a multirotor: 'fulmar fcu params set FIXED_WING 1', write, power-cycle"};
inline constexpr MessageText number_expected{
    "fcu.number_expected", {"found"}, "expected a number, found {found}"};
inline constexpr MessageText number_too_large{
    "fcu.number_too_large",
    {"found", "parameter"},
    "{found} is outside of what {parameter} holds: a number of 32 bits, up to 3.4e38."};
inline constexpr MessageText output_not_moved{
    "fcu.output_not_moved",
    {"output", "position"},
    "Output {output} did not follow: the controller says it stayed at {position}."};
inline constexpr MessageText output_without_command{"fcu.output_without_command",
                                                    "follows none of the four commands"};
inline constexpr MessageText outputs_frozen{"fcu.outputs_frozen",
                                            "nobody: without radio frames the outputs are frozen"};
inline constexpr MessageText override_switch_off{
    "fcu.override_switch_off", "off: the computer flies as soon as it sends; begin with the pilot"};
inline constexpr MessageText parameter_duplicate{
    "fcu.parameter_duplicate",
    {"parameter", "line"},
    "{parameter} stands twice in this file, first in line {line}"};
inline constexpr MessageText parameter_key_missing{
    "fcu.parameter_key_missing", {"key"}, "this parameter has no '{key}': it needs {{name, type, value}"};
inline constexpr MessageText parameter_list_expected{
    "fcu.parameter_list_expected",
    {"found"},
    "expected 'NAME: value' lines, or a list of {{name, type, value}, found {found}"};
inline constexpr MessageText parameter_list_hint{"fcu.parameter_list_hint",
                                                 " 'fulmar fcu params list' shows all."};
inline constexpr MessageText parameter_name_invalid{
    "fcu.parameter_name_invalid",
    {"parameter"},
    "'{parameter}' is no name of a parameter: they have 1 to 16 characters."};
inline constexpr MessageText parameter_request_unanswered{
    "fcu.parameter_request_unanswered",
    {"port"},
    "{port} does not answer the request for its parameters: is the line to it cut?"};
inline constexpr MessageText parameter_suggestion{
    "fcu.parameter_suggestion", {"suggestion"}, " Did you mean {suggestion}?"};
inline constexpr MessageText parameter_type_invalid{
    "fcu.parameter_type_invalid", {"found"}, "type is 6 (whole number) or 9 (number), found {found}"};
inline constexpr MessageText parameter_type_mismatch{
    "fcu.parameter_type_mismatch", {"parameter", "type"}, "{parameter} is of type {type} in the controller."};
inline constexpr MessageText parameter_unknown{
    "fcu.parameter_unknown", {"parameter", "hint"}, "The controller has no parameter '{parameter}'.{hint}"};
inline constexpr MessageText parameters_incomplete{
    "fcu.parameters_incomplete",
    {"received", "expected", "port"},
    "Only {received} of {expected} parameters came from {port}: the link loses too much; look at 'fulmar fcu "
    "check'."};
inline constexpr MessageText parameters_not_reported{
    "fcu.parameters_not_reported",
    {"port"},
    "{port} does not tell its parameters: the calibration was not begun."};
inline constexpr MessageText parameters_not_taken{"fcu.parameters_not_taken",
                                                  {"failed", "total", "first"},
                                                  "{failed} of {total} did not take, {first} first."};
inline constexpr MessageText pattern_unmatched{
    "fcu.pattern_unmatched", {"count", "pattern"}, "None of the {count} parameters matches '{pattern}'."};
inline constexpr MessageText pilot_override_active{
    "fcu.pilot_override_active",
    {"overrides"},
    "The pilot has the outputs ({overrides}): switch the override off and leave the sticks in the middle, "
    "then try again."};
inline constexpr MessageText pilot_took_over{
    "fcu.pilot_took_over", {"overrides"}, "The pilot took over ({overrides}): the test has stopped."};
inline constexpr MessageText pitot_zero_implausible{
    "fcu.pitot_zero_implausible",
    {"found"},
    "its zero, DIFF_PRESS_BIAS, is {found} Pa, as in wind or in the air: 'run' does not use it; cover the "
    "tube, 'fulmar fcu calibrate airspeed'"};
inline constexpr MessageText port_silent{"fcu.port_silent",
                                         {"port"},
                                         "{port} is silent: is the flight controller powered and this its "
                                         "port? On a UART both ends need the same --baud."};
inline constexpr MessageText protocol_unknown{"fcu.protocol_unknown",
                                              {"port", "bytes"},
                                              "{port} talks ({bytes} bytes), but not as a ROSflight flight "
                                              "controller: wrong --baud, or another device on this port."};
inline constexpr MessageText radio_channel_map{
    "fcu.radio_channel_map",
    {"roll", "pitch", "throttle", "yaw", "attitude_override", "throttle_override", "arm"},
    "roll {roll}, pitch {pitch}, throttle {throttle}, yaw {yaw}, override "
    "{attitude_override}{throttle_override}{arm} (counted from 1)"};
inline constexpr MessageText radio_frames_absent{"fcu.radio_frames_absent",
                                                 "no frames: switch the transmitter on; check receiver and "
                                                 "RC_TYPE. Without them nothing reaches the outputs"};
inline constexpr MessageText radio_frames_missing{
    "fcu.radio_frames_missing",
    "No radio frames come: without them the firmware moves nothing. Switch the transmitter on, and look at "
    "'fulmar fcu status'."};
inline constexpr MessageText radio_rate_low{
    "fcu.radio_rate_low",
    {"rate"},
    "{rate} frames a second: commands reach the outputs only with them; SBUS gives 111"};
inline constexpr MessageText readback_failed{
    "fcu.readback_failed", {"port"}, "{port} did not answer when the parameters were read back: try again."};
inline constexpr MessageText real_number_expected{
    "fcu.real_number_expected", {"parameter", "found"}, "{parameter} is a number, not '{found}'."};
inline constexpr MessageText reboot_not_done{
    "fcu.reboot_not_done",
    "The controller acknowledged, but did not restart: firmware 2.0 cannot on H7 boards, and its outputs may "
    "now be off. Power-cycle it."};
inline constexpr MessageText reboot_refused{"fcu.reboot_refused", "The controller refused to reboot."};
inline constexpr MessageText reboot_unanswered{
    "fcu.reboot_unanswered",
    {"controller"},
    "{controller} did not answer and did not restart: power-cycle it."};
inline constexpr MessageText receiver_silent{"fcu.receiver_silent", "silent: check the receiver's plug"};
inline constexpr MessageText reversal_in_file{
    "fcu.reversal_in_file",
    {"surface", "parameter"},
    "the airframe file reverses the {surface} for the computer alone, not for the pilot: better {parameter} "
    "1 and nothing in the file"};
inline constexpr MessageText rosflight_status_missing{
    "fcu.rosflight_status_missing",
    {"port", "frames"},
    "{port} talks MAVLink ({frames} frames), but sends no status of ROSflight 2: flash ROSflight firmware 2, "
    "or choose the right port."};
inline constexpr MessageText round_trip_excessive{"fcu.round_trip_excessive", "too slow to fly on"};
inline constexpr MessageText round_trip_long{"fcu.round_trip_long", "more than 10 ms"};
inline constexpr MessageText round_trip_missing{"fcu.round_trip_missing",
                                                "none of 20 questions was answered within 100 ms: too slow "
                                                "to fly on, or the line to the controller is cut"};
inline constexpr MessageText sample_line_invalid{
    "fcu.sample_line_invalid", {"file", "line"}, "{file}:{line}: expected three numbers in tesla: x, y, z."};
inline constexpr MessageText samples_not_readable{
    "fcu.samples_not_readable", {"file"}, "{file} cannot be read."};
inline constexpr MessageText sampling_timeout{
    "fcu.sampling_timeout", "Nothing new came for two minutes: given up, nothing was changed."};
inline constexpr MessageText sensors_not_started{
    "fcu.sensors_not_started",
    {"count"},
    "{count} did not start: 'fulmar fcu status' shows which are silent; power-cycle it"};
inline constexpr MessageText set_not_confirmed{
    "fcu.set_not_confirmed",
    {"port", "parameter"},
    "{port} does not answer: whether {parameter} was set is not known."};
inline constexpr MessageText set_not_effective{"fcu.set_not_effective",
                                               {"parameter", "wanted", "found"},
                                               "{parameter} did not take {wanted}: it is still {found}."};
inline constexpr MessageText side_in_progress{
    "fcu.side_in_progress",
    {"progress", "side", "count"},
    "{progress}Now {side}: turn it once around, slowly: {count} of 12."};
inline constexpr MessageText status_lost{
    "fcu.status_lost", {"port"}, "{port} has stopped sending its status: unplugged, or rebooting?"};
inline constexpr MessageText status_lost_during_test{
    "fcu.status_lost_during_test", {"port"}, "{port} went silent: the test has stopped."};
inline constexpr MessageText stick_override_off{
    "fcu.stick_override_off",
    {"found"},
    "RC_OVRD_DEV is {found}: moving the sticks does not take over, only the switch does"};
inline constexpr MessageText subcommand_missing{
    "fcu.subcommand_missing",
    {"command", "choices"},
    "fulmar fcu{command}: say what: {choices}; --help tells more."};
inline constexpr MessageText subcommand_unknown{
    "fcu.subcommand_unknown",
    {"command", "found", "choices"},
    "fulmar fcu{command}: there is no command '{found}'.{choices}"};
inline constexpr MessageText surface_reversed_twice{
    "fcu.surface_reversed_twice",
    {"parameter", "surface"},
    "{parameter} is 1 and the airframe file says reversed: the {surface} would be turned round twice; take "
    "one away"};
inline constexpr MessageText terminal_required{
    "fcu.terminal_required",
    "The aircraft is turned by hand, which takes a terminal; or use --from FILE.csv."};
inline constexpr MessageText text_received{"fcu.text_received",
                                           {"port"},
                                           "{port} sends text, not MAVLink: it is no flight controller, a "
                                           "GNSS receiver perhaps; name another --port."};
inline constexpr MessageText throttle_axis_invalid{
    "fcu.throttle_axis_invalid",
    {"found"},
    "RC_F_AXIS is {found}: the throttle of a fixed wing is u[0]; set it to 0"};
inline constexpr MessageText throttle_limited_by_pilot{
    "fcu.throttle_limited_by_pilot",
    "TAKE_MIN_THR is 1: the computer's throttle counts only below the pilot's stick; set 0, or fly with the "
    "stick up"};
inline constexpr MessageText timeout_too_long{"fcu.timeout_too_long",
                                              "so long it flies on without a computer; 100 is usual"};
inline constexpr MessageText timeout_too_short{"fcu.timeout_too_short",
                                               "commands may come each 50 ms; set 100"};
inline constexpr MessageText trim_too_large{
    "fcu.trim_too_large",
    {"parameter", "found"},
    "{parameter} is {found}, and is added to every command: trim the linkage instead"};
inline constexpr MessageText value_not_taken{
    "fcu.value_not_taken", {"parameter"}, "{parameter} did not take its value: try again."};
inline constexpr MessageText value_out_of_range{"fcu.value_out_of_range",
                                                {"parameter", "minimum", "maximum", "found"},
                                                "{parameter} is {minimum} to {maximum}, not {found}: the "
                                                "controller would take it, and not work with it."};
inline constexpr MessageText values_restored{"fcu.values_restored", " The former values are back."};
inline constexpr MessageText version_not_reported{"fcu.version_not_reported",
                                                  {"port"},
                                                  "{port} sends, but does not answer: a flight controller "
                                                  "older than ROSflight 2, or the line to it is cut."};
inline constexpr MessageText version_refused{"fcu.version_refused",
                                             "The controller refuses to tell its version."};
inline constexpr MessageText version_while_armed{
    "fcu.version_while_armed",
    "The aircraft is armed: the controller tells its version only while disarmed."};
inline constexpr MessageText version_withheld{
    "fcu.version_withheld", "it refuses to tell its version, though disarmed: power-cycle it"};
inline constexpr MessageText whole_number_expected{
    "fcu.whole_number_expected", {"parameter", "found"}, "{parameter} is a whole number, not '{found}'."};
inline constexpr MessageText whole_number_too_large{
    "fcu.whole_number_too_large",
    {"found", "parameter"},
    "{found} is too large for {parameter}: it holds whole numbers from -2147483648 to 2147483647."};
inline constexpr MessageText zeroing_in_progress{
    "fcu.zeroing_in_progress",
    {"age"},
    "booted {age} s ago: barometer and airspeed are zeroed in the first 12 s; keep it still"};

}  // namespace fulmar::fcu_messages
