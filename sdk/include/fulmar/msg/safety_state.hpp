// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Answer of the aircraft to the failures: the first value that applies. It is one value, so that exactly one
/// condition of a mission holds.
enum class SafetyAnswer : std::uint8_t {
  none,     ///< continue; on the ground always
  level,    ///< wings level: excessive attitude, or invalid estimate
  glide,    ///< down without motor, at once, to the nearest place in range
  descend,  ///< down without motor in a circle: position lost for too long
  wait,     ///< circle at this height: no position
  land,     ///< return and land
  home      ///< return and circle there
};

/// Direction in which the geofence leaves room for a turn back.
enum class SafetyTurn : std::uint8_t { either, left, right };

/// Reasons against a take-off of an aircraft on the ground; in the air all are false.
struct NotReady {
  bool estimator = false;  ///< invalid attitude, height or velocity
  bool position = false;   ///< invalid position, or failed receiver
  bool pitot = false;      ///< silent or stuck pitot
  bool radio = false;      ///< radio lost, or required and silent
  bool battery = false;    ///< low or empty battery
  bool wind = false;       ///< wind above the take-off limit
  bool fence = false;      ///< position outside the geofence, or within its margin
  bool height = false;     ///< height above the ceiling, or within its margin
  bool motor = false;      ///< no acceleration at open throttle, until a change of control or a disarming
};

/// Failures for the phases of a mission. Each flag is set and cleared with its own delay.
struct SafetyState {
  bool fence = false;                        ///< geofence violation, present or unavoidable without an
                                             ///< immediate turn back
  bool gnss_lost = false;                    ///< no usable position
  bool pitot_lost = false;                   ///< no measured airspeed
  bool radio_lost = false;                   ///< no frames of the pilot's transmitter
  bool link_lost = false;                    ///< no status of the vehicle
  bool battery_low = false;                  ///< low battery, sufficient for the return
  bool battery_empty = false;                ///< empty battery
  bool attitude_excessive = false;           ///< excessive roll or pitch
  bool engine_failed = false;                ///< missing thrust at open throttle
  bool wind_excessive = false;               ///< excessive wind for the cruise airspeed
  bool estimator_failed = false;             ///< invalid attitude, velocity or height
  bool airborne = false;                     ///< true in flight
  SafetyAnswer answer = SafetyAnswer::none;  ///< answer to the failures
  SafetyTurn turn = SafetyTurn::either;      ///< direction of a turn back
  double fence_margin_m = 1e9;               ///< room left by a turn back, on the ground the distance;
                                             ///< negative: outside; 1e9: no geofence
  double height_margin_m = 1e9;              ///< room to floor and ceiling, less that of the pull-out
  double floor_m = -1e9, ceiling_m = 1e9;    ///< floor and ceiling of the geofence, above the origin
  double thrust_ratio = 1;                   ///< ratio of the force along the flight path to the model at
                                             ///< this throttle
  double wind_ratio = 0;                     ///< ratio of wind speed to cruise airspeed
  double waiting_s = 0;                      ///< time since the position was lost
  double returning_s = 0;                    ///< time since the start of the answer `home`
  bool engine_weak = false;                  ///< less thrust than modelled, but enough for level flight
  bool drifting = false;                     ///< wind above the largest airspeed
  bool ready = false;                        ///< on the ground without a reason against a take-off
  NotReady not_ready;                        ///< reasons against a take-off
};

template <>
inline constexpr std::string_view appended_from<SafetyState> = "engine_weak";

}  // namespace fulmar
