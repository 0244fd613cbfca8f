// SPDX-License-Identifier: BSD-3-Clause
// Definitions of ROS 2 messages, ours and others', and their bytes as cells.
#include "tools/fulmar_log/export_schema.hpp"

#include <doctest/doctest.h>

#include <map>

#include "core/error.hpp"
#include "core/log/test/log_kit.hpp"

namespace export_schema_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::vector<std::byte> bytes(const std::vector<int>& numbers) {
  std::vector<std::byte> list;
  for (const int n : numbers) list.push_back(static_cast<std::byte>(n));
  return list;
}

/// name -> text of one message.
std::map<std::string, std::string> cells(RosField root, const std::vector<std::byte>& message) {
  measure(root, message);
  const std::vector<Column> columns = lay_out(root, 1000);
  std::vector<Cell> row;
  decode(root, message, row);
  REQUIRE(row.size() == columns.size());
  std::map<std::string, std::string> map;
  for (std::size_t i = 0; i < row.size(); ++i) map[columns[i].name] = cell_text(row[i]);
  return map;
}

}  // namespace

TEST_CASE("our own definitions are read back: every kind, shape and nested field") {
  std::vector<std::byte> message;
  const Mixed value = mixed_value();
  CdrEncoder(*mixed_type()).encode(bytes_of(value), message);
  const auto found = cells(parse_ros2msg("fulmar_msgs/msg/Mixed", ros_definition(*mixed_type())), message);
  CHECK(found.at("armed") == "1");
  CHECK(found.at("speed_mps") == "1.5");
  CHECK(found.at("gains_ratio[2]") == "-2");
  CHECK(found.at("name") == "ab");
  CHECK(found.at("samples_volt[0]") == "0.5");
  CHECK(found.at("mode") == "1");
  CHECK(found.at("stamp_ns") == "-2");
  CHECK(found.at("load_ratio") == "0.25");
  CHECK(found.at("offset") == "-3");
  CHECK(found.at("attitude_std_rad.down") == "2");
  CHECK(found.at("tags[1]") == "yzw");
  CHECK(found.at("legs[1].position_m.east") == "7");
  CHECK(found.count("legs[2].kind") == 0);
}

TEST_CASE("a definition of others: header, constants, small integers, defaults, lists without bound") {
  const std::string text =
      "# a comment\n"
      "std_msgs/Header header\n"
      "int8 STATUS_NO_FIX = -1 # none\n"
      "int8 STATUS_FIX=0\n"
      "int8 status -1\n"
      "string WORD=\"a=b\"\n"
      "uint16[] data\n"
      "geometry_msgs/Point[2] corners\n"
      "string<=10[<=3] names\n"
      "================================================================================\n"
      "MSG: std_msgs/Header\n"
      "builtin_interfaces/Time stamp\n"
      "string frame_id\n"
      "================================================================================\n"
      "MSG: builtin_interfaces/Time\n"
      "int32 sec\n"
      "uint32 nanosec\n"
      "================================================================================\n"
      "MSG: geometry_msgs/Point\n"
      "float32 x\n";
  // sec 1, nanosec 2, "m"; status -1; [258]; x 0.5, x 1.0; ["q"]
  const auto message = bytes({0, 1, 0, 0, 1, 0, 0, 0, 2,  0, 0, 0,   2,  0, 0, 0, 'm', 0, 255, 0, 1, 0,   0,
                              0, 2, 1, 0, 0, 0, 0, 0, 63, 0, 0, 128, 63, 1, 0, 0, 0,   2, 0,   0, 0, 'q', 0});
  RosField root = parse_ros2msg("sensor_msgs/msg/Odd", text);
  const auto found = cells(root, message);
  CHECK(found.at("header.stamp.sec") == "1");
  CHECK(found.at("header.stamp.nanosec") == "2");
  CHECK(found.at("header.frame_id") == "m");
  CHECK(found.at("status") == "-1");
  CHECK(found.at("data[0]") == "258");
  CHECK(found.at("corners[0].x") == "0.5");
  CHECK(found.at("corners[1].x") == "1");
  CHECK(found.at("names[0]") == "q");
  REQUIRE(root.fields[1].name == "status");
  CHECK(root.fields[1].labels ==
        std::vector<std::pair<std::int64_t, std::string>>{{-1, "no_fix"}, {0, "fix"}});
  CHECK(root.fields[2].labels.empty());
}

TEST_CASE("what is no definition is refused, naming the field; what holds itself, too") {
  CHECK_THROWS_WITH_AS(
      parse_ros2msg("a/msg/B", "wstring name\n"),
      doctest::Contains(
          "a/msg/B: reading.line_fault(wstring name, reading.field_type_unknown(wstring,  [string] "),
      Error);
  CHECK_THROWS_WITH_AS(parse_ros2msg("a/msg/B", "B b\n"),
                       doctest::Contains("reading.type_nesting_invalid(a/msg/B)"), Error);
  CHECK_THROWS_AS(parse_ros2msg("a/msg/B", "int32[0] b\n"), Error);
  CHECK_THROWS_AS(parse_ros2msg("a/msg/B", "int32[x b\n"), Error);
  CHECK_THROWS_AS(parse_ros2msg("a/msg/B", "int32\n"), Error);
}

TEST_CASE("a message that is shorter, longer or of another encapsulation than its definition is refused") {
  RosField root = parse_ros2msg("a/msg/B", "uint32 x\n");
  CHECK_NOTHROW(measure(root, bytes({0, 1, 0, 0, 9, 0, 0, 0})));
  CHECK_THROWS_WITH_AS(measure(root, bytes({0, 1, 0, 0, 9, 0, 0})),
                       doctest::Contains("types.message_truncated(7, 8)"), Error);
  CHECK_THROWS_WITH_AS(measure(root, bytes({0, 1, 0, 0, 9, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8})),
                       doctest::Contains("types.message_too_long(16, 8)"), Error);
  CHECK_THROWS_WITH_AS(measure(root, bytes({0, 0, 0, 0, 9, 0, 0, 0})),
                       doctest::Contains("types.encapsulation_invalid(0)"), Error);
  RosField list = parse_ros2msg("a/msg/B", "float64[] x\n");
  CHECK_THROWS_AS(measure(list, bytes({0, 1, 0, 0, 255, 255, 255, 255})), Error);
}

}  // namespace export_schema_test
