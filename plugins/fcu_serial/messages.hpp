// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp). A notice has 95 characters.
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::fcu_serial_messages {

inline constexpr MessageText armed{"fcu_serial.armed", "armed"};
inline constexpr MessageText attitude_known{"fcu_serial.attitude_known",
                                            "the attitude is valid again: commands are sent"};
inline constexpr MessageText attitude_lost{
    "fcu_serial.attitude_lost", "pilot: take over. The attitude is lost, the surfaces are only held"};
inline constexpr MessageText attitude_switch{"fcu_serial.attitude_switch", "attitude switch"};
inline constexpr MessageText attitude_unknown{
    "fcu_serial.attitude_unknown",
    "the attitude is not valid: no command is sent, the pilot has the aircraft"};
inline constexpr MessageText attitude_valid{"fcu_serial.attitude_valid", "the attitude is valid again"};
inline constexpr MessageText aux_not_finite{"fcu_serial.aux_not_finite",
                                            "an auxiliary output is not finite; such outputs are not sent"};
inline constexpr MessageText buffer_overrun{"fcu_serial.buffer_overrun", "a buffer ran over"};
inline constexpr MessageText calibration{"fcu_serial.calibration",
                                         {"accel", "gyro", "pitot"},
                                         "calibration: accel {accel}, gyro {gyro}, pitot {pitot} Pa"};
inline constexpr MessageText command_not_finite{"fcu_serial.command_not_finite",
                                                "a command is not finite; such commands are not sent"};
inline constexpr MessageText computer_fast_again{"fcu_serial.computer_fast_again",
                                                 "this computer keeps up again"};
inline constexpr MessageText computer_slow{
    "fcu_serial.computer_slow",
    {"share"},
    "this computer is too slow: {share} % of the inertial samples are too old when they are read"};
inline constexpr MessageText connected{"fcu_serial.connected", {"version"}, "connected: ROSflight {version}"};
inline constexpr MessageText connected_armed{
    "fcu_serial.connected_armed", "connected: an armed flight controller, which does not report its version"};
inline constexpr MessageText control_unsteady{"fcu_serial.control_unsteady",
                                              "control comes and goes: the line loses too many frames"};
inline constexpr MessageText controller_back{
    "fcu_serial.controller_back", {"time"}, "the flight controller is back after {time} s"};
inline constexpr MessageText controller_crashed{
    "fcu_serial.controller_crashed",
    {"count", "error", "address"},
    "the flight controller crashed {count} times; error {error} at {address}"};
inline constexpr MessageText controller_silent{"fcu_serial.controller_silent",
                                               "the flight controller is silent: commands do not reach it"};
inline constexpr MessageText controller_text{
    "fcu_serial.controller_text", {"text"}, "flight controller: {text}"};
inline constexpr MessageText device_gone{"fcu_serial.device_gone",
                                         "the flight controller's device is gone; looking for it"};
inline constexpr MessageText device_silent{
    "fcu_serial.device_silent",
    {"port"},
    "{port} sends no data. Check that the flight controller has power, and that this is its port"};
inline constexpr MessageText disarmed{"fcu_serial.disarmed", "disarmed"};
inline constexpr MessageText error_gone{"fcu_serial.error_gone", {"error"}, "no longer: {error}"};
inline constexpr MessageText error_reported{
    "fcu_serial.error_reported", {"error"}, "flight controller: {error}"};
inline constexpr MessageText estimator_unhealthy{"fcu_serial.estimator_unhealthy",
                                                 "its attitude estimate is unhealthy"};
inline constexpr MessageText failsafe_entered{
    "fcu_serial.failsafe_entered",
    "failsafe: the flight controller has lost the radio; motor off, surfaces centred"};
inline constexpr MessageText failsafe_invalid{"fcu_serial.failsafe_invalid",
                                              "FAILSAFE_THR is not within 0 to 1"};
inline constexpr MessageText failsafe_over{"fcu_serial.failsafe_over", "failsafe is over"};
inline constexpr MessageText firmware_changed{
    "fcu_serial.firmware_changed", {"version"}, "this is another firmware: ROSflight {version}"};
inline constexpr MessageText firmware_too_old{
    "fcu_serial.firmware_too_old",
    {"port", "version"},
    "the flight controller at {port} runs ROSflight {version}: flash version 2.0 or later"};
inline constexpr MessageText firmware_untried{"fcu_serial.firmware_untried",
                                              {"tried", "version"},
                                              "firmware not tried with Fulmar ({tried} was): {version}"};
inline constexpr MessageText frames_missing{"fcu_serial.frames_missing",
                                            {"bytes", "port"},
                                            "{port} sends {bytes} bytes, but no MAVLink 1 frame: it is not a "
                                            "ROSflight flight controller. Name another port"};
inline constexpr MessageText frames_missing_at_baud{
    "fcu_serial.frames_missing_at_baud",
    {"bytes", "port", "baud"},
    "{port} sends {bytes} bytes at {baud} baud, but no MAVLink 1 frame. Set the baud rate of the flight "
    "controller (ROSflight: 921600), or name another port"};
inline constexpr MessageText gnss_back{"fcu_serial.gnss_back", {"time"}, "GNSS is back after {time} s"};
inline constexpr MessageText gnss_lost{"fcu_serial.gnss_lost",
                                       "GNSS lost: no fix; the position is reckoned on from air data"};
inline constexpr MessageText imu_back{"fcu_serial.imu_back", "inertial samples come again"};
inline constexpr MessageText imu_missing{"fcu_serial.imu_missing",
                                         {"port"},
                                         "{port} sends MAVLink, but no inertial samples. Power-cycle the "
                                         "flight controller; if that does not help, flash ROSflight 2"};
inline constexpr MessageText imu_silent{
    "fcu_serial.imu_silent", "no inertial samples: the flight controller's own control has stopped"};
inline constexpr MessageText imu_uncalibrated{"fcu_serial.imu_uncalibrated",
                                              "uncalibrated: fulmar fcu calibrate imu"};
inline constexpr MessageText imu_unresponsive{"fcu_serial.imu_unresponsive",
                                              "its inertial unit does not answer"};
inline constexpr MessageText in_control{"fcu_serial.in_control", "in control"};
inline constexpr MessageText lower_throttle{"fcu_serial.lower_throttle", "lower throttle"};
inline constexpr MessageText mavlink_2{"fcu_serial.mavlink_2",
                                       {"port"},
                                       "{port} sends MAVLink 2, as PX4 and ArduPilot do. Connect a flight "
                                       "controller with ROSflight 2, or flash it"};
inline constexpr MessageText mixer_invalid{"fcu_serial.mixer_invalid", "invalid mixer: set PRIMARY_MIXER"};
// An H7 board cannot reboot itself.
inline constexpr MessageText not_fixed_wing{
    "fcu_serial.not_fixed_wing",
    {"port"},
    "the flight controller at {port} is set up for a multirotor. Set FIXED_WING to 1 and PRIMARY_MIXER to 9 "
    "(fixed wing), 10 (V-tail) or 11 (your own matrix), write the parameters, and power-cycle it"};
inline constexpr MessageText not_in_control{"fcu_serial.not_in_control", "not in control"};
inline constexpr MessageText not_ready{"fcu_serial.not_ready", {"missing"}, "not ready: {missing}"};
inline constexpr MessageText not_ready_armed_before{
    "fcu_serial.not_ready_armed_before",
    {"missing"},
    "not ready: {missing}; armed before: on the ground disarm"};
inline constexpr MessageText other_autopilot{
    "fcu_serial.other_autopilot",
    {"port", "make"},
    "the autopilot at {port} is of another make (MAV_AUTOPILOT {make}). Connect a flight controller with "
    "ROSflight 2, or flash it"};
inline constexpr MessageText param_changed{
    "fcu_serial.param_changed", {"name", "value"}, "the flight controller's {name} is now {value}"};
inline constexpr MessageText params_changed{
    "fcu_serial.params_changed", {"count"}, "parameters that differ from before: {count}; see the log"};
inline constexpr MessageText params_logged{
    "fcu_serial.params_logged", {"count"}, "its {count} parameters are in the log"};
inline constexpr MessageText params_missing{
    "fcu_serial.params_missing",
    {"missing", "count"},
    "{missing} of its {count} parameters do not come: the log lacks them"};
inline constexpr MessageText pilot_flies{"fcu_serial.pilot_flies", {"reasons"}, "the pilot flies: {reasons}"};
inline constexpr MessageText pilot_hands_over{"fcu_serial.pilot_hands_over", "the pilot hands over"};
inline constexpr MessageText pitch_stick{"fcu_serial.pitch_stick", "pitch stick"};
inline constexpr MessageText pitot_used_again{"fcu_serial.pitot_used_again",
                                              "the pitot is zeroed again: it is used"};
inline constexpr MessageText pitot_zero_off{
    "fcu_serial.pitot_zero_off",
    {"pressure"},
    "pitot zeroed at {pressure} Pa, in wind or in the air: it is not used; zero it on the ground"};
inline constexpr MessageText pitot_zero_wrong{
    "fcu_serial.pitot_zero_wrong",
    "pitot zeroed wrong, in wind or in the air: it is not used; zero it on the ground"};
inline constexpr MessageText pitot_zeroed_in_flight{
    "fcu_serial.pitot_zeroed_in_flight",
    "airspeed zeroed in flight by a reboot: pitot not used any more, restart on the ground"};
inline constexpr MessageText port_unset{
    "fcu_serial.port_unset",
    "the parameter 'port' is not set. Name the flight controller's port, such as /dev/ttyACM0"};
inline constexpr MessageText radio_back{"fcu_serial.radio_back", "frames of the radio come again"};
inline constexpr MessageText radio_frozen{
    "fcu_serial.radio_frozen", "no frames of the radio: the outputs are frozen, commands move nothing"};
inline constexpr MessageText radio_lost{"fcu_serial.radio_lost", "no radio: switch the transmitter on"};
inline constexpr MessageText radio_missing{
    "fcu_serial.radio_missing", "no frames of the radio: check the plug of the receiver, and RC_TYPE"};
inline constexpr MessageText ready{"fcu_serial.ready", "ready"};
inline constexpr MessageText ready_but{"fcu_serial.ready_but", {"missing"}, "ready, but {missing}"};
inline constexpr MessageText ready_switch_back{"fcu_serial.ready_switch_back",
                                               "ready: switch to the pilot and back to hand over"};
inline constexpr MessageText ready_switch_back_but{
    "fcu_serial.ready_switch_back_but",
    {"missing"},
    "ready: switch to the pilot and back to hand over, but {missing}"};
inline constexpr MessageText rebooted{"fcu_serial.rebooted", "the flight controller has rebooted"};
inline constexpr MessageText rebooted_armed{
    "fcu_serial.rebooted_armed",
    "the flight controller has rebooted while armed: its motor is off until it is armed again"};
inline constexpr MessageText reversed_twice{
    "fcu_serial.reversed_twice",
    {"parameter"},
    "{parameter} is set, and the airframe file reverses it again: remove one of them"};
inline constexpr MessageText roll_stick{"fcu_serial.roll_stick", "roll stick"};
inline constexpr MessageText secondary_mixer_unset{
    "fcu_serial.secondary_mixer_unset",
    "flight controller: no secondary mixer, the primary one serves for both"};
inline constexpr MessageText sensors_dead{
    "fcu_serial.sensors_dead", {"count"}, "{count} sensors of the flight controller did not start"};
inline constexpr MessageText state_unwired{
    "fcu_serial.state_unwired", "send_attitude: the input 'state' gets no data. Connect it in wires:"};
inline constexpr MessageText stood_still{
    "fcu_serial.stood_still",
    {"time"},
    "this computer stood still for {time} s: no command went out meanwhile"};
inline constexpr MessageText text_received{
    "fcu_serial.text_received",
    {"port"},
    "{port} sends text, not MAVLink: it may be a GNSS receiver. Name the port of the flight controller"};
inline constexpr MessageText throttle_switch{"fcu_serial.throttle_switch", "throttle switch"};
inline constexpr MessageText throw_too_small{
    "fcu_serial.throw_too_small",
    {"surface", "found"},
    "{found} rad is too small for the throw of the {surface}: give more than 0.01 rad"};
inline constexpr MessageText time_backwards{"fcu_serial.time_backwards",
                                            "its time went backwards: power-cycle it"};
inline constexpr MessageText values_implausible{
    "fcu_serial.values_implausible", {"sensor"}, "the {sensor} gives implausible values; they are not used"};
inline constexpr MessageText version_missing{"fcu_serial.version_missing",
                                             {"port"},
                                             "the flight controller at {port} does not report its version: "
                                             "it is older than ROSflight 2.0. Flash version 2.0 or later"};
inline constexpr MessageText yaw_stick{"fcu_serial.yaw_stick", "yaw stick"};

}  // namespace fulmar::fcu_serial_messages
