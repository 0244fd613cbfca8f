// SPDX-License-Identifier: BSD-3-Clause
// Topics of the bridge, against other programs: one that behaves like rmw_fastrtps, and one with another
// vendor's DDS. Processes find each other by unicast on the loopback address, each test in a separate domain.
#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "links/dds/test/scene.hpp"

namespace topics_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

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

}  // namespace

TEST_CASE("another vendor's DDS reads an exported port, each value exact" * doctest::skip(!has_cyclone())) {
  Scene scene;
  scene.open();
  scene.fly(std::chrono::milliseconds(
      10));  // the writer keeps 10: a reader that a busy machine delays by 100 ms still gets all
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
      CHECK(speed == previous + 1);  // before that, discovery is not complete, and the writer keeps 10
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
  scene.options.exports[0].topic = "nav/state";  // with a leading '/' it would be absolute
  scene.open();
  Tap::Cursor other(scene.tap);
  other.want(0, 0);  // another sink requests every sample
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
  CHECK(scene.bridge->stats().sent == 0);  // there was no reader when they were written
  if (has_cyclone()) {
    Program other(cyclone("read_late", "rt/nav/state 1"));
    CHECK(other.rest().rfind("1 3 7 ", 0) == 0);
    CHECK(other.finish() == 0);
  }
  Program usual(peer("read", "rt/nav/state " + mixed_dds + " 1"));
  std::atomic<bool> arrived{false};
  std::thread writer([&] {
    for (std::int64_t now_ns = 120'000'000'000; !arrived; now_ns += 2'000'000'000) {
      m.speed_mps += 1;
      scene.tap.write(0, now_ns, now_ns, bytes_of(m), false);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  const std::string fresh = usual.rest();
  arrived = true;
  writer.join();
  CHECK(usual.finish() == 0);
  CHECK(fresh != hex(cdr(mixed_value())) + "\n");
  CHECK(fresh.size() == 2 * cdr(m).size() + 1);
}

TEST_CASE("an export of an unknown port is rejected, with the choices") {
  Scene scene;
  scene.options.exports[0].port = "nav.stat";
  scene.options.exports[0].where = {"m.yaml", 7};
  CHECK_THROWS_WITH_AS(
      scene.open(),
      doctest::Contains("m.yaml:7: dds.exported_port_unknown(nav.stat,  [/nav/state] /nav/state)"), Error);
}

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

TEST_CASE("a best-effort writer reaches an imported port, and a sample of a reliable one arrives once") {
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

TEST_CASE("a flood of 20000 samples per second is cut, counted, and the loop's ring continues") {
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

TEST_CASE("endpoints that do not match by the rules of DDS are reported once, in a sentence") {
  std::ostringstream printed;
  const auto usual = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(printed)));
  spdlog::set_pattern("%v");
  Scene scene;
  scene.options.exports[0].best_effort = true;
  scene.open();
  const auto reported = [&](const std::string& text) {
    return printed.str().find(text) != std::string::npos;
  };
  {
    Program strict("timeout 3 " + peer("read", "rt/nav/state " + mixed_dds + " 1"));
    Program other("timeout 3 " +
                  peer("publish", "rt/leader/state geometry_msgs::msg::dds_::Pose_ reliable 100 00010000"));
  }
  spdlog::set_default_logger(usual);
  scene.bridge.reset();
  CHECK(reported("dds.peer_reliability_differs(rt/nav/state)"));
  CHECK(
      reported("dds.peer_type_differs(writes, rt/leader/state, geometry_msgs::msg::dds_::Pose_, "
               "fulmar_msgs::msg::dds_::Mixed_)"));
}

}  // namespace topics_test
