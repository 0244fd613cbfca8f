// SPDX-License-Identifier: BSD-3-Clause
// The link's thread: it keeps the connection, shares the line with the loop, and ends.
#include <doctest/doctest.h>
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <csignal>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#define FULMAR_COUNT_ALLOCATIONS
#include "fulmar/testing.hpp"
#include "scripted_controller.hpp"

namespace link_thread_test {

using namespace fulmar::fcu;
using namespace fulmar::fcu::testing;

TEST_CASE("unplugged and plugged in elsewhere: told both, nothing is sent meanwhile, and it is no reboot") {
  Controller c;
  LinkOptions options = options_of(c);
  options.watched = {"RC_X_CHN"};
  Link link(options);
  c.clock_ns = [&] { return link.now_ns() + 100 * second; };
  c.answer_parameter("RC_X_CHN", 0);
  REQUIRE(c.listen_until([&] { return link.state().synchronised; }));
  for (int i = 0; i < 50; ++i) {
    c.send_imu(static_cast<std::uint64_t>(c.clock_ns() / 1000));
    c.listen(2);
  }

  const std::string before = c.pty.device();
  c.pty.pull();
  REQUIRE(pop_until(link, c, event_is(LinkEvent::disconnected)));
  CHECK_FALSE(link.state().open);
  CHECK(link.descriptor() == -1);
  CHECK_FALSE(link.send(OffboardControl{}));
  CHECK_FALSE(link.wait_imu(link.now_ns() + 10 * ms));

  // So that the device gets another number: the lowest that is free is given next, and others come and go.
  const auto number = [](const std::string& device) {
    return std::stoi(device.substr(device.rfind('/') + 1));
  };
  std::deque<Pty> in_the_way;
  do in_the_way.emplace_back();
  while (number(in_the_way.back().device()) < number(before));
  c.pty.plug();
  CHECK(c.pty.device() != before);
  c.heard.clear();
  c.parser.restart();
  const std::int64_t back = monotonic_ns();
  REQUIRE(pop_until(link, c, event_is(LinkEvent::connected)));
  c.send_imu(static_cast<std::uint64_t>(c.clock_ns() / 1000));
  REQUIRE(pop_until(
      link, c, [](const Received& r) { return r.event == LinkEvent::packet && r.packet.is<SmallImu>(); }));
  MESSAGE("packets flow again " << (monotonic_ns() - back) / ms << " ms after the device is back");
  CHECK(monotonic_ns() - back < 20 * second);
  CHECK(link.send(OffboardControl{}));
  REQUIRE(c.listen_until([&] {
    return !c.asked_for().empty() && !c.heard[Heartbeat::id].empty() && !c.heard[OffboardControl::id].empty();
  }));
  for (int i = 0; i < 200; ++i) {
    c.send_imu(static_cast<std::uint64_t>(c.clock_ns() / 1000));
    c.listen(2);
  }
  const LinkState s = link.state();
  CHECK(s.connections == 2);
  CHECK(s.reboots == 0);
}

TEST_CASE("a loop that does not look loses the newest packets, counted, and no event") {
  Controller c;
  Link link(options_of(c));
  std::uint64_t sent = 0;
  while (sent < 6000) {
    if (c.send_imu(1000 + 2500 * sent))
      ++sent;
    else
      usleep(500);  // the line is full
  }
  REQUIRE(c.listen_until([&] { return link.state().frames == sent; }));
  c.pty.pull();
  REQUIRE(c.listen_until([&] { return !link.state().open; }));
  std::uint64_t got = 0;
  bool in_order = true;
  const bool reported = pop_until(link, c, [&](const Received& r) {
    if (r.event != LinkEvent::packet) return r.event == LinkEvent::disconnected;
    in_order = in_order && r.packet.as<SmallImu>().time_boot_us == 1000 + 2500 * got;
    ++got;
    return false;
  });
  CHECK(reported);
  CHECK(in_order);
  CHECK(got >= 4000);
  CHECK(link.state().lost_in_queue == sent - got);
  CHECK_FALSE(link.wait_imu(0));
}

TEST_CASE("frames of the loop and of the link's thread go out whole and in order, whoever writes when") {
  constexpr std::size_t commands = 30'000;
  Controller c;
  LinkOptions options = options_of(c);
  options.time_scale =
      1000;  // its own thread asks for the time whenever it is awake, and each sample wakes it
  Link link(options);
  std::atomic<std::size_t> arrived{0};
  std::thread loop([&] {
    OffboardControl command;
    for (std::size_t i = 0; i < commands; ++i) {
      while (i > arrived + 8)
        sched_yield();  // there is room on the line and in the queue for the other thread
      command.u[0] = static_cast<float>(i);
      if (!link.send(command)) break;
    }
  });
  for (std::size_t before = commands; arrived != before;) {  // a time-out for threads that make progress
    before = arrived;
    c.listen_until([&] {
      c.send_imu(1000);
      arrived = c.heard[OffboardControl::id].size();
      return arrived == commands;
    });
  }
  arrived = commands;
  loop.join();
  const std::vector<Packet>& got = c.heard[OffboardControl::id];
  REQUIRE(got.size() == commands);
  bool in_order = true;
  for (std::size_t i = 0; i < commands; ++i)
    in_order = in_order && got[i].as<OffboardControl>().u[0] == static_cast<float>(i);
  CHECK(in_order);
  CHECK(c.heard[Timesync::id].size() > 100);
  CHECK(c.parser.counts().bad == 0);
  CHECK(c.parser.counts().skipped == 0);
}

TEST_CASE("what the loop calls allocates nothing, with and without a device") {
  Controller c;
  Link link(options_of(c));
  const auto tick = [&] {
    link.wait_imu(link.now_ns() + 2 * ms);
    for (Received r; link.pop(r);) continue;
    link.send(OffboardControl{});
    static_cast<void>(link.state());
  };
  for (int i = 0; i < 10; ++i) c.send_imu(1000);
  std::uint64_t count = fulmar::allocations([&] {
    for (int i = 0; i < 20; ++i) tick();
  });
  CHECK(count == 0);
  c.pty.pull();
  count = fulmar::allocations([&] {
    for (int i = 0; i < 20; ++i) tick();
  });
  CHECK(count == 0);
}

namespace {

/// The link's thread, by its name: its number and the signals that it blocks.
std::pair<pid_t, std::uint64_t> link_thread() {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream status(entry.path() / "status");
    std::string name, line;
    std::uint64_t blocked = 0;
    while (std::getline(status, line)) {
      if (line.starts_with("Name:")) name = line.substr(line.find_first_not_of(" \t", 5));
      if (line.starts_with("SigBlk:")) blocked = std::stoull(line.substr(7), nullptr, 16);
    }
    if (name == "fulmar-fcu") return {std::stoi(entry.path().filename().string()), blocked};
  }
  return {-1, 0};
}

}  // namespace

TEST_CASE("the link's thread has a name, takes no signals, and is gone with the link") {
  Controller c;
  {
    const Link link(options_of(c));
    const auto [id, blocked] = link_thread();
    REQUIRE(id > 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) CHECK(((blocked >> (signal - 1)) & 1) == 1);
    sigset_t own;
    pthread_sigmask(SIG_BLOCK, nullptr, &own);
    CHECK(sigismember(&own, SIGINT) == 0);
  }
  CHECK(link_thread().first == -1);
  // With the device away it ends as soon.
  auto link = std::make_unique<Link>(options_of(c));
  c.pty.pull();
  REQUIRE(c.listen_until([&] { return !link->state().open; }));
  const std::int64_t from = monotonic_ns();
  link.reset();
  CHECK(monotonic_ns() - from < 2 * second);
}

TEST_CASE("the link's thread gets the priority of the loop that waits for it") {
  Controller c;
  Link link(options_of(c));
  const pid_t id = link_thread().first;
  CHECK(sched_getscheduler(id) == SCHED_OTHER);
  bool permitted = false;
  std::thread loop([&] {
    const sched_param wanted{3};
    permitted = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) == 0;
    // The link's thread may be about to begin.
    for (int i = 0; i < 200 && permitted && sched_getscheduler(id) == SCHED_OTHER; ++i)
      link.wait_imu(link.now_ns() + 10 * ms);
  });
  loop.join();
  if (!permitted) {
    MESSAGE("skipped: no real-time priority here");
    return;
  }
  sched_param got{};
  sched_getparam(id, &got);
  CHECK((sched_getscheduler(id) & ~SCHED_RESET_ON_FORK) == SCHED_FIFO);
  CHECK(got.sched_priority == 3);
}

}  // namespace link_thread_test
