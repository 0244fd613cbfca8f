// SPDX-License-Identifier: BSD-3-Clause
// The loop, flown in a laboratory (lab.cpp): order, rates, phases, hand-over, guards, failsafe, pace, equal
// bytes.
#include "core/run/flight.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "core/run/component/allocation.hpp"
#include "core/run/state/published.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"

namespace flight_test {

TEST_CASE("a sample that the vehicle reads is used in the same tick, and its command is written in it") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0.5));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.reason == "duration reached");
  CHECK(r.first_ns == -1'000'000'000);
  CHECK(r.last_ns == 500'000'000);
  CHECK(r.ticks == 601);
  // `applied` is published by the next read: it belongs to the previous tick.
  CHECK(value(g, flight, "sim", "applied", "seen_m") == value(g, flight, "sim", "signal", "x_m") - 1);
  CHECK(value(g, flight, "sim", "applied", "present") == 1);
  CHECK(value(g, flight, "sim", "applied", "fresh") == 1);
}

TEST_CASE("a rate is kept by integer due times and passed as dt") {
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

TEST_CASE("samples without room in an output queue are reported to the reader") {
  const Graph g = mission(one_phase, {{"sim.burst_size", "6"}});
  Flight flight(g, options(0));
  flight.run();
  CHECK(value(g, flight, "watch", "tally", "samples_ratio") == 4 * 401);
  CHECK(value(g, flight, "watch", "tally", "lost_ratio") == 2 * 401);
}

TEST_CASE("a slow reader of a queue gets the number of lost samples") {
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

TEST_CASE("a delayed wire carries the sample of the previous tick, in any order of steps") {
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

TEST_CASE("a copy plan feeds a reader that has fewer fields than the writer") {
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
  std::vector<std::string> printed;
  FlightOptions o = options(0.5);
  o.say = [&](const std::string& line, bool) { printed.push_back(line); };
  Flight flight(g, o);
  const FlightResult r = flight.run();
  REQUIRE(r.phases.size() == 3);
  CHECK(r.phases[1].name == "second");
  CHECK(r.phases[1].from_ns == 100'000'000);
  CHECK(r.phases[2].from_ns == 300'000'000);
  CHECK(printed[1] == "    0.10 s  run.phase_entered(second)");
  // the new component got the last applied outputs of its role
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

TEST_CASE("a new component that rejects its activation leaves the old one active") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"vehicle.status.armed\"}]}\n"
      "  second: {law: two}\n",
      {{"two.refuse", "true"}});
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "run.cannot_take_over(refuses to take over)");
  CHECK(r.guards[0].action == "the old one stays");
  CHECK(value(g, flight, "sim", "applied", "by") == 1);
}

TEST_CASE("every fault of a law is caught in its tick, the fallback flies in the same tick") {
  struct Case {
    const char *fault, *what;
  };
  for (const Case& c :
       {Case{"nan", "output 'command': types.value_not_finite(u_frac, nan)"},
        Case{"range", "output 'command': types.value_out_of_range(u_frac, 1.5, -1, 1)"},
        Case{"throws", "the law is broken  ?\xc3\xa9  2J"}, Case{"fails", "says that it failed"},
        Case{"probe_nan", "run.probe_not_finite(error_m)"}}) {
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

TEST_CASE("without a usable component the failsafe values are sent for their time, then nothing") {
  const Graph g = mission(one_phase, {{"one.fault", "nan"}, {"one.fault_at", "0.1"}});
  Flight in_time(g, options(0.3));
  const FlightResult r = in_time.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "run.failsafe(one, output 'command': types.value_not_finite(u_frac, nan))");
  CHECK(r.guards[0].action == "failsafe");
  CHECK(value(g, in_time, "sim", "applied", "u_frac") == -0.25);
  CHECK(value(g, in_time, "sim", "applied", "present") == 1);
  CHECK(value(g, in_time, "sim", "applied", "fresh") == 1);  // in every tick: the vehicle must not detect
                                                             // silence
  CHECK(value(g, in_time, "sim", "applied", "stale") == 0);
  Flight later(g, options(0.8));
  later.run();
  CHECK(value(g, later, "sim", "applied", "present") == 0);
  FlightOptions endless = options(0);
  endless.duration_s.reset();
  Flight lost(g, endless);
  CHECK(lost.run().last_ns == 1'600'000'000);  // fault at 0.1 s, values for 0.5 s, silence for 1 s
}

TEST_CASE("a law with a stale required input is stopped") {
  const Graph g = mission(with_fallback, {{"filter.stop_at", "0.1"}});
  Flight flight(g, options(3));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  REQUIRE(r.guards.size() >= 2);
  CHECK(r.guards[0].component == "filter");
  CHECK(r.guards[0].action == "held");
  CHECK(r.guards[1].component == "one");
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, filter)");
  CHECK(r.guards[1].action == "failsafe");  // the fallback would use the same old signal
  for (const GuardEvent& guard : r.guards) CHECK(guard.at_ns == 100'000'000);
}

TEST_CASE("a live parameter changes the base under an overlay, a set-up parameter does not change") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0));
  ParamValue v;
  v.number[0] = 0.6;
  set_parameter(flight, "one", "u", v);
  CHECK_THROWS_WITH(set_parameter(flight, "one", "fixed", v), "run.parameter_not_live(one, fixed)");
  v.number[0] = 4;
  CHECK_THROWS(set_parameter(flight, "one", "u", v));
  flight.run();
  CHECK(value(g, flight, "sim", "applied", "u_frac") == doctest::Approx(0.6));
}

TEST_CASE("a stopped component is active again after a reset") {
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
  CHECK(component_seed(5, "watch") != component_seed(6, "watch"));  // not only in the texts of the log
  CHECK(component_seed(5, "watch") != component_seed(5, "other"));
}

TEST_CASE("the loop does not allocate, and a component that does is named") {
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

TEST_CASE("without a use of the clock one tick in eight is timed, for every component at any rate") {
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
  CHECK(Flight(budgeted, unpaced).run().guards.empty());  // an unpaced simulation has no deadline
  FlightOptions paced = options(0.1);
  paced.speed = 1000;
  const FlightResult r = Flight(budgeted, paced).run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "run.time_budget_exceeded");
  CHECK(r.guards[0].action == "two takes over");
}

TEST_CASE("a phase whose component and fallback are both stopped keeps the active one") {
  const Graph g = mission(
      "  three: {fills: law, use: lab/Law, params: {id: 3, u: 0.3}}\n"
      "phases:\n"
      "  a: {law: {use: one, fallback: two}, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.2 s\"}]}\n"
      "  b: {law: {use: two, fallback: three}, next: [{to: c, when: \"vehicle.signal.tick_s >= 0.4 s\"}]}\n"
      "  c: {law: {use: one, fallback: two}}\n",
      {{"one.fault", "nan"}, {"one.fault_at", "0.1"}, {"two.fault", "throws"}, {"two.fault_at", "0.3"}});
  std::vector<std::string> printed;
  FlightOptions o = options(2);
  o.say = [&](const std::string& line, bool) { printed.push_back(line); };
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(value(g, flight, "sim", "applied", "by") == 3);
  CHECK(printed.back() == "    0.40 s  law: run.no_candidate(three)");
}

TEST_CASE("a new component whose required input has no sample does not take over") {
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
  CHECK(r.guards[0].what == "run.cannot_take_over(run.input_empty(never))");
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
