// SPDX-License-Identifier: BSD-3-Clause
// What the score publishes. All errors are root mean squares since the first waypoint was reached.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar::score {

/// Set-points, raw, minus where the aircraft is; north, east and altitude from the closest point of the
/// plan's route. The course of a flight that was never asked for one is unknown_std.
struct TrackingError {
  double north_m = 0, east_m = 0, altitude_m = 0;
  double roll_rad = 0, pitch_rad = 0, course_rad = 0;
  double airspeed_mps = 0;
};

/// Estimate minus truth, both at one time.
struct EstimationError {
  double north_m = 0, east_m = 0, altitude_m = 0;
  double vel_x_mps = 0, vel_y_mps = 0, vel_z_mps = 0;  ///< velocity over ground, each in its own body axes
  double roll_rad = 0, pitch_rad = 0, heading_rad = 0, course_rad = 0;
  double airspeed_mps = 0;
  double wind_n_mps = 0, wind_e_mps = 0;
};

/// Position of the satellite receiver minus truth, at the time for which the fix is valid.
struct GnssError {
  double north_m = 0, east_m = 0;
};

struct Figures {
  std::uint32_t waypoints_reached = 0;
  double miss_distance_max_m = 0;     ///< from the route's point of a waypoint, after the first
  double lap_time_s = 0;              ///< of the circuit flown last; 0 before
  double surface_rate_rms_radps = 0;  ///< of aileron, elevator and rudder commands together
  double airspeed_min_mps = 0;        ///< true if the truth is at hand, else estimated
};

}  // namespace fulmar::score
