// SPDX-License-Identifier: BSD-3-Clause
// Replays of components in other threads and processes: with the same delays, misses and failures.
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/fulmar_replay/test/replays.hpp"

namespace late_work_test {

using namespace lab;

namespace {

const char* const in_a_child =
    "  one: {fills: law, use: lab/Law, run: process, hang: 200 ms, params: {id: 1, u: 0.1}}\n";

/// Sends a signal to the flight's child when its time has come.
FlightResult fly_and_signal(const Graph& graph, const fs::path& log, int signal) {
  Flight flight(graph, logged(log, 0.5));
  bool sent = false;
  while (flight.step())
    if (!sent && flight.now_ns() >= 100'000'000) {
      const std::string words =
          "pkill -" + std::to_string(signal) + " -P " + std::to_string(getpid()) + " fulmar-child";
      REQUIRE(std::system(words.c_str()) == 0);
      sent = true;
    }
  return flight.finish();
}

}  // namespace

TEST_CASE("late work in other threads is as late again: drivers, asynchronous steps, on hardware") {
  const fs::path log = fresh("threads.mcap"), again = fresh("threads-again.mcap");
  const Graph g = mission(
      "  fcu: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: lab/Law, run: tick, params: {id: 1, "
      "u: 0.1}}\n"
      "  filter: {fills: sense, use: lab/Filter, run: tick}\n"
      "  watch: {use: lab/Watch, run: tick, in: {burst: gauge.reading}}\n"
      "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30, fails: true}}\n"
      "  think: {use: lab/Thinker, run: async, latency: 5 ms, rate: 100 Hz, in: {signal: sense.signal}, "
      "params: {takes: 1 ms}}\n"
      "io: fcu\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  FlightOptions o = logged(log, 1e6);
  Flight flight(g, o);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 400; ++i) {
    flight.step();
    std::this_thread::sleep_until(
        begin + (i + 1) * std::chrono::microseconds(250));  // ten times too fast for the thinker
  }
  // no result is overdue when the log ends: of those it cannot tell
  for (int i = 0; i < 40; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const FlightResult r = flight.finish();
  CHECK(r.log.dropped == 0);
  for (const ComponentStats& c : r.components)
    if (c.name == "think") CHECK(c.misses > 0);
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE(
    "samples of a driver that came in one tick are published one by one again, though its probe stood "
    "still") {
  const fs::path log = fresh("still.mcap"), again = fresh("still-again.mcap");
  const Graph g = mission(
      "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30, counts: false}}\n"
      "  watch: {use: lab/Watch, in: {burst: gauge.reading}}\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  Flight flight(g, logged(log, 1e6));
  for (int i = 0; i < 20; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  flight.finish();
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE(
    "who takes long to take over in another thread, and misses steps meanwhile, misses the same ones again") {
  const fs::path log = fresh("takes-over.mcap"), again = fresh("takes-over-again.mcap");
  const Graph g = mission(
      "  fcu: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: lab/Law, run: tick, params: {id: 1, "
      "u: 0.1}}\n"
      "  filter: {fills: sense, use: lab/Filter, run: tick}\n"
      "  think: {use: lab/Thinker, run: async, latency: 5 ms, rate: 100 Hz, in: {signal: sense.signal},"
      " params: {takes: 0 ms, takes_over: 100 ms}}\n"
      "io: fcu\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  Flight flight(g, logged(log, 1e6));
  for (int i = 0; i < 100; ++i) flight.step();  // faster than it takes over
  for (int i = 0; i < 40; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const FlightResult r = flight.finish();
  CHECK(r.log.dropped == 0);
  for (const ComponentStats& c : r.components)
    if (c.name == "think") CHECK(c.misses > 0);
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE("a child that hung, was stopped or was killed dies in the same tick again, in the same words") {
  struct Row {
    const char* what;
    int signal;
    std::vector<std::pair<std::string, std::string>> set;
    const char* reported;
  };
  for (const Row& row :
       {Row{"hung", 0, {{"one.fault", "hangs"}, {"one.fault_at", "0.1"}}, "isolate.child_hung(200)"},
        Row{"stopped", SIGSTOP, {}, "isolate.child_hung(200)"},
        Row{"killed", SIGKILL, {}, "isolate.child_killed(9)"}}) {
    CAPTURE(row.what);
    const Graph graph = mission(in_a_child + std::string(with_fallback), row.set);
    const fs::path log = fresh("child.mcap"), again = fresh("again.mcap");
    const FlightResult r =
        row.signal == 0 ? Flight(graph, logged(log, 0.5)).run() : fly_and_signal(graph, log, row.signal);
    REQUIRE(r.guards.size() == 1);
    CHECK(r.guards[0].what == std::string(row.reported));
    CHECK(r.guards[0].action == "two takes over");
    const ReplayResult replayed = replay_of(log, {}, again);
    REQUIRE(replayed.flight.guards.size() == 1);
    CHECK(replayed.flight.guards[0].at_ns == r.guards[0].at_ns);
    check_equal(replayed, log, again);
  }
}

TEST_CASE("in an experiment with another plugin nothing dies that did not do anything wrong") {
  const Graph graph = mission(in_a_child + std::string(with_fallback));
  const fs::path log = fresh("child.mcap");
  REQUIRE(fly_and_signal(graph, log, SIGKILL).guards.size() == 1);
  Overrides other;
  other.with = {{"one", variant("_better")}};
  CHECK(replay_of(log, other).flight.guards.empty());
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --with one=" + variant("_better"));
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("before").at("guards").size() == 1);
  CHECK(j.at("after").at("guards").empty());
}

}  // namespace late_work_test
