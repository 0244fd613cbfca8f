// SPDX-License-Identifier: BSD-3-Clause
// The bridge against other programs: one that speaks as rmw_fastrtps does, and one of another vendor's DDS.
// Processes find each other by unicast on the loopback address, each test in a domain of its own.
#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "core/dds/bridge.hpp"
#include "core/dds/test/domain.hpp"
#include "core/dds/test/mock_control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/ros_service.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

const std::string bin = FULMAR_BIN_DIR;
const std::string limit = "timeout 300 ";  // a peer that hangs is a failure, not the end of the whole check
const std::string mixed_dds = "fulmar_msgs::msg::dds_::Mixed_";

/// Output of a program that runs beside the test.
class Program {
 public:
  explicit Program(const std::string& command)
      : pipe_(popen((command + " 2>/tmp/fulmar_dds_peer_" + std::to_string(getpid())).c_str(), "r")) {}
  ~Program() {
    if (pipe_ != nullptr) finish();
  }
  std::string rest() {
    std::string text;
    char line[4096];
    while (std::fgets(line, sizeof line, pipe_) != nullptr) text += line;
    return text;
  }
  int finish() {
    rest();
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    std::filesystem::remove("/tmp/fulmar_dds_peer_" + std::to_string(getpid()));
    return WEXITSTATUS(status);
  }

 private:
  FILE* pipe_;
};

std::string peer(const std::string& what, const std::string& arguments) {
  return limit + bin + "/dds_peer " + what + " " + std::to_string(own_domain()) + " " + arguments;
}
std::string cyclone(const std::string& what, const std::string& arguments) {
  return "CYCLONEDDS_URI='<General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"false\"/></Interfaces><AllowMulticast>false"
         "</AllowMulticast></General><Discovery><ParticipantIndex>auto</"
         "ParticipantIndex><MaxAutoParticipantIndex>30</"
         "MaxAutoParticipantIndex>"
         "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>' " +
         limit + bin + "/dds_cyclone " + what + " " + std::to_string(own_domain()) + " " + arguments;
}
bool has_cyclone() { return std::filesystem::exists(bin + "/dds_cyclone"); }

std::string hex(const std::vector<std::byte>& bytes) {
  std::string text;
  for (const std::byte b : bytes) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", std::to_integer<unsigned>(b));
    text += two;
  }
  return text;
}
std::vector<std::byte> cdr(const Mixed& m) {
  std::vector<std::byte> bytes;
  CdrEncoder(*mixed_type()).encode(bytes_of(m), bytes);
  return bytes;
}

template <class F>
bool soon(F&& f) {
  for (int i = 0; i < 2000; ++i) {
    if (f()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

ParameterView number_param(const std::string& name, double value, bool live) {
  ParameterView p;
  p.info.name = name;
  p.info.unit = "rad/rad";
  p.info.doc = "aileron per roll error";
  p.info.kind = FULMAR_NUMBER;
  p.info.live = live;
  p.info.min = 0;
  p.info.max = 2;
  p.base.number[0] = value;
  return p;
}

/// A flight with one output, one import, one request and some parameters.
struct Scene {
  Tap tap;
  MockControl control;
  DdsOptions options;
  std::unique_ptr<DdsBridge> bridge;
  std::atomic<bool> stop{false};
  std::thread loop;

  explicit Scene(bool may_stay_silent = false)
      : tap(std::vector<TapChannel>{TapChannel{"/nav/state", mixed_type(), may_stay_silent}}) {
    ComponentView follow, slc;
    follow.name = "follow";
    follow.inputs = {{"leader", mixed_type(), "", -1, false, true},
                     {"edit", leg_type(), "", -1, true, false}};
    slc.name = "slc";
    slc.params = {number_param("roll_kp", 0.55, true), number_param("span_m", 2, false)};
    ParameterView law;
    law.info.name = "law", law.info.kind = FULMAR_CHOICE, law.info.choices = {"takeoff", "level"},
    law.info.live = true;
    law.base.integer = 1;
    slc.params.push_back(law);
    control.flight.components = {follow, slc};
    options.on = true;
    options.domain = own_domain();
    DdsOptions::Export state;
    state.port = "nav.state";
    state.topic = "/nav/state";
    options.exports = {state};
    DdsOptions::Import leader;
    leader.component = 0, leader.input = 0;
    leader.topic = "/leader/state";
    options.imports = {leader};
  }
  ~Scene() {
    stop = true;
    if (loop.joinable()) loop.join();
    bridge.reset();
  }
  void open() { bridge = std::make_unique<DdsBridge>(tap, control, options); }

  /// The loop: message i at 2.5 ms * i of flight, speed_mps 1000 + i.
  void fly(std::chrono::microseconds pace = std::chrono::microseconds(2500)) {
    loop = std::thread([this, pace] {
      Mixed m = mixed_value();
      for (std::int64_t i = 0; !stop; ++i) {
        const std::int64_t now_ns = i * 2'500'000;
        m.speed_mps = 1000 + static_cast<double>(i);
        if (tap.wanted(0, now_ns)) tap.write(0, now_ns, now_ns, bytes_of(m), false);
        std::this_thread::sleep_for(pace);
      }
    });
  }
  std::size_t published() const {
    const std::lock_guard lock(control.mutex);
    return control.published.size();
  }
  Mixed last() const {
    const std::lock_guard lock(control.mutex);
    Mixed m;
    std::memcpy(&m, control.published.back().data(), sizeof m);
    return m;
  }
};

/// Addresses that the UDP sockets of this process are bound to, as the kernel prints them.
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
/// Members of the group that DDS discovers with, 239.255.0.1, on this computer.
int multicast_members() {
  std::ifstream table("/proc/net/igmp");
  std::string word;
  int members = 0;
  while (table >> word)
    if (word == "0100FFEF") table >> members;
  return members;
}

}  // namespace

// ---- out

TEST_CASE("another vendor's DDS reads an exported port, each value exact" * doctest::skip(!has_cyclone())) {
  Scene scene;
  scene.open();
  scene.fly(std::chrono::milliseconds(
      10));  // the writer keeps 10: a reader that a busy machine holds up for 100 ms still gets all
  Program reader(cyclone("read", "rt/nav/state 60"));
  std::istringstream lines(reader.rest());
  CHECK(reader.finish() == 0);
  double previous = -1;
  int n = 0;
  for (std::string line; std::getline(lines, line); ++n) {
    double speed = 0;
    REQUIRE(std::sscanf(line.c_str(), "1 %lf", &speed) == 1);
    CHECK(speed >= 1000);
    CAPTURE(n);
    if (n >= 20)
      CHECK(speed == previous + 1);  // before, the two are still finding each other, and the writer keeps 10
    previous = speed;
    char expected[512];
    std::snprintf(expected, sizeof expected,
                  "1 %.17g 7 [1 2 -2] 'ab' [0.5 1 ] 1 -2 0.25 -3 (0.5 1 2) 'x' 'yzw' {1 1 0.5 (3 4 5)} {0 0 "
                  "-0.5 (6 7 8)}",
                  speed);
    CHECK(line == expected);
  }
  CHECK(n == 60);
  CHECK(scene.bridge->stats().sent >= 60);
}

TEST_CASE("an export with a period is thinned by flight time, under the vehicle's name space") {
  Scene scene;
  scene.options.name_space = "uav1";
  scene.options.exports[0].period_ns = 20'000'000;
  scene.options.exports[0].topic = "nav/state";  // with a '/' before it it would stand as it is
  scene.open();
  Tap::Cursor other(scene.tap);
  other.want(0, 0);  // somebody else wants every sample
  scene.fly();
  Program reader(peer("read", "rt/uav1/nav/state " + mixed_dds + " 5"));
  std::istringstream lines(reader.rest());
  CHECK(reader.finish() == 0);
  std::vector<double> speeds;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < line.size(); i += 2)
      bytes.push_back(static_cast<std::byte>(std::stoi(line.substr(i, 2), nullptr, 16)));
    Mixed m;
    cdr_decode(*mixed_type(), bytes.data(), bytes.size(), bytes_of(m));
    speeds.push_back(m.speed_mps);
  }
  REQUIRE(speeds.size() == 5);
  for (std::size_t i = 1; i < 5; ++i) CHECK(speeds[i] == speeds[i - 1] + 8);  // 8 ticks of 2.5 ms
}

TEST_CASE(
    "who comes late gets the last sample of a port that may stay silent; a reader that wants no old ones "
    "meets it, too") {
  Scene scene(true);
  scene.open();
  Mixed m = mixed_value();
  for (int i = 1; i <= 3; ++i) {  // two at once, one a minute later: the last plan
    const std::int64_t now_ns = i < 3 ? i * 2'500'000 : 60'000'000'000;
    m.speed_mps = i;
    REQUIRE(scene.tap.wanted(0, now_ns));
    scene.tap.write(0, now_ns, now_ns, bytes_of(m), false);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  Program late(peer("read", "rt/nav/state " + mixed_dds + " 1 transient"));
  CHECK(late.rest() == hex(cdr(m)) + "\n");
  CHECK(late.finish() == 0);
  CHECK(scene.bridge->stats().sent == 0);  // nobody was there when they were written
  if (has_cyclone()) {
    Program other(cyclone("read_late", "rt/nav/state 1"));
    CHECK(other.rest().rfind("1 3 7 ", 0) == 0);
    CHECK(other.finish() == 0);
  }
  Program usual(peer("read", "rt/nav/state " + mixed_dds + " 1"));
  std::atomic<bool> heard{false};
  std::thread writer([&] {
    for (std::int64_t now_ns = 120'000'000'000; !heard; now_ns += 2'000'000'000) {
      m.speed_mps += 1;
      scene.tap.write(0, now_ns, now_ns, bytes_of(m), false);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  const std::string fresh = usual.rest();
  heard = true;
  writer.join();
  CHECK(usual.finish() == 0);
  CHECK(fresh != hex(cdr(mixed_value())) + "\n");
  CHECK(fresh.size() == 2 * cdr(m).size() + 1);
}

TEST_CASE("an export of a port that is not there is refused, with the choices") {
  Scene scene;
  scene.options.exports[0].port = "nav.stat";
  scene.options.exports[0].where = {"m.yaml", 7};
  CHECK_THROWS_WITH_AS(
      scene.open(),
      doctest::Contains("m.yaml:7: dds.export: there is no 'nav.stat' to export. Did you mean '/nav/state'?"),
      Error);
}

// ---- in

TEST_CASE("another vendor's DDS publishes into an imported port: the loop gets the exact struct" *
          doctest::skip(!has_cyclone())) {
  Scene scene;
  scene.open();
  Program writer(cyclone("write", "rt/leader/state 3"));
  CHECK(soon([&] { return scene.published() == 3; }));
  CHECK(writer.finish() == 0);
  Mixed expected = mixed_value();
  expected.speed_mps = 3.5;
  expected.legs.count = 1;
  CHECK(cdr(scene.last()) == cdr(expected));
  const DdsStats stats = scene.bridge->stats();
  CHECK(stats.received == 3);
  CHECK(stats.refused == 0);
  REQUIRE(stats.imports.size() == 1);
  CHECK(stats.imports[0].port == "follow.leader");
  CHECK(stats.imports[0].topic == "/leader/state");
  MESSAGE("latency " << stats.imports[0].latency_mean_s * 1e3 << " ms, at most "
                     << stats.imports[0].latency_max_s * 1e3 << " ms");
  CHECK(stats.imports[0].latency_mean_s > 0);
  CHECK(stats.imports[0].latency_max_s >= stats.imports[0].latency_mean_s);
  CHECK(stats.imports[0].latency_max_s < 10);
}

TEST_CASE(
    "samples of another layout, cut off, or with values that the input does not allow are refused and "
    "counted") {
  Scene scene;
  scene.open();
  Mixed good = mixed_value(), bad_label = good, infinite = good;
  bad_label.mode = 9;
  infinite.speed_mps = std::numeric_limits<double>::infinity();
  const std::string text = hex(cdr(good));
  std::string many = text;
  many.replace(2 * (4 + 56), 8, "ffffffff");  // the length of a list
  const std::string list = text.substr(0, 60) + " " + hex(cdr(bad_label)) + " " + hex(cdr(infinite)) + " " +
                           many + " 00010000 0001 00000000" + " " + text + "0000000000 " + text;
  Program writer(peer("publish", "rt/leader/state " + mixed_dds + " reliable 200 " + list));
  CHECK(soon([&] { return scene.published() == 1; }));
  CHECK(writer.finish() == 0);
  CHECK(scene.bridge->stats().received == 1);
  CHECK(scene.bridge->stats().refused == 8);
  CHECK(cdr(scene.last()) == cdr(good));
}

TEST_CASE("2000 samples with random bytes in them do no harm") {
  Scene scene;
  scene.open();
  const std::string good = hex(cdr(mixed_value())),
                    file = "/tmp/fulmar_dds_samples_" + std::to_string(getpid());
  {
    std::ofstream list(file);
    std::uint32_t x = 12345;
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = good;
      for (int k = 0; k < 4; ++k) {
        x = x * 1664525 + 1013904223;
        bytes[8 + (x >> 8) % (bytes.size() - 8)] = "0123456789abcdef"[x >> 28];
      }
      list << bytes << "\n";
    }
  }
  Program writer(peer("publish", "rt/leader/state " + mixed_dds + " reliable 2000 @" + file));
  CHECK(soon([&] {
    const DdsStats s = scene.bridge->stats();
    return s.received + s.refused + s.lost >= 2000;
  }));
  CHECK(writer.finish() == 0);
  std::filesystem::remove(file);
  CHECK(scene.bridge->stats().received > 0);
  CHECK(scene.bridge->stats().refused > 0);
}

TEST_CASE("a writer with best effort reaches an imported port, and a reliable one beside it is heard once") {
  Scene scene;
  scene.open();
  const std::string good = hex(cdr(mixed_value()));
  {
    Program loose(peer("publish", "rt/leader/state " + mixed_dds + " best_effort 100 " + good + "*20"));
    CHECK(soon([&] { return scene.published() >= 15; }));
    CHECK(loose.finish() == 0);
  }
  const std::size_t before = scene.published();
  Program strict(peer("publish", "rt/leader/state " + mixed_dds + " reliable 100 " + good + "*20"));
  CHECK(soon([&] { return scene.published() >= before + 20; }));
  CHECK(strict.finish() == 0);
  CHECK(scene.published() == before + 20);
}

TEST_CASE("a flood of 20000 samples per second is cut, counted, and the loop's ring goes on") {
  Scene scene;
  scene.open();
  scene.fly();
  Program reader(peer("read", "rt/nav/state " + mixed_dds + " 400"));
  Program flood(peer(
      "publish", "rt/leader/state " + mixed_dds + " reliable 20000 " + hex(cdr(mixed_value())) + "*40000"));
  CHECK(reader.rest().size() > 400);
  CHECK(reader.finish() == 0);
  CHECK(flood.finish() == 0);
  CHECK(soon([&] {
    const DdsStats s = scene.bridge->stats();
    return s.received > 0 && s.lost > 0;
  }));
  const DdsStats stats = scene.bridge->stats();
  MESSAGE("received " << stats.received << ", lost " << stats.lost << ", sent meanwhile " << stats.sent);
  CHECK(stats.received + stats.lost <= 40'000);
  CHECK(stats.refused == 0);
}

TEST_CASE("what does not meet by the rules of DDS is told once, in a sentence") {
  std::ostringstream said;
  const auto usual = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(said)));
  spdlog::set_pattern("%v");
  Scene scene;
  scene.options.exports[0].best_effort = true;
  scene.open();
  const auto told = [&](const std::string& text) { return said.str().find(text) != std::string::npos; };
  {
    Program strict("timeout 3 " + peer("read", "rt/nav/state " + mixed_dds + " 1"));
    Program other("timeout 3 " +
                  peer("publish", "rt/leader/state geometry_msgs::msg::dds_::Pose_ reliable 100 00010000"));
  }
  spdlog::set_default_logger(usual);
  scene.bridge.reset();
  CHECK(told(
      "dds: somebody reads rt/nav/state reliably, but it is exported with best_effort: the two do not meet"));
  CHECK(
      told("dds: somebody writes rt/leader/state with the type geometry_msgs::msg::dds_::Pose_; here it is "
           "fulmar_msgs::msg::dds_::Mixed_: the two do not meet"));
}

// ---- services

TEST_CASE(
    "a request port is a ROS 2 service: accepted, refused with the component's reason, or refused by its "
    "ranges") {
  Scene scene;
  scene.open();
  Leg leg{};
  leg.kind = 1, leg.has_course = true, leg.course_rad = 0.5, leg.position_m = {3, 4, 5};
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
  bytes[4] = std::byte{7};                              // a label that is not there
  CHECK(call().find("6b696e64") != std::string::npos);  // "kind ..."
  CHECK(scene.control.requested().size() == 2);
  CHECK(scene.bridge->stats().requests == 3);
}

TEST_CASE("the text of a service has the request's fields, and what comes back") {
  CHECK(srv_text(*leg_type()) == ros_message_text(*leg_type()) + "---\nbool accepted\nstring reason\n");
  CHECK(srv_name(*leg_type()) == "fulmar_msgs/srv/Leg");
  CHECK(srv_name(*make_type("Add", 1, 1, {}, "", "rosplane_msgs/srv/AddWaypoint_Request")) ==
        "rosplane_msgs/srv/AddWaypoint");
  CHECK(ros_name(*srv_response(*leg_type())) == "fulmar_msgs/srv/Leg_Response");
}

TEST_CASE("parameters are those of one ROS 2 node: listed, read, described, set, refused with the reason") {
  Scene scene;
  scene.open();
  auto param = [&](const std::string& arguments) {
    Program client(peer("param", "fulmar " + arguments));
    return client.rest();
  };
  CHECK(param("list") == "slc.law\nslc.roll_kp\nslc.span_m\n");
  CHECK(param("get slc.roll_kp slc.law nobody.x") ==
        "type 3 0 0 0.55000000000000004 '' []\ntype 4 0 0 0 'level' []\ntype 0 0 0 0 '' []\n");
  CHECK(param("describe slc.roll_kp slc.span_m slc.law") ==
        "slc.roll_kp type 3 'aileron per roll error [rad/rad]' '' read_only 0 0 to 2 step 0\n"
        "slc.span_m type 3 'aileron per roll error [rad/rad]' '' read_only 1 0 to 2 step 0\n"
        "slc.law type 4 '' 'one of takeoff, level' read_only 0\n");
  CHECK(param("set slc.roll_kp 0.6") == "set\n");
  CHECK(param("get slc.roll_kp") == "type 3 0 0 0.59999999999999998 '' []\n");
  CHECK(param("set_text slc.law takeoff") == "set\n");
  CHECK(join(scene.control.parameters_set()) == "slc.roll_kp=0.6, slc.law=\"takeoff\"");
  CHECK(param("set slc.roll_k 1 slc.span_m 3") ==
        "refused: there is no parameter 'slc.roll_k'. Did you mean 'slc.roll_kp'? Valid: slc.law, "
        "slc.roll_kp, slc.span_m.\n"
        "refused: slc.span_m is set before the flight\n");
  CHECK(param("set_many slc.roll_kp 1 slc.law 0").rfind("refused: several parameters", 0) == 0);
}

TEST_CASE("a change of a parameter is told on /parameter_events") {
  Scene scene;
  scene.open();
  Program events(peer("read", "rt/parameter_events rcl_interfaces::msg::dds_::ParameterEvent_ 1"));
  std::atomic<bool> heard{false};
  std::thread changes([&] {
    for (int i = 0; !heard && i < 400; ++i) {
      scene.control.set_parameter("slc", "roll_kp", "0.7", [](const std::string&) {});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  const std::string bytes = events.rest();
  heard = true;
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

// ---- network

TEST_CASE("every socket of the bridge is bound to the loopback address, and nobody joins a multicast group") {
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

TEST_CASE("an address that is none, or not this computer's, and a domain that does not exist are refused") {
  Scene scene;
  scene.options.interfaces = {"192.0.2.1"};  // of RFC 5737: nobody's
  scene.options.interfaces_where = {"m.yaml", 4};
  CHECK_THROWS_WITH_AS(
      scene.open(), doctest::Contains("m.yaml:4: dds.interfaces: 192.0.2.1 is no address of this computer"),
      Error);
  scene.options.interfaces = {"loopback"};
  CHECK_THROWS_WITH_AS(scene.open(), "dds: 'loopback' is not an IPv4 address such as 127.0.0.1", Error);
  scene.options.interfaces.clear();
  scene.options.domain = 233;
  CHECK_THROWS_WITH_AS(scene.open(), "dds: domain 233 is outside 0 .. 232", Error);
}
