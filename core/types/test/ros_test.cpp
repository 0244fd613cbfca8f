// SPDX-License-Identifier: BSD-3-Clause
// Message text exactly; type hashes against the published ones of ROS 2 interfaces.
#include <doctest/doctest.h>

#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

namespace ros_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("a Fulmar type is in the package fulmar_msgs, a foreign one keeps its name") {
  CHECK(ros_name(*mixed_type()) == "fulmar_msgs/msg/Mixed");
  CHECK(ros_name(*make_type("Imu", 8, 8, {}, "", "sensor_msgs/msg/Imu")) == "sensor_msgs/msg/Imu");
  CHECK(ros_name(*make_type("Imu", 8, 8, {}, "", "sensor_msgs/Imu")) == "sensor_msgs/msg/Imu");
}

TEST_CASE("the message text names every field with its unit and frame, and nested types follow once each") {
  const std::string rule(80, '=');
  const std::string definition =
      "bool armed\n"
      "float64 speed_mps  # m/s\n"
      "uint32 count\n"
      "float64[3] gains_ratio\n"
      "string name\n"
      "float64[<=4] samples_volt  # V\n"
      "uint8 MODE_IDLE=0\n"
      "uint8 MODE_HOLD=1\n"
      "uint8 MODE_2D_FIX=2\n"
      "uint8 mode\n"
      "int64 stamp_ns  # ns\n"
      "float32 load_ratio\n"
      "int32 offset\n"
      "fulmar_msgs/Vec3Ned attitude_std_rad  # rad, ned\n"
      "string[2] tags\n"
      "fulmar_msgs/Leg[<=3] legs\n" +
      rule + "\nMSG: fulmar_msgs/Vec3Ned\nfloat64 north\nfloat64 east\nfloat64 down\n" + rule +
      "\nMSG: fulmar_msgs/Leg\nuint8 LINE=0\nuint8 ORBIT=1\nuint8 kind\nbool has_course\nfloat64 "
      "course_rad  # rad\n"
      "fulmar_msgs/Vec3Ned position_m  # m, ned\n";
  CHECK(ros_definition(*mixed_type()) == definition);
}

TEST_CASE("constants of several enums in one message have the name of their field") {
  const TypePtr type =
      make_type("T", 2, 1, {label("roll_law", {"none", "hold"}, 0), label("pitch_law", {"none"}, 1)});
  CHECK(ros_message_text(*type) ==
        "uint8 ROLL_LAW_NONE=0\nuint8 ROLL_LAW_HOLD=1\nuint8 roll_law\nuint8 PITCH_LAW_NONE=0\nuint8 "
        "pitch_law\n");
}

namespace {

TypePtr ros_type(const std::string& name, std::vector<Field> fields) {
  return make_type(name, 8, 8, std::move(fields), "", name);
}
Field text(const std::string& name) { return scalar(name, FULMAR_TEXT, 0, 32); }

TypePtr header() {
  const TypePtr time = ros_type("builtin_interfaces/msg/Time",
                                {scalar("sec", FULMAR_I32, 0, 4), scalar("nanosec", FULMAR_U32, 4, 4)});
  return ros_type("std_msgs/msg/Header", {nested("stamp", time, 0), text("frame_id")});
}
TypePtr vector3() {
  return ros_type("geometry_msgs/msg/Vector3", {number("x", 0), number("y", 0), number("z", 0)});
}
TypePtr quaternion() {
  return ros_type("geometry_msgs/msg/Quaternion",
                  {number("x", 0), number("y", 0), number("z", 0), number("w", 0)});
}

}  // namespace

TEST_CASE("type hashes equal those that ROS 2 has published for its own messages") {
  CHECK(ros_type_hash(*ros_type("std_msgs/msg/String", {text("data")})) ==
        "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  CHECK(ros_type_hash(*vector3()) ==
        "RIHS01_cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d");
  CHECK(ros_type_hash(*header()) ==
        "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
  const TypePtr imu = ros_type(
      "sensor_msgs/msg/Imu",
      {nested("header", header(), 0), nested("orientation", quaternion(), 0),
       array(number("orientation_covariance", 0), 9), nested("angular_velocity", vector3(), 0),
       array(number("angular_velocity_covariance", 0), 9), nested("linear_acceleration", vector3(), 0),
       array(number("linear_acceleration_covariance", 0), 9)});
  CHECK(ros_type_hash(*imu) == "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
}

TEST_CASE("the message text of a foreign type is that of its own package") {
  CHECK(ros_definition(*header()) == "builtin_interfaces/Time stamp\nstring frame_id\n" +
                                         std::string(80, '=') +
                                         "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

}  // namespace ros_test
