// SPDX-License-Identifier: BSD-3-Clause
// Track and commands of a flight, from its log.
#pragma once
#include <filesystem>
#include <vector>

namespace fulmar::aero {

/// SI units, rad; relative to the mission's origin. `time_s`: flight time.
struct TrackPoint {
  double time_s = 0, north_m = 0, east_m = 0, height_m = 0, airspeed_mps = 0, roll_rad = 0, pitch_rad = 0,
         alpha_rad = 0;
};
struct CommandPoint {
  double time_s = 0, height_m = 0, airspeed_mps = 0;
};
struct AttitudePoint {
  double time_s = 0, roll_rad = 0, pitch_rad = 0;
};

/// One point of each kind every `track_step_s`.
struct FlightTrack {
  std::vector<TrackPoint> truth;
  std::vector<CommandPoint> commands;
  std::vector<AttitudePoint> attitudes;
};
inline constexpr double track_step_s = 0.25;

/// Track from a log of this installation's host: topics /vehicle/truth, /guide/command, /outer/attitude. A
/// missing topic leaves its list empty. Throws core::Error without a log.
FlightTrack track_of(const std::filesystem::path& log);

}  // namespace fulmar::aero
