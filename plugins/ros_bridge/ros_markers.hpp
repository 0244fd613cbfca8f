// SPDX-License-Identifier: BSD-3-Clause
// Markers of a scene: visualization_msgs of ROS 2 (Jazzy), field for field. Lists and texts have room for a
// scene of this plugin; in the transmitted message they are unbounded.
#pragma once
#include "ros_messages.hpp"

namespace fulmar::ros_bridge {

struct RosDuration {
  static constexpr const char* ros_type = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

struct RosColor {
  static constexpr const char* ros_type = "std_msgs/msg/ColorRGBA";
  float r = 0, g = 0, b = 0, a = 0;
};

struct RosCompressedImage {
  static constexpr const char* ros_type = "sensor_msgs/msg/CompressedImage";
  RosHeader header;
  Text<4> format;
  List<std::uint8_t, 1> data;
};

struct RosUvCoordinate {
  static constexpr const char* ros_type = "visualization_msgs/msg/UVCoordinate";
  float u = 0, v = 0;
};

struct RosMeshFile {
  static constexpr const char* ros_type = "visualization_msgs/msg/MeshFile";
  Text<4> filename;
  List<std::uint8_t, 1> data;
};

/// Values of `type` and `action` in use, from the comments of the message.
namespace marker {
inline constexpr std::int32_t sphere_list = 7, text_facing_viewer = 9, triangle_list = 11;
inline constexpr std::int32_t add = 0, delete_all = 3;
}  // namespace marker

struct RosMarker {
  static constexpr const char* ros_type = "visualization_msgs/msg/Marker";
  RosHeader header;
  Text<16> ns;
  std::int32_t id = 0;  ///< with `ns` the identity of the marker: a new one replaces the old one
  std::int32_t type = 0;
  std::int32_t action = marker::add;
  RosPose pose;
  RosVector3 scale{1, 1, 1};  ///< m
  RosColor color;
  RosDuration lifetime;       ///< zero: until it is replaced
  bool frame_locked = false;  ///< moves with its frame instead of the frame's pose at the stamp
  List<RosPoint, 128> points;
  List<RosColor, 1> colors;
  Text<4> texture_resource;
  RosCompressedImage texture;
  List<RosUvCoordinate, 1> uv_coordinates;
  Text<16> text;
  Text<4> mesh_resource;
  RosMeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
};

struct RosMarkerArray {
  static constexpr const char* ros_type = "visualization_msgs/msg/MarkerArray";
  List<RosMarker, 48> markers;
};

/// A `nav_msgs/Path` with room for a whole plan.
struct RosRoute {
  static constexpr const char* ros_type = "nav_msgs/msg/Path";
  RosHeader header;
  List<RosPoseStamped, 2048> poses;
};

}  // namespace fulmar::ros_bridge
