// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// What a navigation filter makes of a sensor. Where several hold, the one that stands later here.
enum class SensorState : std::uint8_t {
  never,    ///< not one sample yet
  ok,       ///< comes, and agrees with the others as far as its deviation says
  biased,   ///< innovations are off to one side and stay so, or it says what cannot be
  refused,  ///< the gate has kept out everything for a second, or its stamps go back again and again
  noisy,    ///< innovations scatter much more than expected; an inertial unit that is shaken
  stuck,    ///< reads exactly the same again and again while the aircraft flies; an axis at its stop
  silent    ///< no sample for several of its own intervals; a receiver without a fix as well
};

struct SensorHealth {
  SensorState state = SensorState::never;
  std::uint32_t accepted = 0, refused = 0;  ///< measurements so far
  double innovation_ratio = 0;              ///< the last one: measured minus expected, in expected deviations
  double innovation_mean_ratio = 0;         ///< over the last seconds; of several axes the one farthest off
  double innovation_std_ratio = 1;          ///< from one to the next, over the last seconds; 1: as expected
};

/// How each sensor does, as the navigation filter sees it. For people, and for conditions of a mission.
struct NavigationHealth {
  SensorHealth gyro, accel;  ///< state alone: nothing is expected of them
  /// Of a fix: north and east, down, and the three of the velocity; the innovation is the largest of them.
  SensorHealth gnss_position, gnss_height, gnss_velocity;
  SensorHealth mag, baro, pitot;
};

}  // namespace fulmar
