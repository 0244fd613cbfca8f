// SPDX-License-Identifier: BSD-3-Clause
// Limits of steady flight.
#pragma once
#include "fulmar/flight/model/steady_flight.hpp"

namespace fulmar::aero {

/// Airspeed at which the maximum lift equals the weight in level flight, m/s; 0 for none.
double stall_speed(const AircraftModel& model);

/// The airspeeds at which level flight ends, m/s, on both sides of `inside`, at which it must exist; and the
/// limit beyond each.
struct LevelSpeeds {
  double slowest_mps = 0, fastest_mps = 0;
  TrimLimit below = TrimLimit::none, above = TrimLimit::none;
};
LevelSpeeds level_speeds(const AircraftModel& model, double inside);

/// Rate of climb at full throttle and at zero throttle (windmilling propeller), m/s up, in straight flight
/// with level wings, without the torque of the propeller. NaN when the wing stalls, the elevator is
/// saturated, or the path is vertical.
double climb_rate(const AircraftModel& model, double airspeed);
double glide_rate(const AircraftModel& model, double airspeed);

}  // namespace fulmar::aero
