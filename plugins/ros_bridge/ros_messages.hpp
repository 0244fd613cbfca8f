// SPDX-License-Identifier: BSD-3-Clause
// Standard messages of ROS 2 with the names, order and kinds of fields of its packages (common_interfaces,
// geometry2). The C++ names begin with Ros, so that `Imu` in a mission stays Fulmar's. A list is transmitted
// as an unbounded sequence.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar::ros_bridge {

using RosText = Text<64>;

struct RosTime {
  static constexpr const char* ros_type = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

struct RosHeader {
  static constexpr const char* ros_type = "std_msgs/msg/Header";
  RosTime stamp;
  RosText frame_id;
};

struct RosVector3 {
  static constexpr const char* ros_type = "geometry_msgs/msg/Vector3";
  double x = 0, y = 0, z = 0;
};

struct RosPoint {
  static constexpr const char* ros_type = "geometry_msgs/msg/Point";
  double x = 0, y = 0, z = 0;
};

struct RosQuaternion {
  static constexpr const char* ros_type = "geometry_msgs/msg/Quaternion";
  double x = 0, y = 0, z = 0, w = 1;
};

struct RosPose {
  static constexpr const char* ros_type = "geometry_msgs/msg/Pose";
  RosPoint position;
  RosQuaternion orientation;
};

struct RosPoseStamped {
  static constexpr const char* ros_type = "geometry_msgs/msg/PoseStamped";
  RosHeader header;
  RosPose pose;
};

struct RosPoseWithCovariance {
  static constexpr const char* ros_type = "geometry_msgs/msg/PoseWithCovariance";
  RosPose pose;
  std::array<double, 36> covariance{};  ///< by rows: x, y, z, rotation about x, y, z
};

struct RosTwist {
  static constexpr const char* ros_type = "geometry_msgs/msg/Twist";
  RosVector3 linear;
  RosVector3 angular;
};

struct RosTwistStamped {
  static constexpr const char* ros_type = "geometry_msgs/msg/TwistStamped";
  RosHeader header;
  RosTwist twist;
};

struct RosTwistWithCovariance {
  static constexpr const char* ros_type = "geometry_msgs/msg/TwistWithCovariance";
  RosTwist twist;
  std::array<double, 36> covariance{};  ///< by rows: x, y, z, rotation about x, y, z
};

struct RosTransform {
  static constexpr const char* ros_type = "geometry_msgs/msg/Transform";
  RosVector3 translation;
  RosQuaternion rotation;
};

struct RosTransformStamped {
  static constexpr const char* ros_type = "geometry_msgs/msg/TransformStamped";
  RosHeader header;
  RosText child_frame_id;
  RosTransform transform;
};

struct RosTf {
  static constexpr const char* ros_type = "tf2_msgs/msg/TFMessage";
  List<RosTransformStamped, 4> transforms;
};

struct RosOdometry {
  static constexpr const char* ros_type = "nav_msgs/msg/Odometry";
  RosHeader header;
  RosText child_frame_id;
  RosPoseWithCovariance pose;
  RosTwistWithCovariance twist;
};

struct RosPath {
  static constexpr const char* ros_type = "nav_msgs/msg/Path";
  RosHeader header;
  List<RosPoseStamped, 256> poses;
};

struct RosImu {
  static constexpr const char* ros_type = "sensor_msgs/msg/Imu";
  RosHeader header;
  RosQuaternion orientation;
  std::array<double, 9> orientation_covariance{};  ///< first element -1: no orientation
  RosVector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  RosVector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};
};

struct RosNavSatStatus {
  static constexpr const char* ros_type = "sensor_msgs/msg/NavSatStatus";
  std::int8_t status = -1;    ///< -1 no fix, 0 fix, 1 satellite-based, 2 ground-based augmentation
  std::uint16_t service = 1;  ///< GPS
};

struct RosNavSatFix {
  static constexpr const char* ros_type = "sensor_msgs/msg/NavSatFix";
  RosHeader header;
  RosNavSatStatus status;
  double latitude = 0;
  double longitude = 0;
  double altitude = 0;                          ///< above the ellipsoid
  std::array<double, 9> position_covariance{};  ///< m2, east, north, up
  std::uint8_t position_covariance_type = 0;    ///< 0 unknown, 2 the diagonal is known
};

struct RosMagneticField {
  static constexpr const char* ros_type = "sensor_msgs/msg/MagneticField";
  RosHeader header;
  RosVector3 magnetic_field;  ///< T
  std::array<double, 9> magnetic_field_covariance{};
};

struct RosFluidPressure {
  static constexpr const char* ros_type = "sensor_msgs/msg/FluidPressure";
  RosHeader header;
  double fluid_pressure = 0;  ///< Pa
  double variance = 0;        ///< 0: unknown
};

}  // namespace fulmar::ros_bridge
