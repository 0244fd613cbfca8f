// SPDX-License-Identifier: BSD-3-Clause
// The foreign messages are those of ROS: the type hashes are the ones that ROS 2 Jazzy publishes, the texts
// have the fields of the packages.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/loader/table.hpp"
#include "core/log/events.hpp"
#include "core/types/wire.hpp"
#include "fulmar/schema.hpp"
#include "plugins/ros_bridge/ros_markers.hpp"
#include "plugins/ros_bridge/rosplane_messages.hpp"

namespace messages_test {

using namespace fulmar;
using namespace fulmar::ros_bridge;

namespace {

template <class T>
std::string hash() {
  return core::ros_type_hash(*core::copy_type(describe<T>()));
}
template <class T>
std::string text() {
  return core::ros_message_text(*core::copy_type(describe<T>()));
}

}  // namespace

TEST_CASE("standard messages have the type hashes of ROS 2") {
  CHECK(hash<RosTime>() == "RIHS01_b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197");
  CHECK(hash<RosTwist>() == "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
  CHECK(hash<RosImu>() == "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
  CHECK(hash<RosOdometry>() == "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  CHECK(hash<RosFluidPressure>() ==
        "RIHS01_22dfb2b145a0bd5a31a1ac3882a1b32148b51d9b2f3bab250290d66f3595bc32");
  CHECK(hash<RosNavSatStatus>() == "RIHS01_d1ed3befa628e09571bd273b888ba1c1fd187c9a5e0006b385d7e5e9095a3204");
}

TEST_CASE("markers, and the lines of a log, have the type hashes of ROS 2") {
  CHECK(hash<RosMarker>() == "RIHS01_45b13ccf791f225962bf74e746f9644518855d783a6f42ba0cc14fde2b4f3ce0");
  CHECK(hash<RosDuration>() == "RIHS01_e8d009f659816f758b75334ee1a9ca5b5c0b859843261f14c7f937349599d93b");
  CHECK(core::ros_type_hash(*core::host_type<core::LogLine>()) ==
        "RIHS01_e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac");
}

TEST_CASE("sequences of foreign messages have no bound") {
  CHECK(hash<RosTf>() == "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  CHECK(hash<RosPath>() == "RIHS01_1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b");
  CHECK(hash<RosRoute>() == hash<RosPath>());  // as much as there is room for, the type is the same
  CHECK(text<RosPath>() == "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n");
}

TEST_CASE("small whole numbers keep their size on the wire") {
  CHECK(text<RosplaneCurrentPath>() ==
        "std_msgs/Header header\nuint8 path_type\nfloat32 va_d\nfloat32[3] r\nfloat32[3] q\nfloat32[3] "
        "c\nfloat32 rho\nint8 lamda\n");
  CHECK(text<RosflightStatus>() ==
        "std_msgs/Header header\nbool armed\nbool failsafe\nuint16 rc_override\nbool offboard\nuint8 "
        "control_mode\nuint8 error_code\n"
        "int16 num_errors\nint16 loop_time_us\n");
  const core::CdrEncoder encoder(*core::copy_type(describe<RosNavSatStatus>()));
  std::vector<std::byte> bytes;
  const RosNavSatStatus status{-1, 0x0203};
  encoder.encode(reinterpret_cast<const std::byte*>(&status), bytes);
  REQUIRE(bytes.size() == 8);  // four of encapsulation; int8, a gap of one, uint16
  CHECK(bytes[4] == std::byte{0xff});
  CHECK(bytes[6] == std::byte{3});
  CHECK(bytes[7] == std::byte{2});
}

TEST_CASE("small whole numbers come back from the wire, and are shown with their sign") {
  const auto type = core::copy_type(describe<RosflightStatus>());
  RosflightStatus status;
  status.rc_override = 0xfffe;
  status.num_errors = -3;
  status.loop_time_us = 32767;
  std::vector<std::byte> bytes;
  core::CdrEncoder(*type).encode(reinterpret_cast<const std::byte*>(&status), bytes);
  RosflightStatus back;
  core::cdr_decode(*type, bytes.data(), bytes.size(), reinterpret_cast<std::byte*>(&back));
  CHECK(back.rc_override == 0xfffe);
  CHECK(back.num_errors == -3);
  const nlohmann::json shown = core::to_json(*type, reinterpret_cast<const std::byte*>(&back), false);
  CHECK(shown["rc_override"] == 65534);
  CHECK(shown["num_errors"] == -3);
  CHECK(shown["loop_time_us"] == 32767);
  const auto field = core::resolve_field(*type, "num_errors");
  CHECK(core::number_at(*field.field, reinterpret_cast<const std::byte*>(&back) + field.offset) == -3);
  CHECK(core::Guard(*type).check(reinterpret_cast<const std::byte*>(&back)));
}

}  // namespace messages_test
