// SPDX-License-Identifier: BSD-3-Clause
// Texts of a flight, flown in a laboratory (lab.cpp): its end, its verdict, answers to requests, the events
// in its log.
#include <doctest/doctest.h>

#include <atomic>

#include "core/log/test/read_mcap.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/run/verdict.hpp"

namespace flight_words_test {

TEST_CASE("the vehicle's failure ends the flight") {
  const Graph g = mission(one_phase, {{"sim.fail_at", "0.2"}});
  Flight flight(g, options(1));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "run.vehicle_failed(says that it failed)");
  const Graph still = mission(one_phase, {{"sim.stuck_at", "0.2"}});
  Flight other(still, options(1));
  for (int i = 0; i < 1000 && other.step(); ++i) {
  }
  CHECK(other.finish().reason == "run.vehicle_failed(run.time_not_monotonic(200000000, 200000000))");
}

TEST_CASE("done, failed and timeout end a flight, in words") {
  const Graph done = mission(std::string("done: \"vehicle.signal.tick_s > 0.2 s\"\n") + one_phase);
  FlightOptions o;
  o.log = false;
  const FlightResult flown = Flight(done, o).run();
  CHECK(flown.outcome == Outcome::flown);
  CHECK(flown.reason == "vehicle.signal.tick_s > 0.2 s");
  const Graph held =
      mission(std::string("done: {when: \"vehicle.signal.tick_s > 0.2 s\", for: 0.1 s}\n") + one_phase);
  CHECK(Flight(held, o).run().last_ns == 302'500'000);
  const Graph failed = mission(std::string("failed: \"vehicle.signal.tick_s > 0.2 s\"\n") + one_phase);
  CHECK(Flight(failed, o).run().outcome == Outcome::failed);
  const Graph endless = mission(one_phase);
  const FlightResult late = Flight(endless, o).run();
  CHECK(late.outcome == Outcome::failed);
  CHECK(late.reason == "run.mission_not_done(100)");
  std::atomic<int> stop{1};
  o.interrupt = &stop;
  CHECK(Flight(endless, o).run().outcome == Outcome::interrupted);
}

namespace {

/// A flight without a log, and its outcome.
struct Called {
  FlightResult result;
  std::string verdict;
};
Called called(const std::string& tail, const std::vector<std::pair<std::string, std::string>>& set = {}) {
  const Graph g = mission(tail + one_phase, set);
  FlightOptions o;
  o.log = false;
  Flight flight(g, o);
  Called c{flight.run(), ""};
  c.verdict = verdict_of(g, flight, c.result);
  return c;
}

}  // namespace

TEST_CASE("a flight that is done without the mission's `flown` condition is aborted") {
  const std::string done = "done: \"vehicle.signal.tick_s > 0.2 s\"\n";
  const Called aborted = called(done + "flown: \"vehicle.signal.tick_s > 0.3 s\"\n");
  CHECK(aborted.result.outcome == Outcome::aborted);
  CHECK(aborted.result.reason == "vehicle.signal.tick_s > 0.2 s; never held: vehicle.signal.tick_s > 0.3 s");
  CHECK(aborted.verdict == "aborted");
  const Called flown =  // it need not hold at the end
      called(done + "flown: \"vehicle.signal.tick_s > 0.05 s and vehicle.signal.tick_s < 0.1 s\"\n");
  CHECK(flown.result.outcome == Outcome::flown);
  CHECK(flown.verdict == "flown");
  const std::string too_long = "flown: {when: \"vehicle.signal.tick_s < 0.1 s\", for: 2 s}\n";
  CHECK(called(done + too_long).result.outcome == Outcome::aborted);
  CHECK(called("failed: \"vehicle.signal.tick_s > 0.2 s\"\nflown: \"time > 9 s\"\n").result.outcome ==
        Outcome::failed);
}

TEST_CASE("the verdict of a flight comes from a component, in one line") {
  const std::string printed = "  herald: {use: lab/Herald}\nverdict: herald.said\n";
  const std::string failed = "failed: \"vehicle.signal.tick_s > 0.2 s\"\n";
  CHECK(called(printed + failed).verdict == "crashed: the nose touched");
  CHECK(called(printed + failed, {{"herald.names", "false"}}).verdict == "failed: the nose touched");
  CHECK(called(printed + failed, {{"herald.at", "9"}}).verdict == "failed");  // there was no text
  CHECK(called(printed + "done: \"vehicle.signal.tick_s > 0.2 s\"\n").verdict == "flown: the nose touched");
  CHECK_THROWS_WITH_AS(called("  herald: {use: lab/Herald}\nverdict: herald.other\n"),
                       doctest::Contains("graph.event_fields_missing(herald.other, Tally)"), Error);
}

TEST_CASE("a flight whose verdict has no component flies, and names the missing one") {
  const Called c = called(
      "  herald: {use: lab/Herald, only: fcu}\nverdict: herald.said\n"
      "done: \"vehicle.signal.tick_s > 0.2 s\"\n");
  CHECK(c.verdict == "flown: run.verdict_sources_missing(herald)");
}

TEST_CASE("a phase remembers the condition that led to it") {
  FlightOptions o;
  o.log = false;
  o.duration_s = 0.3;
  const FlightResult r = Flight(mission("phases:\n  fly: {law: one, next: [{to: on, when: "
                                        "\"vehicle.signal.tick_s > 0.1 s\"}]}\n  on: {law: two}\n"),
                                o)
                             .run();
  REQUIRE(r.phases.size() == 2);
  CHECK(r.phases[0].because == "");
  CHECK(r.phases[1].because == "vehicle.signal.tick_s > 0.1 s");
}

TEST_CASE("a request is answered by the step that reads it") {
  const Graph g = mission(std::string("done: \"vehicle.signal.tick_s > 0.2 s\"\n") + one_phase);
  FlightOptions o;
  o.log = false;
  Flight flight(g, o);
  const double go = 1, back = -1;
  std::vector<std::string> answers;
  auto take = [&](const std::string& answer) { answers.push_back(answer); };
  request(flight, "watch", "ask", go, take);
  request(flight, "watch", "ask", back, take);
  CHECK_THROWS_WITH(request(flight, "wach", "ask", go, take),
                    "types.name_unknown(component, wach,  [watch] sim, filter, one, watch)");
  CHECK_THROWS_WITH(request(flight, "watch", "aks", go, take),
                    "run.entrance_unknown(watch, request, aks,  [ask] ask)");
  const double wrong = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(request(flight, "watch", "ask", wrong, take),
                    "watch.ask: types.value_not_finite(to_m, nan)");
  flight.run();
  REQUIRE(answers.size() == 2);
  CHECK(answers[0].empty());
  CHECK(answers[1] == "cannot go back");
}

TEST_CASE("the log holds each request, each rejection and its reason") {
  const Graph g = mission(one_phase);
  FlightOptions o = options(0.2);
  o.log = true;
  o.log_file = folder().path / "asked.mcap";
  Flight flight(g, o);
  const double go = 1, back = -1;
  for (const double* to : {&go, &back}) request(flight, "watch", "ask", *to);
  flight.run();
  const WholeLog file = read_mcap(o.log_file);
  std::vector<std::string> reported;
  for (const McapFile::Message& m : file.messages) {
    if (m.channel != file.channel("/fulmar/event")) continue;
    const std::string bytes(reinterpret_cast<const char*>(m.data.data()), m.data.size());
    for (const char* text : {"run.request_refused(ask, cannot go back)", "ask"})
      if (bytes.find("watch") != std::string::npos && bytes.find(text) != std::string::npos) {
        reported.push_back(text);
        break;
      }
  }
  CHECK(reported == std::vector<std::string>{"ask", "ask", "run.request_refused(ask, cannot go back)"});
}

TEST_CASE("each event is a line for log panels as well, with its level and the time of the log") {
  const Graph g = mission(one_phase);
  FlightOptions o = options(0.2);
  o.log = true;
  o.log_file = folder().path / "lines.mcap";
  Flight flight(g, o);
  const double back = -1;
  request(flight, "watch", "ask", back);
  flight.run();
  const WholeLog file = read_mcap(o.log_file);
  const HostTopic<Event> events(file);
  const HostTopic<LogLine> lines(file);
  REQUIRE(lines.same());
  std::vector<Event> reported;
  std::size_t line = 0, levels = 0;
  for (const McapFile::Message& m : file.messages) {
    if (events.holds(m)) reported.push_back(events.read(m.data));
    if (!lines.holds(m)) continue;
    const LogLine l = lines.read(m.data);
    REQUIRE(line < reported.size());
    const Event& e = reported[line++];
    CHECK(std::string(l.msg.data()) == e.words.data());
    CHECK(std::string(l.name.data()) == (e.component[0] ? e.component.data() : "fulmar"));
    CHECK(std::string(l.function.data()) == kind_words(e.code));
    CHECK(std::uint64_t{l.nanosec} + 1'000'000'000ull * static_cast<std::uint64_t>(l.sec) == m.log_ns);
    levels += l.level;
  }
  CHECK(line == reported.size());
  CHECK(line >= 2);
  CHECK(levels == 20 * line);
  CHECK(reported.back().code == Code::concluded);  // the verdict is the last event
  CHECK(std::string(reported.back().name.data()) == "flown");
  CHECK(std::string(reported.back().words.data()) == "run.concluded(flown, duration reached)");
  Event bad = event_of(Code::failsafe);
  CHECK(int{log_line_of(bad, 0).level} == 50);
  CHECK(int{log_line_of(event_of(Code::guard), 0).level} == 30);
  CHECK(log_line_of(bad, -1'500'000'000).sec == -2);
  CHECK(log_line_of(bad, -1'500'000'000).nanosec == 500'000'000);
}

}  // namespace flight_words_test
