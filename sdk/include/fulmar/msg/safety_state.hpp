// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What the aircraft is to do about what has failed: one word, so that exactly one condition of a mission
/// holds, however much fails at once. The one that stands earlier wins.
enum class SafetyAnswer : std::uint8_t {
  none,     ///< go on; on the ground always
  level,    ///< wings level: the attitude is excessive, or the estimate is not to be believed
  glide,    ///< down without motor, now, to the nearest place within reach
  descend,  ///< down without motor in a circle: the position has been unknown for too long
  wait,     ///< circle at this height: the position is not known
  land,     ///< return and land
  home      ///< return and circle there
};

/// Which way round the fence leaves room for a turn back.
enum class SafetyTurn : std::uint8_t { either, left, right };

/// What speaks against a take-off of an aircraft on the ground; in the air all of it is false.
struct NotReady {
  bool estimator = false;  ///< attitude, height or velocity are not valid
  bool position = false;   ///< not valid, or the receiver fails
  bool pitot = false;      ///< silent or stuck
  bool radio = false;      ///< lost, or required and silent
  bool battery = false;    ///< low or empty
  bool wind = false;       ///< above the limit of a take-off
  bool fence = false;      ///< outside of it, or nearer than its margin
  bool height = false;     ///< above its ceiling, or nearer than its margin
  bool motor = false;      ///< no acceleration at open throttle, until a hand-over or a disarming
};

/// What is wrong, of which a mission makes phases. A flag rises and falls with a delay of its own.
struct SafetyState {
  bool fence = false;        ///< it would be left if the aircraft did not turn back now, or has been left
  bool gnss_lost = false;    ///< no position that can be used
  bool pitot_lost = false;   ///< the airspeed is not measured
  bool radio_lost = false;   ///< the pilot's transmitter is not heard
  bool link_lost = false;    ///< the vehicle's status does not come
  bool battery_low = false;  ///< enough to return
  bool battery_empty = false;
  bool attitude_excessive = false;
  bool engine_failed = false;     ///< thrust is demanded, and the energy does not come
  bool wind_excessive = false;    ///< the wind leaves too little of the cruise speed
  bool estimator_failed = false;  ///< attitude, velocity or height are not valid
  bool airborne = false;
  SafetyAnswer answer = SafetyAnswer::none;
  SafetyTurn turn = SafetyTurn::either;
  double fence_margin_m =
      1e9;  ///< room that the turn back leaves, on the ground the distance; negative: outside. 1e9: none
  double height_margin_m = 1e9;            ///< room to floor and ceiling, less what the pull-out takes
  double floor_m = -1e9, ceiling_m = 1e9;  ///< of the fence, above the origin
  double thrust_ratio = 1;   ///< force along the flight path over what the model says of this throttle
  double wind_ratio = 0;     ///< wind speed over cruise airspeed
  double waiting_s = 0;      ///< since the position was lost
  double returning_s = 0;    ///< since the answer is `home`
  bool engine_weak = false;  ///< less thrust than modelled, but enough for level flight
  bool drifting = false;     ///< the wind exceeds the largest airspeed
  bool ready = false;        ///< on the ground, and nothing speaks against a take-off
  NotReady not_ready;
};

template <>
inline constexpr std::string_view appended_from<SafetyState> = "engine_weak";

}  // namespace fulmar
