// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "fulmar/message.hpp"

namespace fulmar {

/// Where the aircraft is and how it moves: an estimate, or the truth of a simulator. The origin of the local
/// frame is in it. A quantity whose flag is false holds a finite stand-in and must not be used.
///
/// Where an estimator does not move its state by degrees but sets it, it counts one more `reset_count` and
/// says by how much: no aircraft has moved so. Who keeps a position, a velocity or a heading of before moves
/// it along.
struct VehicleState {
  Vec3<Ned> position_m;    ///< of the centre of gravity, from the origin
  Vec3<Ned> velocity_mps;  ///< relative to the ground
  Quat attitude;           ///< body to NED
  double roll_rad = 0;     ///< 3-2-1 Euler angles of `attitude`
  double pitch_rad = 0;
  double yaw_rad = 0;
  Vec3<Body> rate_radps;           ///< body rate relative to NED, bias removed
  Vec3<Body> specific_force_mps2;  ///< bias removed
  double height_m = 0;             ///< above the origin: -position.down over flat ground
  double climb_rate_mps = 0;       ///< -velocity.down
  double ground_speed_mps = 0;     ///< horizontal
  double course_rad = 0;           ///< of the horizontal velocity; yaw while there is none to speak of
  double airspeed_mps = 0;         ///< true airspeed
  double alpha_rad = 0;            ///< angle of attack, atan2(w, u) of the air-relative velocity
  double beta_rad = 0;             ///< sideslip, asin(v / Va)
  Vec3<Ned> wind_mps;              ///< velocity of the air
  Vec3<Body> gyro_bias_radps;
  Vec3<Body> accel_bias_mps2;
  Vec3<Ned> position_std_m{unknown_std, unknown_std, unknown_std};
  Vec3<Ned> velocity_std_mps{unknown_std, unknown_std, unknown_std};
  Vec3<Ned> attitude_std_rad{unknown_std, unknown_std, unknown_std};  ///< small rotation about each NED axis
  Vec3<Ned> wind_std_mps{unknown_std, unknown_std, unknown_std};
  double airspeed_std_mps = unknown_std;
  double origin_latitude_deg = 0;
  double origin_longitude_deg = 0;
  double origin_altitude_m = 0;  ///< above mean sea level
  bool origin_valid = false;
  bool attitude_valid = false;
  bool velocity_valid = false;
  bool position_valid = false;  ///< horizontal
  bool height_valid = false;
  bool airspeed_valid = false;
  bool wind_valid = false;
  std::uint32_t reset_count = 0;     ///< since the start; the first attitude and the first position are none
  Vec3<Ned> reset_position_m;        ///< of the last reset: state after it minus state before it
  Vec3<Ned> reset_velocity_mps;      ///< the same
  double reset_yaw_rad = 0;          ///< the same
  bool airspeed_from_model = false;  ///< no tube says it: thrust and drag, as learnt while one did, stand in
};

template <>
inline constexpr std::string_view appended_from<VehicleState> = "reset_count";

}  // namespace fulmar
