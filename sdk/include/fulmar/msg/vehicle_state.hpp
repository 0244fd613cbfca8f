// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "fulmar/message.hpp"

namespace fulmar {

/// Position and motion of the aircraft: an estimate, or the truth of a simulator. It contains the origin of
/// the local frame. A quantity with a false flag has a finite default value and must not be used.
///
/// An estimator that sets its state to a new value increments `reset_count` and publishes the step. A
/// component that stores a position, velocity or heading adds this step to it.
struct VehicleState {
  Vec3<Ned> position_m;            ///< position of the centre of gravity,
                                   ///< from the origin
  Vec3<Ned> velocity_mps;          ///< velocity relative to the ground
  Quat attitude;                   ///< attitude, body to NED
  double roll_rad = 0;             ///< roll, 3-2-1 Euler angle of
                                   ///< `attitude`
  double pitch_rad = 0;            ///< pitch, 3-2-1 Euler angle of
                                   ///< `attitude`
  double yaw_rad = 0;              ///< yaw, 3-2-1 Euler angle of
                                   ///< `attitude`
  Vec3<Body> rate_radps;           ///< body rate relative to NED, bias
                                   ///< removed
  Vec3<Body> specific_force_mps2;  ///< specific force, bias removed
  double height_m = 0;             ///< height above the origin:
                                   ///< -position.down over flat ground
  double climb_rate_mps = 0;       ///< climb rate, -velocity.down
  double ground_speed_mps = 0;     ///< horizontal speed over ground
  double course_rad = 0;           ///< course of the horizontal velocity;
                                   ///< yaw at very low speed
  double airspeed_mps = 0;         ///< true airspeed
  double alpha_rad = 0;            ///< angle of attack, atan2(w, u) of the air-relative velocity
  double beta_rad = 0;             ///< sideslip, asin(v / Va)
  Vec3<Ned> wind_mps;              ///< velocity of the air
  Vec3<Body> gyro_bias_radps;      ///< bias of the gyros
  Vec3<Body> accel_bias_mps2;      ///< bias of the accelerometers
  Vec3<Ned> position_std_m{unknown_std, unknown_std, unknown_std};    ///< standard deviation of the position
  Vec3<Ned> velocity_std_mps{unknown_std, unknown_std, unknown_std};  ///< standard deviation of the velocity
  Vec3<Ned> attitude_std_rad{unknown_std, unknown_std, unknown_std};  ///< standard deviation of a small
                                                                      ///< rotation about each NED axis
  Vec3<Ned> wind_std_mps{unknown_std, unknown_std, unknown_std};      ///< standard deviation of the wind
  double airspeed_std_mps = unknown_std;                              ///< standard deviation of the airspeed
  double origin_latitude_deg = 0;                                     ///< latitude of the origin, WGS-84
  double origin_longitude_deg = 0;                                    ///< longitude of the origin, WGS-84
  double origin_altitude_m = 0;                                       ///< altitude of the origin above mean
                                                                      ///< sea level
  bool origin_valid = false;                                          ///< validity of the origin
  bool attitude_valid = false;                                        ///< validity of the attitude
  bool velocity_valid = false;                                        ///< validity of the velocity
  bool position_valid = false;                                        ///< validity of the horizontal
                                                                      ///< position
  bool height_valid = false;                                          ///< validity of the height
  bool airspeed_valid = false;                                        ///< validity of the airspeed
  bool wind_valid = false;                                            ///< validity of the wind
  std::uint32_t reset_count = 0;                                      ///< number of resets since the start,
                                                                      ///< without the first attitude and the
                                                                      ///< first position
  Vec3<Ned> reset_position_m;                                         ///< position step of the last reset:
                                                                      ///< state after it minus state before
                                                                      ///< it
  Vec3<Ned> reset_velocity_mps;                                       ///< velocity step of the last reset
  double reset_yaw_rad = 0;                                           ///< yaw step of the last reset
  bool airspeed_from_model = false;                                   ///< source of the airspeed: true
                                                                      ///< without a pitot, by the identified
                                                                      ///< model of thrust and drag
};

template <>
inline constexpr std::string_view appended_from<VehicleState> = "reset_count";

}  // namespace fulmar
