// SPDX-License-Identifier: BSD-3-Clause
// Requests of ROS 2 to the bridge's node: services, parameters, the graph; and the sockets of the bridge.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/types/ros_service.hpp"
#include "links/dds/test/scene.hpp"

namespace services_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// Addresses of this process's UDP sockets, in the form of the kernel.
std::set<std::string> udp_addresses() {
  std::set<std::string> inodes, addresses;
  for (const auto& fd : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    const std::string target = std::filesystem::read_symlink(fd, gone).string();
    if (target.rfind("socket:[", 0) == 0) inodes.insert(target.substr(8, target.size() - 9));
  }
  for (const char* file : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream table(file);
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) {
      std::istringstream words(line);
      std::string slot, local, remote;
      words >> slot >> local >> remote;
      std::string inode;
      for (int i = 0; i < 7; ++i) words >> inode;
      if (!inodes.contains(inode)) continue;
      addresses.insert(local.substr(0, local.find(':')));
    }
  }
  return addresses;
}
/// Members on this computer of the DDS discovery group, 239.255.0.1.
int multicast_members() {
  std::ifstream table("/proc/net/igmp");
  std::string word;
  int members = 0;
  while (table >> word)
    if (word == "0100FFEF") table >> members;
  return members;
}

}  // namespace

TEST_CASE(
    "a request port is a ROS 2 service: accepted, refused with the component's reason, or refused by its "
    "ranges") {
  Scene scene;
  scene.open();
  Leg leg{};
  leg.kind = 1;
  leg.has_course = true;
  leg.course_rad = 0.5;
  leg.position_m = {3, 4, 5};
  std::vector<std::byte> bytes;
  CdrEncoder(*leg_type()).encode(bytes_of(leg), bytes);
  auto call = [&] {
    Program client(peer("call", "follow/edit fulmar_msgs/Leg " + hex(bytes)));
    return client.rest();
  };
  CHECK(call() == "010000000100000000000000\n");  // true, an empty text, up to 4 bytes
  REQUIRE(scene.control.requested().size() == 1);
  CHECK(std::memcmp(scene.control.requested()[0].data() + offsetof(Leg, position_m), &leg.position_m,
                    sizeof leg.position_m) == 0);
  scene.control.refuse_requests("no");
  CHECK(call() == "00000000030000006e6f0000\n");
  bytes[4] = std::byte{7};                              // an invalid label
  CHECK(call().find("6b696e64") != std::string::npos);  // "kind ..."
  CHECK(scene.control.requested().size() == 2);
  CHECK(scene.bridge->stats().requests == 3);
}

TEST_CASE("the text of a service has the request's fields and the response's") {
  CHECK(srv_text(*leg_type()) == ros_message_text(*leg_type()) + "---\nbool accepted\nstring reason\n");
  CHECK(srv_name(*leg_type()) == "fulmar_msgs/srv/Leg");
  CHECK(srv_name(*make_type("Add", 1, 1, {}, "", "rosplane_msgs/srv/AddWaypoint_Request")) ==
        "rosplane_msgs/srv/AddWaypoint");
  CHECK(ros_name(*srv_response(*leg_type())) == "fulmar_msgs/srv/Leg_Response");
}

TEST_CASE("parameters belong to one ROS 2 node: listed, read, described, set, rejected with the reason") {
  Scene scene;
  scene.open();
  auto param = [&](const std::string& arguments) {
    Program client(peer("param", "fulmar " + arguments));
    return client.rest();
  };
  CHECK(param("list") == "slc.law\nslc.roll_kp\nslc.span_m\n");
  CHECK(param("get slc.roll_kp slc.law nobody.x") ==
        "type 3 0 0 0.55000000000000004 '' []\ntype 4 0 0 0 'level' []\ntype 0 0 0 0 '' []\n");
  const std::string described =
      "slc.roll_kp type 3 'aileron per roll error [rad/rad]' '' read_only 0 0 to 2 step 0\n"
      "slc.span_m type 3 'aileron per roll error [rad/rad]' '' read_only 1 0 to 2 step 0\n"
      "slc.law type 4 '' 'one of takeoff, level' read_only 0\n";
  CHECK(param("describe slc.roll_kp slc.span_m slc.law") == described);
  CHECK(param("set slc.roll_kp 0.6") == "set\n");
  CHECK(param("get slc.roll_kp") == "type 3 0 0 0.59999999999999998 '' []\n");
  CHECK(param("set_text slc.law takeoff") == "set\n");
  CHECK(join(scene.control.parameters_set()) == "slc.roll_kp=0.6, slc.law=\"takeoff\"");
  CHECK(param("set slc.roll_k 1 slc.span_m 3") ==
        "refused: dds.parameter_unknown(slc.roll_k,  [slc.roll_kp] slc.law, slc.roll_kp, "
        "slc.span_m)\nrefused: mock.parameter_fixed(slc.span_m)\n");
  CHECK(param("set_many slc.roll_kp 1 slc.law 0") == "refused: dds.several_parameters\n");
}

TEST_CASE("a change of a parameter is published on /parameter_events") {
  Scene scene;
  scene.open();
  Program events(peer("read", "rt/parameter_events rcl_interfaces::msg::dds_::ParameterEvent_ 1"));
  std::atomic<bool> received{false};
  std::thread changes([&] {
    for (int i = 0; !received && i < 400; ++i) {
      scene.control.set_parameter("slc", "roll_kp", "0.7", [](const std::string&) {});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  const std::string bytes = events.rest();
  received = true;
  changes.join();
  CHECK(bytes.find("2f66756c6d6172") != std::string::npos);          // "/fulmar"
  CHECK(bytes.find("736c632e726f6c6c5f6b70") != std::string::npos);  // "slc.roll_kp"
  CHECK(bytes.find("666666666666e63f") != std::string::npos);        // 0.7
}

TEST_CASE("the node is described for ROS 2 tools, its ids 16 bytes long, 24 for Humble") {
  std::map<bool, std::size_t> sizes;
  for (const bool humble : {false, true}) {
    Scene scene;
    scene.options.humble = humble;
    scene.options.parameters = false;
    scene.open();
    Program reader(
        peer("read", "ros_discovery_info rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ 1 transient"));
    const std::string bytes = reader.rest();
    REQUIRE(bytes.size() > 100);
    // encapsulation, participant, one node: "/" and "fulmar"
    CHECK(bytes.substr(2 * (humble ? 28 : 20), 2 * 24 - 2) ==
          "01000000"
          "02000000"
          "2f000000"
          "07000000"
          "66756c6d617200");
    sizes[humble] = bytes.size() / 2;
  }
  // participant; readers: leader, edit; writers: nav.state, edit's reply
  CHECK(sizes[true] == sizes[false] + 5 * 8);
}

TEST_CASE("every socket of the bridge is bound to the loopback address, and none joins a multicast group") {
  const std::set<std::string> before = udp_addresses();
  const int members = multicast_members();
  Scene scene;
  scene.open();
  scene.fly();
  Program reader(peer("read", "rt/nav/state " + mixed_dds + " 20"));
  reader.rest();
  const std::set<std::string> during = udp_addresses();
  CHECK(before.empty());
  CHECK(during == std::set<std::string>{"0100007F"});
  CHECK(multicast_members() == members);
  CHECK(reader.finish() == 0);
}

TEST_CASE("an invalid address, a foreign address, and a domain that does not exist are rejected") {
  Scene scene;
  scene.options.interfaces = {"192.0.2.1"};  // of RFC 5737: for documentation
  scene.options.interfaces_where = {"m.yaml", 4};
  CHECK_THROWS_WITH_AS(
      scene.open(), doctest::Contains("dds.interface_unknown(m.yaml:4: , 192.0.2.1, 127.0.0.1, 192.0.2.2)"),
      Error);
  scene.options.interfaces = {"loopback"};
  CHECK_THROWS_WITH_AS(scene.open(), "dds.address_invalid(loopback)", Error);
  scene.options.interfaces.clear();
  scene.options.domain = 233;
  CHECK_THROWS_WITH_AS(scene.open(), "dds.domain_out_of_range(233, 232)", Error);
}

}  // namespace services_test
