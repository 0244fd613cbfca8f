// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROSplane 2.0 and ROSflight 2.0, field for field as in the packages rosplane_msgs and
// rosflight_msgs. NED and FRD, SI; angles in radians except latitude and longitude.
#pragma once
#include "ros_messages.hpp"

namespace fulmar::ros_bridge {

struct RosplaneState {
  static constexpr const char* ros_type = "rosplane_msgs/msg/State";
  RosHeader header;
  float p_n = 0, p_e = 0, p_d = 0;
  float v_x = 0, v_y = 0, v_z = 0;  ///< u, v, w: velocity over ground in body axes
  float p = 0, q = 0, r = 0;
  float phi = 0, theta = 0, psi = 0;
  float b_x = 0, b_y = 0, b_z = 0;  ///< gyro bias
  RosQuaternion quat;               ///< body to NED
  double initial_lat = 0, initial_lon = 0, initial_alt = 0;
  float w_n = 0, w_e = 0;
  float va = 0, alpha = 0, beta = 0, chi = 0;
};

struct RosplaneControllerCommands {
  static constexpr const char* ros_type = "rosplane_msgs/msg/ControllerCommands";
  RosHeader header;
  float va_c = 0, h_c = 0, chi_c = 0, phi_ff = 0;
  std::array<float, 4> aux{};
  bool aux_valid = false;
  float theta_c = 0, phi_c = 0;
};

struct RosplaneControllerInternals {
  static constexpr const char* ros_type = "rosplane_msgs/msg/ControllerInternals";
  RosHeader header;
  float theta_c = 0, phi_c = 0;
  std::uint8_t alt_zone = 3;  ///< 0 take-off, 1 climb, 2 descend, 3 altitude hold
};

struct RosplaneCurrentPath {
  static constexpr const char* ros_type = "rosplane_msgs/msg/CurrentPath";
  RosHeader header;
  std::uint8_t path_type = 1;  ///< 0 orbit, 1 line
  float va_d = 0;
  std::array<float, 3> r{}, q{};  ///< line: a point on it, its direction
  std::array<float, 3> c{};       ///< orbit: its centre
  float rho = 0;
  std::int8_t lamda = 1;  ///< 1 clockwise, -1 counter-clockwise
};

struct RosplaneWaypoint {
  static constexpr const char* ros_type = "rosplane_msgs/msg/Waypoint";
  RosHeader header;
  std::array<float, 3> w{};  ///< NED, m; or latitude, longitude, altitude
  bool lla = false;
  float chi_d = 0;
  bool use_chi = false;
  float va_d = 0;
  bool set_current = false;
  bool clear_wp_list = false;
};

/// Request of rosplane_msgs/srv/AddWaypoint. Its response, success and message, is that of the host to every
/// request.
struct RosplaneAddWaypoint {
  static constexpr const char* ros_type = "rosplane_msgs/srv/AddWaypoint_Request";
  std::array<float, 3> w{};
  bool lla = false;
  float chi_d = 0;
  bool use_chi = false;
  float va_d = 0;
  bool set_current = false;
  bool publish_now = false;
};

struct RosflightCommand {
  static constexpr const char* ros_type = "rosflight_msgs/msg/Command";
  RosHeader header;
  std::uint8_t mode = 0;  ///< 0: pass through
  std::uint16_t ignore = 0;
  std::array<float, 10> u{};  ///< 0 throttle, 3 aileron, 4 elevator, 5 rudder
};

struct RosflightStatus {
  static constexpr const char* ros_type = "rosflight_msgs/msg/Status";
  RosHeader header;
  bool armed = false, failsafe = false;
  std::uint16_t rc_override = 0;
  bool offboard = false;
  std::uint8_t control_mode = 0, error_code = 0;
  std::int16_t num_errors = 0, loop_time_us = 0;
};

struct RosflightGnss {
  static constexpr const char* ros_type = "rosflight_msgs/msg/GNSS";
  RosHeader header;
  std::uint8_t fix_type = 0, num_sat = 0;
  double lat = 0, lon = 0;
  float alt = 0;  ///< above mean sea level
  float horizontal_accuracy = 0, vertical_accuracy = 0;
  float vel_n = 0, vel_e = 0, vel_d = 0, speed_accuracy = 0;
  std::int64_t gnss_unix_seconds = 0;
  std::int32_t gnss_unix_nanos = 0;
};

struct RosflightBarometer {
  static constexpr const char* ros_type = "rosflight_msgs/msg/Barometer";
  RosHeader header;
  float altitude = 0, pressure = 0, temperature = 0;  ///< m in the standard atmosphere, Pa, K
};

struct RosflightAirspeed {
  static constexpr const char* ros_type = "rosflight_msgs/msg/Airspeed";
  RosHeader header;
  float velocity = 0, differential_pressure = 0, temperature = 0;  ///< m/s indicated, Pa, K
};

struct RosflightAttitude {
  static constexpr const char* ros_type = "rosflight_msgs/msg/Attitude";
  RosHeader header;
  RosQuaternion attitude;  ///< body to NED
  RosVector3 angular_velocity;
};

struct RosflightRcRaw {
  static constexpr const char* ros_type = "rosflight_msgs/msg/RCRaw";
  RosHeader header;
  std::array<std::uint16_t, 8> values{};  ///< us
};

struct RosflightBatteryStatus {
  static constexpr const char* ros_type = "rosflight_msgs/msg/BatteryStatus";
  RosHeader header;
  float voltage = 0, current = 0;
};

}  // namespace fulmar::ros_bridge
