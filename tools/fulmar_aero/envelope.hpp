// SPDX-License-Identifier: BSD-3-Clause
// Where steady flight begins and ends.
#pragma once
#include "fulmar/flight/model/steady_flight.hpp"

namespace fulmar::aero {

/// At which the wing's most lift carries the weight in level flight, m/s; 0 when it has none.
double stall_speed(const AircraftModel& model);

/// The airspeeds at which level flight ends, m/s, on both sides of `inside`, at which there must be one; and
/// what stands against it beyond.
struct LevelSpeeds {
  double slowest_mps = 0, fastest_mps = 0;
  TrimLimit below = TrimLimit::none, above = TrimLimit::none;
};
LevelSpeeds level_speeds(const AircraftModel& model, double inside);

/// Rate of climb at full throttle and without throttle (the propeller turns in the wind), m/s up, straight
/// and with level wings; what the propeller's torque takes of aileron and rudder is left out. NaN where the
/// wing stalls, the elevator is at its stop, or it climbs straight up.
double climb_rate(const AircraftModel& model, double airspeed);
double glide_rate(const AircraftModel& model, double airspeed);

}  // namespace fulmar::aero
