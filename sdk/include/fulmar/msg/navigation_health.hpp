// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// State of a sensor in a navigation filter. If several apply, it is the last of them in this list.
enum class SensorState : std::uint8_t {
  never,    ///< no sample yet
  ok,       ///< samples agree with the others within their standard deviation
  biased,   ///< mean of the innovations off zero, or impossible values
  refused,  ///< all measurements rejected by the gate for a second, or stamps that go back repeatedly
  noisy,    ///< innovations with much more scatter than expected; an inertial unit under vibration
  stuck,    ///< exactly constant values in flight; a saturated axis
  silent    ///< no sample for several of its own intervals; a receiver without a fix
};

struct SensorHealth {
  SensorState state = SensorState::never;   ///< state of the sensor
  std::uint32_t accepted = 0, refused = 0;  ///< number of accepted and rejected measurements
  double innovation_ratio = 0;              ///< last innovation: measured minus expected, in expected
                                            ///< standard deviations
  double innovation_mean_ratio = 0;         ///< mean of the innovation over the last seconds; of several
                                            ///< axes the largest
  double innovation_std_ratio = 1;          ///< standard deviation of the innovation over the last seconds;
                                            ///< 1: as expected
};

/// State of each sensor in the navigation filter. For reports, and for conditions of a mission.
struct NavigationHealth {
  SensorHealth gyro, accel;                                ///< inertial unit; state alone, without
                                                           ///< innovations
  SensorHealth gnss_position, gnss_height, gnss_velocity;  ///< fix: north and east, down, and the three axes
                                                           ///< of the velocity; the innovation is the
                                                           ///< largest of them
  SensorHealth mag, baro, pitot;                           ///< magnetometer, barometer and pitot
  double mag_turn_rad = 0;                                 ///< turn about the body z axis by which samples of
                                                           ///< a magnetometer that is mounted wrong are
                                                           ///< corrected; 0: as mounted
};

template <>
inline constexpr std::string_view appended_from<NavigationHealth> = "mag_turn_rad";

}  // namespace fulmar
