// SPDX-License-Identifier: BSD-3-Clause
// The loop, flown in a laboratory (lab.cpp): order, rates, phases, hand-over, guards, failsafe, requests,
// equal bytes.
#include "core/run/flight.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/log/reader.hpp"
#include "core/run/component/allocation.hpp"
#include "core/run/state/published.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/run/verdict.hpp"
#include "core/types/wire.hpp"

namespace flight_test {

TEST_CASE("what the vehicle reads is flown on in the same tick, and written in it") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0.5));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.reason == "duration reached");
  CHECK(r.first_ns == -1'000'000'000);
  CHECK(r.last_ns == 500'000'000);
  CHECK(r.ticks == 601);
  // `applied` is published by the next read: it tells of the tick before.
  CHECK(value(g, flight, "sim", "applied", "seen_m") == value(g, flight, "sim", "signal", "x_m") - 1);
  CHECK(value(g, flight, "sim", "applied", "present") == 1);
  CHECK(value(g, flight, "sim", "applied", "fresh") == 1);
}

TEST_CASE("a rate is kept by integer due times and told as dt") {
  const Graph g = mission(std::string("  slow: {use: lab/Watch, rate: 70 Hz}\n") + one_phase);
  Flight flight(g, options(9));
  const FlightResult r = flight.run();
  // 10 s and one tick at 70 Hz: the first tick and 700 due times, none lost to rounding up to the 2.5 ms grid
  CHECK(value(g, flight, "slow", "tally", "steps_ratio") == 701);
  CHECK(value(g, flight, "watch", "tally", "steps_ratio") == 4001);
  CHECK(value(g, flight, "watch", "tally", "dt_s") == doctest::Approx(0.0025));
  CHECK(value(g, flight, "slow", "tally", "dt_s") == doctest::Approx(1 / 70.0).epsilon(0.2).scale(0));
}

TEST_CASE("a queue brings every sample once") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0));
  flight.run();
  const double n = 401;
  CHECK(value(g, flight, "watch", "tally", "samples_ratio") == 3 * n);
  CHECK(value(g, flight, "watch", "tally", "lost_ratio") == 0);
  CHECK(value(g, flight, "watch", "tally", "sum_m") == doctest::Approx(3 * n * (n - 1) / 2 + 0.3 * n));
}

TEST_CASE("what found no room in an output queue is told to the reader") {
  const Graph g = mission(one_phase, {{"sim.burst_size", "6"}});
  Flight flight(g, options(0));
  flight.run();
  CHECK(value(g, flight, "watch", "tally", "samples_ratio") == 4 * 401);
  CHECK(value(g, flight, "watch", "tally", "lost_ratio") == 2 * 401);
}

TEST_CASE("a slow reader of a queue is told what it lost") {
  const Graph g =
      mission(std::string("  slow: {use: lab/Watch, rate: 10 Hz, in: {burst: vehicle.burst}}\n") + one_phase);
  Flight flight(g, options(0));
  flight.run();
  const double taken = value(g, flight, "slow", "tally", "samples_ratio"),
               lost = value(g, flight, "slow", "tally", "lost_ratio");
  CHECK(lost > 0);
  CHECK(taken + lost == 3 * 401);  // the last step is at the last tick
}

TEST_CASE("a component is not stepped before each required input has had a sample") {
  const Graph g = mission(
      "  late: {use: lab/Late, in: {never: other.echo}}\n  other: {use: lab/Late, in: {never: {from: "
      "late.echo, delayed: true}}}\n" +
      std::string(one_phase));
  Flight flight(g, options(0));
  CHECK(flight.run().outcome == Outcome::flown);
  CHECK(flight.sample(port(g, "late", "tally")) == nullptr);
}

TEST_CASE("a delayed wire carries the sample of the previous tick, whoever steps first") {
  const Graph g = mission(
      std::string("  early: {use: lab/OldReader, in: {signal: {from: filter.signal, delayed: true}}}\n"
                  "  late: {use: lab/OldReader, in: {signal: {from: vehicle.signal, delayed: true}}}\n") +
      one_phase);
  Flight flight(g, options(0));
  flight.run();
  CHECK(value(g, flight, "early", "tally", "dt_s") == doctest::Approx(-0.0025));
  CHECK(value(g, flight, "late", "tally", "dt_s") == doctest::Approx(-0.0025));
  CHECK(value(g, flight, "late", "tally", "steps_ratio") == 400);
}

TEST_CASE("a reader that knows fewer fields than the writer is fed by a copy plan") {
  const Graph g =
      mission(std::string("  old: {use: lab/OldReader, in: {signal: vehicle.signal}}\n") + one_phase);
  Flight flight(g, options(0));
  flight.run();
  CHECK(value(g, flight, "old", "tally", "steps_ratio") == 401);
  CHECK(value(g, flight, "old", "tally", "dt_s") == 0);  // it reads the writer's second field
}

TEST_CASE("a phase hands over in the tick in which its condition has held for its time") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"vehicle.status.armed\", for: 0.1 s}]}\n"
      "  second: {law: {use: two, set: {u: 0.7}}, next: [{to: third, when: \"vehicle.signal.tick_s >= 0.3 "
      "s\"}]}\n"
      "  third:  {law: two}\n");
  std::vector<std::string> said;
  FlightOptions o = options(0.5);
  o.say = [&](const std::string& line, bool) { said.push_back(line); };
  Flight flight(g, o);
  const FlightResult r = flight.run();
  REQUIRE(r.phases.size() == 3);
  CHECK(r.phases[1].name == "second");
  CHECK(r.phases[1].from_ns == 100'000'000);
  CHECK(r.phases[2].from_ns == 300'000'000);
  CHECK(said[1] == "    0.10 s  phase second");
  // the newcomer got the outputs last applied in its role
  double taken = 0;
  std::memcpy(&taken, flight.sample(port(g, "two", "taken_over_frac")), sizeof taken);
  CHECK(taken == doctest::Approx(0.1));
  CHECK(value(g, flight, "sim", "applied", "by") == 2);
  CHECK(value(g, flight, "sim", "applied", "u_frac") ==
        doctest::Approx(0.2));  // the overlay of `second` is gone
}

TEST_CASE("an overlay holds while its phase lasts") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: {use: one, set: {u: 0.9}}, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.3 "
      "s\"}]}\n"
      "  second: {law: one}\n");
  FlightOptions o = options(0.2);
  Flight before(g, o);
  before.run();
  CHECK(value(g, before, "sim", "applied", "u_frac") == doctest::Approx(0.9));
  Flight after(g, options(0.5));
  after.run();
  CHECK(value(g, after, "sim", "applied", "u_frac") == doctest::Approx(0.1));
}

TEST_CASE("a newcomer that refuses leaves the old one flying") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"vehicle.status.armed\"}]}\n"
      "  second: {law: two}\n",
      {{"two.refuse", "true"}});
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "cannot take over: refuses to take over");
  CHECK(r.guards[0].action == "the old one stays");
  CHECK(value(g, flight, "sim", "applied", "by") == 1);
}

TEST_CASE("every fault of a law is caught in its tick, the fallback flies in the same tick") {
  struct Case {
    const char *fault, *what;
  };
  for (const Case& c :
       {Case{"nan", "output 'command': u_frac is nan"},
        Case{"range", "output 'command': u_frac is 1.5, outside [-1, 1]"},
        Case{"throws", "the law is broken  ?\xc3\xa9  2J"}, Case{"fails", "says that it failed"},
        Case{"probe_nan", "probe 'error_m' is not finite"}}) {
    CAPTURE(c.fault);
    const Graph g = mission(with_fallback, {{"one.fault", c.fault}, {"one.fault_at", "0.1"}});
    Flight flight(g, options(0.1));  // ends with the tick of the fault
    const FlightResult r = flight.run();
    CHECK(r.outcome == Outcome::flown);
    REQUIRE(r.guards.size() == 1);
    CHECK(r.guards[0].component == "one");
    CHECK(r.guards[0].what == std::string(c.what));
    CHECK(r.guards[0].action == "two takes over");
    CHECK(r.guards[0].at_ns == 100'000'000);
    CHECK(value(g, flight, "two", "command", "by") == 2);
    CHECK(value(g, flight, "two", "command", "seen_m") == value(g, flight, "sim", "signal", "x_m"));
    CHECK(value(g, flight, "one", "command", "u_frac") ==
          doctest::Approx(0.1));  // the last good output is what is left
  }
}

TEST_CASE("when nobody is left the failsafe values are sent for their time, then nothing") {
  const Graph g = mission(one_phase, {{"one.fault", "nan"}, {"one.fault_at", "0.1"}});
  Flight in_time(g, options(0.3));
  const FlightResult r = in_time.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "failsafe: one: output 'command': u_frac is nan");
  CHECK(r.guards[0].action == "failsafe");
  CHECK(value(g, in_time, "sim", "applied", "u_frac") == -0.25);
  CHECK(value(g, in_time, "sim", "applied", "present") == 1);
  CHECK(value(g, in_time, "sim", "applied", "fresh") == 1);  // in every tick: no vehicle holds it for silence
  CHECK(value(g, in_time, "sim", "applied", "stale") == 0);
  Flight later(g, options(0.8));
  later.run();
  CHECK(value(g, later, "sim", "applied", "present") == 0);
  FlightOptions endless = options(0);
  endless.duration_s.reset();
  Flight lost(g, endless);
  CHECK(lost.run().last_ns == 1'600'000'000);  // fault at 0.1 s, values for 0.5 s, silence for 1 s
}

TEST_CASE("a law whose required input has gone stale is not flown on") {
  const Graph g = mission(with_fallback, {{"filter.stop_at", "0.1"}});
  Flight flight(g, options(3));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  REQUIRE(r.guards.size() >= 2);
  CHECK(r.guards[0].component == "filter");
  CHECK(r.guards[0].action == "held");
  CHECK(r.guards[1].component == "one");
  CHECK(r.guards[1].what == "input 'signal' comes from filter, which was stopped");
  CHECK(r.guards[1].action == "failsafe");  // the fallback would fly on the same old signal
  for (const GuardEvent& guard : r.guards) CHECK(guard.at_ns == 100'000'000);
}

TEST_CASE("the vehicle's failure ends the flight") {
  const Graph g = mission(one_phase, {{"sim.fail_at", "0.2"}});
  Flight flight(g, options(1));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "the vehicle failed: says that it failed");
  const Graph still = mission(one_phase, {{"sim.stuck_at", "0.2"}});
  Flight other(still, options(1));
  for (int i = 0; i < 1000 && other.step(); ++i) {
  }
  CHECK(other.finish().reason == "the vehicle failed: time went from 200000000 to 200000000 ns");
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
  CHECK(late.reason == "not done within 100 s of flight");
  std::atomic<int> stop{1};
  o.interrupt = &stop;
  CHECK(Flight(endless, o).run().outcome == Outcome::interrupted);
}

namespace {

/// A flight without a log, and what it is called.
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

TEST_CASE("a flight that is done without what its mission calls flown is aborted") {
  const std::string done = "done: \"vehicle.signal.tick_s > 0.2 s\"\n";
  const Called aborted = called(done + "flown: \"vehicle.signal.tick_s > 0.3 s\"\n");
  CHECK(aborted.result.outcome == Outcome::aborted);
  CHECK(aborted.result.reason == "vehicle.signal.tick_s > 0.2 s; never held: vehicle.signal.tick_s > 0.3 s");
  CHECK(aborted.verdict == "aborted");
  const Called flown =  // it need not hold at the end
      called(done + "flown: \"vehicle.signal.tick_s > 0.05 s and vehicle.signal.tick_s < 0.1 s\"\n");
  CHECK(flown.result.outcome == Outcome::flown);
  CHECK(flown.verdict == "flown");
  CHECK(called(done + "flown: {when: \"vehicle.signal.tick_s < 0.1 s\", for: 2 s}\n").result.outcome ==
        Outcome::aborted);
  CHECK(called("failed: \"vehicle.signal.tick_s > 0.2 s\"\nflown: \"time > 9 s\"\n").result.outcome ==
        Outcome::failed);
}

TEST_CASE("the verdict of a flight is what a component says of it, in one line") {
  const std::string said = "  herald: {use: lab/Herald}\nverdict: herald.said\n";
  const std::string failed = "failed: \"vehicle.signal.tick_s > 0.2 s\"\n";
  CHECK(called(said + failed).verdict == "crashed: the nose touched");
  CHECK(called(said + failed, {{"herald.names", "false"}}).verdict == "failed: the nose touched");
  CHECK(called(said + failed, {{"herald.at", "9"}}).verdict == "failed");  // nothing was said
  CHECK(called(said + "done: \"vehicle.signal.tick_s > 0.2 s\"\n").verdict == "flown: the nose touched");
  CHECK_THROWS_WITH_AS(called("  herald: {use: lab/Herald}\nverdict: herald.other\n"),
                       doctest::Contains("'herald.other' is Tally, which has no texts 'word' and 'text'"),
                       Error);
}

TEST_CASE("a flight whose verdict has no component flies, and names what it is without") {
  const Called c = called(
      "  herald: {use: lab/Herald, only: fcu}\nverdict: herald.said\n"
      "done: \"vehicle.signal.tick_s > 0.2 s\"\n");
  CHECK(c.verdict == "flown: no verdict; without what herald reports");
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

TEST_CASE("a request is answered by the step that sees it") {
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
                    "there is no component 'wach'. Did you mean 'watch'? Valid: sim, filter, one, watch.");
  CHECK_THROWS_WITH(request(flight, "watch", "aks", go, take),
                    "'watch' takes no request 'aks'. Did you mean 'ask'? Valid: ask.");
  const double wrong = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(request(flight, "watch", "ask", wrong, take), "watch.ask: to_m is nan");
  flight.run();
  REQUIRE(answers.size() == 2);
  CHECK(answers[0].empty());
  CHECK(answers[1] == "cannot go back");
}

TEST_CASE("the log tells what was asked, and what was refused and why") {
  const Graph g = mission(one_phase);
  FlightOptions o = options(0.2);
  o.log = true;
  o.log_file = folder().path / "asked.mcap";
  Flight flight(g, o);
  const double go = 1, back = -1;
  for (const double* to : {&go, &back}) request(flight, "watch", "ask", *to);
  flight.run();
  const McapFile file = read_mcap(o.log_file);
  std::vector<std::string> told;
  for (const McapFile::Message& m : file.messages) {
    if (m.channel != file.channel("/fulmar/event")) continue;
    const std::string bytes(reinterpret_cast<const char*>(m.data.data()), m.data.size());
    for (const char* text : {"ask refused: cannot go back", "ask"})
      if (bytes.find("watch") != std::string::npos && bytes.find(text) != std::string::npos) {
        told.push_back(text);
        break;
      }
  }
  CHECK(told == std::vector<std::string>{"ask", "ask", "ask refused: cannot go back"});
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
  const McapFile file = read_mcap(o.log_file);
  const HostTopic<Event> events(file);
  const HostTopic<LogLine> lines(file);
  REQUIRE(lines.same());
  std::vector<Event> told;
  std::size_t line = 0, levels = 0;
  for (const McapFile::Message& m : file.messages) {
    if (events.holds(m)) told.push_back(events.read(m.data));
    if (!lines.holds(m)) continue;
    const LogLine l = lines.read(m.data);
    REQUIRE(line < told.size());
    const Event& e = told[line++];
    CHECK(std::string(l.msg.data()) == e.words.data());
    CHECK(std::string(l.name.data()) == (e.component[0] ? e.component.data() : "fulmar"));
    CHECK(std::string(l.function.data()) == kind_words(e.code));
    CHECK(std::uint64_t{l.nanosec} + 1'000'000'000ull * static_cast<std::uint64_t>(l.sec) == m.log_ns);
    levels += l.level;
  }
  CHECK(line == told.size());
  CHECK(line >= 2);
  CHECK(levels == 20 * line);
  CHECK(told.back().code == Code::concluded);  // the verdict is the last word
  CHECK(std::string(told.back().name.data()) == "flown");
  CHECK(std::string(told.back().words.data()) == "flown (duration reached)");
  Event bad = event_of(Code::failsafe);
  CHECK(int{log_line_of(bad, 0).level} == 50);
  CHECK(int{log_line_of(event_of(Code::guard), 0).level} == 30);
  CHECK(log_line_of(bad, -1'500'000'000).sec == -2);
  CHECK(log_line_of(bad, -1'500'000'000).nanosec == 500'000'000);
}

TEST_CASE("a live parameter changes the base under an overlay, a set-up parameter does not change") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0));
  ParamValue v;
  v.number[0] = 0.6;
  set_parameter(flight, "one", "u", v);
  CHECK_THROWS_WITH(set_parameter(flight, "one", "fixed", v),
                    "one.fixed is a set-up parameter: it cannot change in flight");
  v.number[0] = 4;
  CHECK_THROWS(set_parameter(flight, "one", "u", v));
  flight.run();
  CHECK(value(g, flight, "sim", "applied", "u_frac") == doctest::Approx(0.6));
}

TEST_CASE("a stopped component flies again after a reset") {
  const Graph g = mission(with_fallback, {{"one.fault", "nan"}, {"one.fault_at", "0.1"}});
  Flight flight(g, options(0.2));
  flight.run();
  CHECK(flight.sample({Source::Kind::role, 2, 0}) != nullptr);
  CHECK_NOTHROW(reset_guards(flight));
}

TEST_CASE("equal mission and seed give equal log bytes, another seed gives others") {
  auto fly = [&](std::uint64_t seed, const std::string& name) {
    const Graph g = mission(one_phase, {{"watch.noise", "1"}}, seed);
    FlightOptions o = options(2);
    o.log = true;
    o.log_file = folder().path / name;
    Flight flight(g, o);
    const FlightResult r = flight.run();
    CHECK(r.log.dropped == 0);
    CHECK(r.log.error.empty());
    CHECK(r.log.messages > 1000);
    return r.log.sha256;
  };
  const std::string a = fly(5, "a.mcap"), b = fly(5, "b.mcap"), c = fly(6, "c.mcap");
  CHECK(a == b);
  CHECK(a != c);
  CHECK(component_seed(5, "watch") != component_seed(6, "watch"));  // not in the log's words alone
  CHECK(component_seed(5, "watch") != component_seed(5, "other"));
}

TEST_CASE("the loop takes no memory, and a component that does is named") {
  if (!counts_allocations()) return;
  const Graph g = mission(one_phase);
  FlightOptions o = options(1);
  o.log = true;
  o.log_file = folder().path / "none.mcap";
  Flight flight(g, o);
  const FlightResult r = flight.run();
  for (const ComponentStats& c : r.components) CHECK_MESSAGE(c.allocations == 0, c.name);
  CHECK(r.loop_allocations == 0);
  const Graph greedy = mission(one_phase, {{"one.fault", "allocates"}, {"one.fault_at", "0"}});
  Flight other(greedy, options(1));
  for (const ComponentStats& c : other.run().components)
    if (c.name == "one") CHECK(c.allocations == 401);
}

TEST_CASE("where nobody waits for the clock one tick in eight is timed, of every component at any rate") {
  for (int period = 1; period <= 20; ++period) {
    Graph g = mission(one_phase);
    for (Component& c : g.components)
      if (c.name == "one") c.period_ns = period * g.tick_ns;
    for (const ComponentStats& c : Flight(g, options(20)).run().components) {
      CAPTURE(period);
      CAPTURE(c.name);
      CAPTURE(c.steps);
      if (c.steps > 100)
        CHECK(std::abs(static_cast<double>(c.time.count()) / static_cast<double>(c.steps) -
                       0.125 * (c.name == "sim" ? 2 : 1)) < 0.02);
    }
  }
  FlightOptions paced = options(1);
  paced.speed = 1000;
  for (const ComponentStats& c : Flight(mission(one_phase), paced).run().components)
    CHECK(c.time.count() >= c.steps);
}

TEST_CASE("a paced flight stops a component that is over its budget five times in a row") {
  const Graph g = mission(with_fallback, {{"one.fault", "slow"}, {"one.fault_at", "0"}});
  Graph budgeted = g;
  for (Component& c : budgeted.components)
    if (c.name == "one") c.budget_ns = 50'000;
  FlightOptions unpaced = options(0.1);
  CHECK(Flight(budgeted, unpaced).run().guards.empty());  // an unpaced simulation knows no deadline
  FlightOptions paced = options(0.1);
  paced.speed = 1000;
  const FlightResult r = Flight(budgeted, paced).run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "was over its time budget in 5 steps in a row");
  CHECK(r.guards[0].action == "two takes over");
}

TEST_CASE("a phase whose component and fallback are both stopped leaves flying who flies") {
  const Graph g = mission(
      "  three: {fills: law, use: lab/Law, params: {id: 3, u: 0.3}}\n"
      "phases:\n"
      "  a: {law: {use: one, fallback: two}, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.2 s\"}]}\n"
      "  b: {law: {use: two, fallback: three}, next: [{to: c, when: \"vehicle.signal.tick_s >= 0.4 s\"}]}\n"
      "  c: {law: {use: one, fallback: two}}\n",
      {{"one.fault", "nan"}, {"one.fault_at", "0.1"}, {"two.fault", "throws"}, {"two.fault_at", "0.3"}});
  std::vector<std::string> said;
  FlightOptions o = options(2);
  o.say = [&](const std::string& line, bool) { said.push_back(line); };
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(value(g, flight, "sim", "applied", "by") == 3);
  CHECK(said.back() == "    0.40 s  law: nobody that this phase names can fly: three goes on");
}

TEST_CASE("a newcomer whose required input has no sample does not take over") {
  const Graph g = mission(
      "  hungry: {fills: law, use: lab/Hungry, in: {never: late.echo}}\n"
      "  late:   {use: lab/Late, in: {never: {from: late.echo, delayed: true}}}\n"
      "phases:\n"
      "  a: {law: one, next: [{to: b, when: \"vehicle.status.armed\"}]}\n"
      "  b: {law: {use: hungry, fallback: two}}\n");
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "hungry");
  CHECK(r.guards[0].what == "cannot take over: input 'never' has no sample");
  CHECK(value(g, flight, "sim", "applied", "by") == 2);  // the phase's fallback
}

TEST_CASE("a flight in failsafe is never done") {
  const Graph g = mission(std::string("done: \"vehicle.signal.tick_s > 0.3 s\"\n") + one_phase,
                          {{"one.fault", "nan"}, {"one.fault_at", "0.1"}});
  FlightOptions o;
  o.log = false;
  CHECK(Flight(g, o).run().outcome == Outcome::failed);
}

TEST_CASE(
    "a role's condition reads the right field of whoever fills the role, whatever else that one's message "
    "has") {
  const Graph g = mission("  new: {fills: law, use: lab/NewLaw}\n"s +
                          "phases:\n  old: {law: one, next: [{to: new, when: \"vehicle.status.armed\"}]}\n" +
                          "  new: {law: new, next: [{to: end, when: \"law.command.u_frac > 0.7\"}, {to: old, "
                          "when: \"law.command.u_frac < -1\"}]}\n" +
                          "  end: {law: new}\n");
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  CHECK(flight.phase() == "end");
  CHECK(r.phases.size() == 3);
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.75);
}

}  // namespace flight_test
