// SPDX-License-Identifier: BSD-3-Clause
// What the score publishes. All errors are root mean squares since the first waypoint was reached. A figure
// without data is unknown_std, which a result shows as null.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar::score {

/// Set-points, raw, minus where the aircraft is; north, east and altitude from the closest point of the
/// plan's route. Take-off, approach, landing, and what pilot or failsafe flew, are left out.
struct TrackingError {
  double north_m = 0, east_m = 0, altitude_m = 0;
  double roll_rad = 0, pitch_rad = 0, course_rad = 0;
  double airspeed_mps = 0;
  double time_counted_s = 0;  ///< of flight, of which these figures are
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
  double miss_distance_max_m = unknown_std;     ///< from the route's point of a waypoint, after the first
  double lap_time_s = unknown_std;              ///< of the circuit flown last
  double surface_rate_rms_radps = unknown_std;  ///< of aileron, elevator and rudder commands together
  double airspeed_min_mps = unknown_std;        ///< true if the truth is at hand, else estimated
  double left_out_s = 0;  ///< in the air, of which tracking and the two above count nothing
};

/// The last touch-down, and the roll after it.
struct TouchDown {
  double at_s = 0;  ///< flight time
  double north_m = unknown_std, east_m = unknown_std;
  double beyond_threshold_m = unknown_std, cross_m = unknown_std;  ///< on the runway; right of its middle
  double sink_mps = 0, ground_speed_mps = 0;
  double roll_rad = 0, pitch_rad = 0;
  double crab_rad = 0;               ///< nose minus course over ground
  double run_out_m = 0;              ///< from there to where it is now, or stands
  double cross_max_m = unknown_std;  ///< farthest from the middle of the runway in the roll
};

/// The contact that the airframe did not survive.
struct Crash {
  Text<32> part;  ///< what touched
  double at_s = 0;
  double north_m = 0, east_m = 0;
  double sink_mps = 0, ground_speed_mps = 0;
  double roll_rad = 0, pitch_rad = 0;
};

/// How the flight went, for the mission's `verdict:`.
struct Verdict {
  Text<16> word;   ///< "crashed"; empty: the host's own
  Text<320> text;  ///< the crash, and what safety did before
};

}  // namespace fulmar::score
