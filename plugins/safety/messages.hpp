// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::safety_messages {

inline constexpr MessageText above_ceiling{
    "safety.above_ceiling", {"distance"}, "above the ceiling by {distance} m"};
inline constexpr MessageText aircraft_flies{"safety.aircraft_flies", "the aircraft flies"};
inline constexpr MessageText airspeed_back{"safety.airspeed_back", "airspeed measured again"};
inline constexpr MessageText airspeed_estimated{"safety.airspeed_estimated",
                                                "airspeed estimated from GNSS and wind"};
inline constexpr MessageText alarm{
    "safety.alarm", {"cause", "answer", "pilot"}, "{cause}: {answer}. Pilot: {pilot}"};
inline constexpr MessageText attitude_back{"safety.attitude_back", "attitude in limits"};
inline constexpr MessageText attitude_unreliable{"safety.attitude_unreliable",
                                                 "the attitude is not reliable. Pilot: take over"};
inline constexpr MessageText bank_follows{"safety.bank_follows", "bank follows its command"};
inline constexpr MessageText bank_off{
    "safety.bank_off",
    {"angle"},
    "bank {angle} deg off its command: the ailerons do not turn it. Pilot: take over"};
inline constexpr MessageText battery_charged{"safety.battery_charged", "battery not empty"};
inline constexpr MessageText battery_empty{
    "safety.battery_empty", {"voltage"}, "battery empty, {voltage} V. Pilot: land now"};
inline constexpr MessageText battery_high{"safety.battery_high", "battery not low"};
inline constexpr MessageText battery_limits_crossed{
    "safety.battery_limits_crossed",
    {"found", "low_name", "low"},
    "{found} is above {low_name}, {low}: lower it, or raise {low_name}"};
inline constexpr MessageText battery_low{
    "safety.battery_low", {"voltage"}, "battery low, {voltage} V. Pilot: return and land"};
inline constexpr MessageText battery_missing{"safety.battery_missing", "battery"};
inline constexpr MessageText below_floor{
    "safety.below_floor", {"distance"}, "below the floor by {distance} m"};
inline constexpr MessageText biased{"safety.biased", "biased"};
inline constexpr MessageText charge_left{"safety.charge_left", {"cause", "share"}, "{cause}, {share} %"};
inline constexpr MessageText cleared{"safety.cleared", {"cause", "answer"}, "{cause}: {answer}"};
inline constexpr MessageText cleared_still{
    "safety.cleared_still", {"cause", "answer"}, "{cause}: still {answer}"};
inline constexpr MessageText dead_reckoning{"safety.dead_reckoning", "dead reckoning by air data"};
inline constexpr MessageText descends{"safety.descends", "descends in a circle, motor off"};
inline constexpr MessageText descends_near_fence{
    "safety.descends_near_fence",
    {"time", "answer"},
    "near the fence after {time} s without position: {answer}. Pilot: take over"};
inline constexpr MessageText descends_without_position{
    "safety.descends_without_position",
    {"time", "answer"},
    "no position for {time} s: {answer}. Pilot: take over"};
inline constexpr MessageText drift_ended{"safety.drift_ended",
                                         "wind below the top airspeed: holds its ground"};
inline constexpr MessageText drifts{
    "safety.drifts",
    {"speed"},
    "wind {speed} m/s exceeds the top airspeed: nose into wind, drifts. Pilot: land"};
inline constexpr MessageText engine_failed{"safety.engine_failed",
                                           "no thrust from the motor. Pilot: land ahead"};
inline constexpr MessageText engine_weak{
    "safety.engine_weak", {"share"}, "weak motor, {share} % of its thrust, or ice. Pilot: return and land"};
inline constexpr MessageText estimate_back{"safety.estimate_back", "estimate valid"};
inline constexpr MessageText estimate_missing{"safety.estimate_missing", "estimate"};
inline constexpr MessageText finishes{"safety.finishes", "finishes the landing"};
inline constexpr MessageText glides{"safety.glides", "glides down"};
inline constexpr MessageText goes_on{"safety.goes_on", "goes on"};
inline constexpr MessageText heading_by_course{"safety.heading_by_course", "heading by GNSS course"};
inline constexpr MessageText height_by_gnss{"safety.height_by_gnss", "height by GNSS"};
inline constexpr MessageText home_near_fence{
    "safety.home_near_fence",
    {"north", "east", "distance", "margin"},
    "home, at {north} m north, {east} m east, is {distance} m from the fence. Move it or a corner, or reduce "
    "fence_margin, {margin} m"};
inline constexpr MessageText home_outside_fence{
    "safety.home_outside_fence",
    {"north", "east"},
    "home, at {north} m north, {east} m east, is outside the fence. Move home, or the corners around it"};
inline constexpr MessageText in_order{"safety.in_order", "in order"};
inline constexpr MessageText inertial_back{"safety.inertial_back",
                                           "gyro and accelerometer agree with the other sensors again"};
inline constexpr MessageText inertial_wrong{
    "safety.inertial_wrong",
    "gyro or accelerometer wrong, several sensors contradict them. Pilot: take over"};
inline constexpr MessageText inside_fence{"safety.inside_fence", "inside the fence"};
inline constexpr MessageText inside_fence_returning{"safety.inside_fence_returning",
                                                    "inside the fence, the return goes on"};
inline constexpr MessageText lands{"safety.lands", "returns and lands"};
inline constexpr MessageText lands_after_return{
    "safety.lands_after_return", {"time"}, "returning for {time} s: lands. Pilot: clear the runway"};
inline constexpr MessageText levels{"safety.levels", "levels the wings"};
inline constexpr MessageText lift_off{"safety.lift_off", "lift-off"};
inline constexpr MessageText link_back{"safety.link_back", "vehicle status back"};
inline constexpr MessageText magnetometer_turned{
    "safety.magnetometer_turned",
    {"angle"},
    "magnetometer mounted {angle} deg off: heading set by GNSS, angle corrected. Pilot: check mount"};
inline constexpr MessageText motor_back{"safety.motor_back", "the motor gives thrust"};
inline constexpr MessageText near_ceiling{"safety.near_ceiling", {"distance"}, "{distance} m to the ceiling"};
inline constexpr MessageText near_fence{"safety.near_fence", {"distance"}, "{distance} m to the fence"};
inline constexpr MessageText near_floor{"safety.near_floor", {"distance"}, "{distance} m to the floor"};
inline constexpr MessageText noisy{"safety.noisy", "noisy"};
inline constexpr MessageText not_ready{"safety.not_ready", {"causes"}, "not ready: {causes}"};
inline constexpr MessageText outside_fence{
    "safety.outside_fence", {"distance"}, "outside the fence by {distance} m"};
inline constexpr MessageText pitch_follows{"safety.pitch_follows", "pitch follows its command"};
inline constexpr MessageText pitch_off{
    "safety.pitch_off",
    {"angle"},
    "pitch {angle} deg off its command: the elevator does not turn it. Pilot: take over"};
inline constexpr MessageText pitot_missing{"safety.pitot_missing", "pitot"};
inline constexpr MessageText places_missing{"safety.places_missing",
                                            "the list has no place: add at least one. The first is home"};
inline constexpr MessageText position_back{"safety.position_back", "position back"};
inline constexpr MessageText position_lost{
    "safety.position_lost", "position lost: it is reckoned by air data and drifts. Pilot: be ready"};
inline constexpr MessageText position_missing{"safety.position_missing", "position"};
inline constexpr MessageText position_valid{"safety.position_valid", "the position is valid again"};
inline constexpr MessageText radio_back{"safety.radio_back", "radio back"};
inline constexpr MessageText radio_missing{"safety.radio_missing", "radio"};
inline constexpr MessageText ready{"safety.ready", "ready for take-off"};
inline constexpr MessageText rejected{"safety.rejected", "refused, it contradicts the others"};
inline constexpr MessageText returns{"safety.returns", "returns home"};
inline constexpr MessageText sensor_back{
    "safety.sensor_back", {"sensor", "time"}, "{sensor} in order again after {time} s"};
inline constexpr MessageText sensor_failed{
    "safety.sensor_failed", {"sensor", "state", "answer"}, "{sensor} {state}: {answer}"};
inline constexpr MessageText silent{"safety.silent", "silent"};
inline constexpr MessageText still_in_air{"safety.still_in_air", "still in the air"};
inline constexpr MessageText stuck{"safety.stuck", "stuck"};
inline constexpr MessageText tail_wind{"safety.tail_wind", "tail wind in the run"};
inline constexpr MessageText throttle_locked{
    "safety.throttle_locked",
    "landed: the throttle stays closed until the pilot hands over or a take-off is requested"};
inline constexpr MessageText thrust_back{"safety.thrust_back", "the motor has its thrust"};
inline constexpr MessageText thrust_left{
    "safety.thrust_left", {"cause", "share"}, "{cause}, {share} % of its thrust"};
inline constexpr MessageText tilted{
    "safety.tilted", {"cause", "roll", "pitch"}, "{cause}, roll {roll}, pitch {pitch} deg"};
inline constexpr MessageText touch_down{"safety.touch_down", "touch-down"};
inline constexpr MessageText velocity_by_position{"safety.velocity_by_position",
                                                  "velocity by position and air data"};
inline constexpr MessageText waits{"safety.waits", "circles and waits"};
inline constexpr MessageText wind_at{"safety.wind_at", {"cause", "speed"}, "{cause}, {speed} m/s"};
inline constexpr MessageText wind_back{"safety.wind_back", "wind below the limit"};
inline constexpr MessageText wind_excessive{
    "safety.wind_excessive", {"speed"}, "wind {speed} m/s, above the limit. Pilot: return and land"};
inline constexpr MessageText wind_strong{"safety.wind_strong", {"speed"}, "wind {speed} m/s"};

}  // namespace fulmar::safety_messages
