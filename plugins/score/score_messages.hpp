// SPDX-License-Identifier: BSD-3-Clause
// Messages of the score. All errors are root mean squares since the first waypoint was reached. A figure
// without data is unknown_std, which a result shows as null.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar::score {

/// Commands, unfiltered, minus the state of the aircraft; north, east and altitude from the closest point of
/// the plan's route. Take-off, approach, landing, and flight by pilot or failsafe, are excluded.
struct TrackingError {
  double north_m = 0, east_m = 0, altitude_m = 0;      ///< position error
  double roll_rad = 0, pitch_rad = 0, course_rad = 0;  ///< angle errors
  double airspeed_mps = 0;                             ///< airspeed error
  double time_counted_s = 0;                           ///< flight time of these figures
};

/// Estimate minus truth at the same time.
struct EstimationError {
  double north_m = 0, east_m = 0, altitude_m = 0;                       ///< position error
  double vel_x_mps = 0, vel_y_mps = 0, vel_z_mps = 0;                   ///< error of the velocity over
                                                                        ///< ground, each in its own body
                                                                        ///< axes
  double roll_rad = 0, pitch_rad = 0, heading_rad = 0, course_rad = 0;  ///< angle errors
  double airspeed_mps = 0;                                              ///< airspeed error
  double wind_n_mps = 0, wind_e_mps = 0;                                ///< wind error, north and east
};

/// Position of the satellite receiver minus truth, at the time of validity of the fix.
struct GnssError {
  double north_m = 0, east_m = 0;  ///< position error
};

/// Figures of a flight.
struct Figures {
  std::uint32_t waypoints_reached = 0;          ///< number of waypoints passed
  double miss_distance_max_m = unknown_std;     ///< largest miss distance from the route point of a
                                                ///< waypoint, after the first
  double lap_time_s = unknown_std;              ///< duration of the last circuit
  double surface_rate_rms_radps = unknown_std;  ///< rate of aileron, elevator and rudder commands together,
                                                ///< root mean square
  double airspeed_min_mps = unknown_std;        ///< minimum airspeed: of the truth if available, else of the
                                                ///< estimate
  double left_out_s = 0;                        ///< flight time excluded from tracking and from the two
                                                ///< figures above
};

/// The last touch-down, and the roll after it.
struct TouchDown {
  double at_s = 0;                                                 ///< flight time of the touch-down
  double north_m = unknown_std, east_m = unknown_std;              ///< position of the touch-down
  double beyond_threshold_m = unknown_std, cross_m = unknown_std;  ///< position on the runway: beyond the
                                                                   ///< threshold, right of the centre line
  double sink_mps = 0, ground_speed_mps = 0;                       ///< sink rate and ground speed at the
                                                                   ///< touch-down
  double roll_rad = 0, pitch_rad = 0;                              ///< roll and pitch at the touch-down
  double crab_rad = 0;                                             ///< crab angle: yaw minus course over
                                                                   ///< ground
  double run_out_m = 0;                                            ///< distance rolled so far
  double cross_max_m = unknown_std;                                ///< largest distance from the centre line
                                                                   ///< in the roll
};

/// The contact that the airframe did not survive.
struct Crash {
  Text<32> part;                              ///< part with the contact
  double at_s = 0;                            ///< flight time of the contact
  double north_m = 0, east_m = 0;             ///< position of the contact
  double sink_mps = 0, ground_speed_mps = 0;  ///< sink rate and ground speed at the contact
  double roll_rad = 0, pitch_rad = 0;         ///< roll and pitch at the contact
};

/// Result of the flight, for the mission's `verdict:`.
struct Verdict {
  Text<16> word;   ///< verdict in one word: "crashed"; empty: verdict of the host
  Text<320> text;  ///< report of the crash, and of the answer of safety before it
};

}  // namespace fulmar::score
