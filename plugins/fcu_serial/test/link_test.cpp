// SPDX-License-Identifier: BSD-3-Clause
// The link against a scripted controller on a pseudo-terminal: packets, times, parameters.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "plugins/fcu_serial/link/port.hpp"
#include "scripted_controller.hpp"

namespace link_test {

using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;

TEST_CASE("a port that cannot be opened is refused when the link is made") {
  LinkOptions options;
  options.port = "/dev/ttyACM_no_such";
  CHECK_THROWS_AS(Link{options}, PortError);
}

TEST_CASE(
    "the controller hears a heartbeat and a question for its time at once, from system 1, component 50") {
  Controller c;
  const Link link(options_of(c));
  REQUIRE(c.listen_until([&] { return !c.heard[Heartbeat::id].empty() && !c.heard[Timesync::id].empty(); }));
  const Packet& beat = c.heard[Heartbeat::id][0];
  CHECK(beat.system == 1);
  CHECK(beat.component == 50);
  CHECK(c.heard[Timesync::id][0].as<Timesync>().tc1 == 0);
  CHECK(c.heard[Timesync::id][0].as<Timesync>().ts1 > 0);
}

TEST_CASE("heartbeats and questions come at 1 and 10 Hz of host time, which may run faster than the wall's") {
  for (const double scale : {1.0, 5.0}) {
    CAPTURE(scale);
    Controller c;
    LinkOptions options = options_of(c);
    options.time_scale = scale;
    const Link link(options);
    REQUIRE(c.listen_until([&] { return c.heard[Heartbeat::id].size() == 3; }));
    // Each of them carries the host's time: no clock of the test is needed. The third heartbeat is due at 2
    // s.
    const std::vector<Packet>& questions = c.heard[Timesync::id];
    CHECK(questions.size() <= 22);
    CHECK(questions.size() >= 10);
    // On a loaded machine one may be late, and the next one in time; none is ahead of its time since the
    // start.
    for (std::size_t i = 1; i < questions.size(); ++i)
      CHECK(questions[i].as<Timesync>().ts1 >= static_cast<std::int64_t>(i) * 100 * ms - 10 * ms);
    CHECK(questions.back().as<Timesync>().ts1 >= 18 * second / 10);
  }
}

TEST_CASE("MAVLink 2 at the other end is counted by the starts of its frames") {
  Controller c;
  const Link link(options_of(c));
  std::array<std::uint8_t, 21> beat{0xfd, 9, 0, 0, 1, 1, 1};  // HEARTBEAT with an empty payload
  for (int i = 0; i < 12; ++i) c.pty.write(beat);
  REQUIRE(c.listen_until([&] { return link.state().bytes == 12 * beat.size(); }));
  CHECK(link.state().modern == 12);
  CHECK(link.state().frames == 0);
}

TEST_CASE("the loop sleeps until an inertial sample or its deadline") {
  Controller c;
  Link link(options_of(c));
  const std::int64_t deadline = link.now_ns() + 20 * ms;
  CHECK_FALSE(link.wait_imu(deadline));
  CHECK(link.now_ns() >= deadline);
  CHECK_FALSE(link.wait_imu(INT64_MIN / 2));  // long over
  c.send(SmallMag{});                         // wakes no thread
  CHECK_FALSE(link.wait_imu(link.now_ns() + 20 * ms));

  std::thread later([&] {
    usleep(20'000);
    c.send_imu(1000);
  });
  const std::int64_t from = link.now_ns();
  CHECK(link.wait_imu(from + patience_ms * ms));
  CHECK(link.now_ns() < from + patience_ms * ms / 2);  // woken, not late
  later.join();
  CHECK(link.wait_imu(0));  // it is still there
  REQUIRE(pop_until(
      link, c, [](const Received& r) { return r.event == LinkEvent::packet && r.packet.is<SmallImu>(); }));
  CHECK_FALSE(link.wait_imu(0));
}

TEST_CASE("a deadline in a hurried host's time is that much nearer") {
  Controller c;
  LinkOptions options = options_of(c);
  options.time_scale = 20;
  Link link(options);
  const std::int64_t wall = monotonic_ns(), host = link.now_ns();
  CHECK_FALSE(link.wait_imu(host + 2 * second));
  const std::int64_t slept = monotonic_ns() - wall;
  CHECK(slept >= 99 * ms);
  CHECK(slept < 2 * second);
  CHECK(link.now_ns() >= host + 2 * second);
}

TEST_CASE("packets come out in order and whole, behind the event of the connection") {
  Controller c;
  Link link(options_of(c));
  for (std::uint64_t i = 1; i <= 500; ++i) REQUIRE(c.listen_until([&] { return c.send_imu(i * 2500); }));
  std::uint64_t next = 2500;
  Received r;
  REQUIRE(pop_until(link, c, [&](const Received& got) {
    r = got;
    return true;
  }));
  CHECK(r.event == LinkEvent::connected);
  std::int64_t arrived = 0, valid = 0;
  REQUIRE(pop_until(link, c, [&](const Received& got) {
    CHECK(got.packet.as<SmallImu>().time_boot_us == next);
    CHECK(got.arrived_ns > arrived);
    CHECK(got.valid_at_ns > valid);
    CHECK(got.valid_at_ns <= got.arrived_ns);
    arrived = got.arrived_ns;
    valid = got.valid_at_ns;
    next += 2500;
    return next > 500 * 2500;
  }));
  const LinkState s = link.state();
  CHECK(s.open);
  CHECK(s.frames == 500);
  CHECK(s.missing == 0);
  CHECK(s.bad == 0);
  CHECK(s.bytes == 500 * 44);
  CHECK(s.connections == 1);
  CHECK(s.heard_ns == arrived);
  CHECK(link.descriptor() >= 0);
}

TEST_CASE(
    "with its questions answered, stamps of the controller become host time to half of the round trip") {
  for (const double scale : {1.0, 4.0}) {
    CAPTURE(scale);
    Controller c;
    LinkOptions options = options_of(c);
    options.time_scale = scale;
    Link link(options);
    c.clock_ns = [&] {
      return link.now_ns() + 5000 * second;
    };                           // started 5000 s ago, runs at the host's pace
    std::int64_t widest_ns = 0;  // round trip: the effect of a slow first answer decreases gradually
    const auto look = [&] { widest_ns = std::max(widest_ns, link.state().round_trip_ns); };
    REQUIRE(c.listen_until([&] {
      look();
      return link.state().synchronised && c.heard[Timesync::id].size() > 5;
    }));
    for (Received r; link.pop(r);) continue;
    std::vector<std::int64_t> sent;
    for (int i = 0; i < 100; ++i) {
      look();
      sent.push_back(link.now_ns());
      c.send_imu(static_cast<std::uint64_t>((sent.back() + 5000 * second) / 1000));
      c.listen(3);
    }
    const LinkState s = link.state();
    CHECK(s.round_trip_ns > 0);
    std::size_t at = 0;
    REQUIRE(pop_until(link, c, [&](const Received& r) {
      if (!r.packet.is<SmallImu>()) return false;
      CHECK(r.valid_at_ns <= r.arrived_ns);
      // An answer's bounds are a round trip apart; a later, quicker one may have narrowed them.
      CHECK(std::llabs(r.valid_at_ns - sent[at]) <= widest_ns + static_cast<std::int64_t>(500e3 * scale));
      return ++at == sent.size();
    }));
    CHECK(s.undated == 0);
  }
}

TEST_CASE("watched parameters are asked for until they have come, ten at a time, and no longer") {
  Controller c;
  LinkOptions options = options_of(c);
  for (int i = 0; i < 12; ++i) options.watched.push_back("PARAMETER_" + std::to_string(i));
  options.watched.push_back("RC_ARM_THRESHOLD");  // 16 characters, no NUL
  Link link(options);
  c.send(Heartbeat{});
  REQUIRE(c.listen_until([&] { return c.asked_for().size() == 10; }));
  CHECK(c.asked_for() == std::vector<std::string>(options.watched.begin(), options.watched.begin() + 10));
  CHECK(c.heard[ParamRequestRead::id][0].as<ParamRequestRead>().param_index == -1);
  // The first answers make room; unanswered requests are repeated.
  c.heard.clear();
  c.answer_parameter("PARAMETER_0", 1);
  c.answer_parameter("PARAMETER_1", 1);
  c.answer_parameter("PARAMETER_2", 1);
  const auto asked = [&](const std::string& name) {
    const std::vector<std::string> all = c.asked_for();
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  REQUIRE(c.listen_until(
      [&] { return asked("RC_ARM_THRESHOLD") && asked("PARAMETER_9") && asked("PARAMETER_11"); }));
  CHECK_FALSE(asked("PARAMETER_1"));
  for (const std::string& name : options.watched) c.answer_parameter(name, 7);
  REQUIRE(pop_until(link, c, [](const Received& r) {
    return r.packet.is<ParamValue>() && text(r.packet.as<ParamValue>().param_id) == "RC_ARM_THRESHOLD" &&
           r.packet.as<ParamValue>().param_value == 7;
  }));
  c.listen(50);
  c.heard.clear();
  REQUIRE(c.listen_until([&] { return c.heard[Timesync::id].size() == 5; }));  // half a second
  CHECK(c.asked_for().empty());
}

TEST_CASE(
    "requests go to the system that the controller says it is, which PARAM_VALUE and texts do not tell") {
  Controller c;
  LinkOptions options = options_of(c);
  options.watched = {"SYS_ID"};
  Link link(options);
  c.pty.write(encode(Heartbeat{}, 0, 7, 250).view());
  c.pty.write(encode(Statustext{}, 1, 99, 250).view());
  REQUIRE(c.listen_until([&] {
    const auto& asked = c.heard[ParamRequestRead::id];
    return !asked.empty() && asked.back().as<ParamRequestRead>().target_system == 7;
  }));
}

TEST_CASE("a controller that starts anew is told once, asked for its parameters and its time again") {
  Controller c;
  LinkOptions options = options_of(c);
  options.watched = {"RC_X_CHN"};
  Link link(options);
  std::int64_t started = -100 * second;
  c.clock_ns = [&] { return link.now_ns() - started; };
  c.answer_parameter("RC_X_CHN", 0);
  REQUIRE(c.listen_until([&] { return link.state().synchronised; }));
  std::int64_t last_valid = 0;
  int reboots = 0;
  bool again = false;
  const auto fly = [&](int samples) {
    for (int i = 0; i < samples; ++i) {
      c.send_imu(static_cast<std::uint64_t>(c.clock_ns() / 1000));
      c.listen(2);
      for (Received r; link.pop(r);) {
        if (r.event == LinkEvent::rebooted) {
          ++reboots;
          again = true;
        }
        if (r.event != LinkEvent::packet || !r.packet.is<SmallImu>()) continue;
        CHECK(r.valid_at_ns > last_valid);
        CHECK(r.valid_at_ns <= r.arrived_ns);
        CHECK(r.arrived_ns - r.valid_at_ns < second);
        last_valid = r.valid_at_ns;
      }
    }
  };
  fly(100);
  CHECK(reboots == 0);
  c.heard.clear();
  started = link.now_ns();
  fly(300);
  CHECK(reboots == 1);
  CHECK(again);
  CHECK(link.state().reboots == 1);
  CHECK(c.asked_for().size() > 0);
  CHECK(c.heard[Heartbeat::id].size() > 0);
  CHECK(link.state().synchronised);
  CHECK(std::llabs(link.state().offset_ns - started) < 100 * ms);
}

TEST_CASE("the link is the same over UDP, whoever of the two is there first") {
  // Two ports that are free now; the host's is bound first.
  std::unique_ptr<Port> device;
  std::unique_ptr<Link> link;
  LinkOptions options;
  for (int port = 20'000 + getpid() % 20'000; link == nullptr; port += 2) {
    const std::string here = std::to_string(port), there = std::to_string(port + 1);
    try {
      options.port = "udp:127.0.0.1:" + there + ":" + here;
      link = std::make_unique<Link>(options);
      device = Port::open("udp:127.0.0.1:" + here + ":" + there);
    } catch (const PortError&) {
      link.reset();
    }
  }
  Parser parser;
  std::array<std::uint8_t, 4096> room;
  int questions = 0;
  Received r;
  SmallImu imu;
  imu.time_boot_us = 4321;
  for (int tries = 0; tries < 100 && questions < 2; ++tries) {
    const std::size_t n = device->read(room, 100);
    parser.feed({room.data(), n}, [&](const Packet& p) { questions += p.is<Timesync>(); });
  }
  CHECK(questions == 2);
  REQUIRE(device->write(encode(imu, 0).view()));
  REQUIRE(link->wait_imu(link->now_ns() + patience_ms * ms));
  REQUIRE(link->pop(r));
  CHECK(r.event == LinkEvent::connected);
  REQUIRE(link->pop(r));
  CHECK(r.packet.as<SmallImu>().time_boot_us == 4321);
}

}  // namespace link_test
