// SPDX-License-Identifier: BSD-3-Clause
// Message definitions read back: those of Fulmar, and those published by ROS 2.
#include "tools/log_reading/ros_parse.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/test/refusal.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"
#include "tools/log_reading/cdr_values.hpp"

namespace ros_parse_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("a definition of ours comes back with the same fields, units, frames and labels") {
  const TypePtr type = parse_ros_definition("fulmar_msgs/msg/Mixed", ros_definition(*mixed_type()));
  CHECK(type->name == "Mixed");
  CHECK(type->ros.empty());
  REQUIRE(type->fields.size() == 13);
  CHECK(type->find("speed_mps")->unit == "m/s");
  CHECK(type->find("mode")->labels == std::vector<std::string>{"idle", "hold", "2d_fix"});
  CHECK(type->find("attitude_std_rad")->unit == "rad");
  CHECK(type->find("attitude_std_rad")->type->frame == "ned");
  const Type& leg = *type->find("legs")->type;
  CHECK(leg.find("kind")->labels == std::vector<std::string>{"line", "orbit"});
  CHECK(leg.find("position_m")->unit == "m");
  CHECK(ros_definition(*type) == ros_definition(*mixed_type()));
  CHECK(ros_type_hash(*type) == ros_type_hash(*mixed_type()));
}

TEST_CASE("bytes that were encoded from the struct decode with the type that was read from the text") {
  const Mixed value = mixed_value();
  std::vector<std::byte> bytes;
  CdrEncoder(*mixed_type()).encode(bytes_of(value), bytes);
  const TypePtr type = parse_ros_definition("fulmar_msgs/Mixed", ros_definition(*mixed_type()));
  std::vector<std::byte> message(type->size);
  cdr_decode(*type, bytes.data(), bytes.size(), message.data());
  CHECK(to_json(*type, message.data(), false) == nlohmann::json::parse(R"({
    "armed": true, "speed_mps": 1.5, "count": 7, "gains_ratio": [1, 2, -2], "name": "ab", "samples_volt": [0.5, 1], "mode": "hold",
    "stamp_ns": -2, "load_ratio": 0.25, "offset": -3, "attitude_std_rad": {"north": 0.5, "east": 1, "down": 2}, "tags": ["x", "yzw"],
    "legs": [{"kind": "orbit", "has_course": true, "course_rad": 0.5, "position_m": {"north": 3, "east": 4, "down": 5}},
             {"kind": "line", "has_course": false, "course_rad": -0.5, "position_m": {"north": 6, "east": 7, "down": 8}}]})"));
}

TEST_CASE(
    "bytes are listed value by value with the type that was read from the text, however long their lists") {
  std::vector<std::byte> bytes;
  CdrEncoder(*mixed_type()).encode(bytes_of(mixed_value()), bytes);
  const TypePtr type = parse_ros_schema("fulmar_msgs/msg/Mixed", ros_definition(*mixed_type()));
  std::vector<std::string> listed;
  for (const CdrValue& v : cdr_values(*type, bytes, 100)) listed.push_back(v.name + "=" + v.text);
  CHECK(listed == std::vector<std::string>{"armed=1",
                                           "speed_mps=1.5",
                                           "count=7",
                                           "gains_ratio[0]=1",
                                           "gains_ratio[1]=2",
                                           "gains_ratio[2]=-2",
                                           "name=ab",
                                           "samples_volt[0]=0.5",
                                           "samples_volt[1]=1",
                                           "mode=hold",
                                           "stamp_ns=-2",
                                           "load_ratio=0.25",
                                           "offset=-3",
                                           "attitude_std_rad.north=0.5",
                                           "attitude_std_rad.east=1",
                                           "attitude_std_rad.down=2",
                                           "tags[0]=x",
                                           "tags[1]=yzw",
                                           "legs[0].kind=orbit",
                                           "legs[0].has_course=1",
                                           "legs[0].course_rad=0.5",
                                           "legs[0].position_m.north=3",
                                           "legs[0].position_m.east=4",
                                           "legs[0].position_m.down=5",
                                           "legs[1].kind=line",
                                           "legs[1].has_course=0",
                                           "legs[1].course_rad=-0.5",
                                           "legs[1].position_m.north=6",
                                           "legs[1].position_m.east=7",
                                           "legs[1].position_m.down=8"});
  CHECK_THROWS_AS(cdr_values(*type, bytes, 10), Error);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    CHECK_THROWS_AS(cdr_values(*type, std::span(bytes).first(n), 100), Error);
  std::vector<std::byte> many{std::byte{0},  std::byte{1}, std::byte{0}, std::byte{0},
                              std::byte{44}, std::byte{1}, std::byte{0}, std::byte{0}};
  many.resize(8 + 300);
  CHECK(cdr_values(*parse_ros_schema("a/msg/B", "uint8[] x\n"), many, 1000).size() == 300);
}

// geometry_msgs/msg/PoseStamped as ROS 2 ships it, comments and all; its hash is the published one.
TEST_CASE("a definition of ROS 2 itself is read: comments, short names, nested packages") {
  const std::string rule = std::string(80, '=') + "\n";
  const std::string text =
      "# A Pose with reference coordinate frame and timestamp\n\nstd_msgs/Header header\nPose pose\n" + rule +
      "MSG: std_msgs/Header\n# Two-integer timestamp\nbuiltin_interfaces/Time stamp\n\n# Transform "
      "frame\nstring frame_id\n" +
      rule + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + rule +
      "MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n" + rule +
      "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + rule +
      "MSG: geometry_msgs/Quaternion\r\nfloat64 x 0\r\nfloat64 y 0\r\nfloat64 z 0\r\nfloat64 w 1\r\n";
  const TypePtr type = parse_ros_definition("geometry_msgs/msg/PoseStamped", text);
  CHECK(ros_type_hash(*type) == "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
  CHECK(resolve_field(*type, "pose.orientation.w").unit == "");
}

TEST_CASE("constants that do not count from 0 make no labels, bounds of text and lists are kept") {
  const TypePtr type = parse_ros_definition(
      "a/msg/B",
      "uint8 LOW=1\nuint8 HIGH = 2\nuint8 level\nstring NAME=\"x=y\"\nstring<=7 name\nint32[] all\n");
  CHECK(type->ros == "a/msg/B");
  REQUIRE(type->fields.size() == 3);
  CHECK(type->fields[0].kind == FULMAR_U8);
  CHECK(type->fields[0].labels.empty());
  CHECK(type->fields[1].stride == 8);
  CHECK(type->fields[2].shape == FULMAR_LIST);
  CHECK(type->fields[2].count == 256);
}

TEST_CASE("a schema tells what has no bound, and every whole number that constants name") {
  const TypePtr type = parse_ros_schema("a/msg/B",
                                        "int8 FIX_NONE=-1\nint8 FIX_3D = 2 # metres\nfloat32 "
                                        "FIX_X=1.5\nint8[<=4] fix\nstring[] words\nstring<=7 name\n");
  REQUIRE(type->fields.size() == 3);
  const Field &fix = type->fields[0], &words = type->fields[1], &name = type->fields[2];
  CHECK(fix.constants == std::vector<std::pair<std::int64_t, std::string>>{{-1, "none"}, {2, "3d"}});
  CHECK(fix.labels.empty());
  CHECK(fix.count == 4);
  CHECK(words.shape == FULMAR_LIST);
  CHECK(words.count == 0);
  CHECK(words.stride == 0);
  CHECK(name.stride == 8);
  // far too large for a struct, but not for a reader of one value after the other
  CHECK(parse_ros_schema("a/msg/B", "float64[4000000000] y\n")->fields[0].count == 4'000'000'000u);
}

TEST_CASE("a bare Header is the package's own, where it has one, else that of std_msgs") {
  const std::string rule = std::string(80, '=') + "\n",
                    theirs = rule + "MSG: std_msgs/Header\nstring frame_id\n";
  CHECK(parse_ros_definition("a/msg/B", "Header h\n" + theirs)->find("h")->type->ros ==
        "std_msgs/msg/Header");
  const std::string own = theirs + rule + "MSG: a/Header\nint32 x\n";
  CHECK(parse_ros_definition("a/msg/B", "Header h\n" + own)->find("h")->type->ros == "a/msg/Header");
}

TEST_CASE("a definition that cannot be read is refused with the line that is wrong") {
  const auto refused = [](const std::string& text) {
    return refusal([&] { parse_ros_definition("a/msg/B", text); });
  };
  CHECK(refused("complex64 x\n") ==
        "a/msg/B: reading.line_fault(complex64 x, reading.field_type_unknown(complex64,  [] bool, byte, "
        "char, float32, float64, int16, int32, int64, int8, string, uint16, uint32, uint64, uint8))");
  CHECK(refused("float64\n") == "a/msg/B: reading.line_fault(float64, reading.field_incomplete)");
  CHECK(refused("float64[x] y\n") ==
        "a/msg/B: reading.line_fault(float64[x] y, reading.list_length_invalid)");
  CHECK(refused("float64[0] y\n") ==
        "a/msg/B: reading.line_fault(float64[0] y, reading.list_length_invalid)");
  CHECK(refused("float64[4000000000] y\n") == "reading.type_too_large(a/msg/B, y, 32000000000, 67108864)");
  CHECK(refused(std::string("bool ") + std::string(300, 'x')).ends_with(", reading.field_name_too_long)"));
  std::string many;
  for (int i = 0; i < 20'001; ++i) many += "bool x" + std::to_string(i) + "\n";
  CHECK(refused(many) == "a/msg/B: reading.line_fault(bool x20000, reading.too_many_fields)");
  std::string chain = "C10 x\nC20 y\n";  // the second is too deep because of the first
  for (int i = 1; i <= 20; ++i)
    chain += "====\nMSG: a/C" + std::to_string(i) + "\n" + (i == 1 ? "bool" : "C" + std::to_string(i - 1)) +
             " x\n";
  CHECK(refused(chain) == "reading.type_nesting_invalid(a/msg/C10)");
  CHECK(refused("B b\n") == "reading.type_nesting_invalid(a/msg/B)");
  CHECK(refusal([] { parse_ros_definition("B", ""); }) == "reading.type_name_invalid(B)");
  CHECK(parse_ros_definition("a/msg/Empty", "")->size == 1);
}

}  // namespace ros_parse_test
