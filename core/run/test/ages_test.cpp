// SPDX-License-Identifier: BSD-3-Clause
// No component flies on the last output of a stopped writer, over any kind of wire; an output that need not
// publish may pause.
#include <doctest/doctest.h>

#include "core/run/component/ports.hpp"
#include "core/run/test/lab.hpp"
#include "core/types/named.hpp"

namespace ages_test {

/// cart -> plan (fills no role) -> law: a component without a role stands between the sensors and the
/// aircraft.
const char* const through_plan =
    "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
    "  one:  {fills: law, use: lab/Law, params: {id: 1, u: 0.1}, in: {signal: plan.signal}}\n";

TEST_CASE("a law is stopped in the tick in which the component that feeds it is, role or not") {
  const Graph g = mission(std::string(through_plan) + with_fallback, {{"plan.stop_at", "0.1"}});
  Flight flight(g, options(0.1));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 2);
  CHECK(r.guards[0].component == "plan");
  CHECK(r.guards[1].component == "one");
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, plan)");
  CHECK(r.guards[1].action == "two takes over");  // its signal comes from another source
  CHECK(r.guards[1].at_ns == 100'000'000);
  CHECK(value(g, flight, "two", "command", "seen_m") == value(g, flight, "sim", "signal", "x_m"));
}

TEST_CASE("the chain to the vehicle may consist of components without a role alone") {
  const Graph g = mission(
      "  plan:   {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  manage: {use: lab/Filter, in: {signal: plan.signal}}\n"
      "  one:    {fills: law, use: lab/Law, params: {id: 1, u: 0.1}, in: {signal: manage.signal}}\n" +
          std::string(one_phase),
      {{"plan.stop_at", "0.1"}});
  Flight flight(g, options(0.3));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 3);
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, plan)");
  CHECK(r.guards[2].what == "run.input_of_stopped(signal, manage)");
  CHECK(r.guards[2].action == "failsafe");
  CHECK(r.guards[2].at_ns == 100'000'000);
  CHECK(r.outcome == Outcome::failed);
}

TEST_CASE("a wire from an output without a role is watched like one with a role") {
  // the law's signal comes by the filter's own name; the filter is replaced, and steps no more
  const Graph g = mission(
      "  other: {fills: sense, use: lab/Filter}\n"
      "  one:   {fills: law, use: lab/Law, params: {id: 1, u: 0.1}, in: {signal: filter.signal}}\n"
      "phases:\n"
      "  first:  {sense: filter, law: {use: one, fallback: two}, next: [{to: second, when: "
      "\"vehicle.signal.tick_s >= 0.2 s\"}]}\n"
      "  second: {sense: other, law: {use: one, fallback: two}}\n");
  Flight flight(g, options(2));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "one");
  CHECK(r.guards[0].action == "two takes over");
  CHECK(r.guards[0].at_ns == 1'202'500'000);  // a second after the filter's last step, at 0.2 s
}

TEST_CASE("an output that need not publish has the age of its writer's last step") {
  const Graph silent = mission(std::string(through_plan) + one_phase, {{"plan.mute_at", "0.1"}});
  Flight flight(silent, options(5));
  const FlightResult reported = flight.run();
  REQUIRE(reported.guards.size() == 1);  // reported, and not stopped
  CHECK(reported.guards[0].action == "its last sample stays");
  // an age that the mission sets is that of the sample
  const Graph strict = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  one:  {fills: law, use: lab/Law, in: {signal: {from: plan.signal, max_age: 300 ms}}}\n" +
          std::string(one_phase),
      {{"plan.mute_at", "0.1"}});
  const FlightResult r = Flight(strict, options(5)).run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "run.input_too_old(signal, 0.302, 0.300)");
}

TEST_CASE("a slow writer has three of its steps before its reader is stopped") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, rate: 0.5 Hz, in: {signal: vehicle.signal}}\n"
      "  one:  {fills: law, use: lab/Law, in: {signal: plan.signal}}\n" +
      std::string(one_phase));
  CHECK(Flight(g, options(9)).run().guards.empty());
  for (const Component& c : g.components)
    if (c.name == "one") CHECK(c.wires[0].max_age_ns == 6'000'000'000);
}

TEST_CASE("a sample of the previous tick is lost with its writer, too") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  one:  {fills: law, use: lab/Law, in: {signal: {from: plan.signal, delayed: true}}}\n" +
          std::string(with_fallback),
      {{"plan.stop_at", "0.1"}});
  const FlightResult r = Flight(g, options(0.2)).run();
  REQUIRE(r.guards.size() == 2);
  CHECK(r.guards[1].component == "one");
  CHECK(r.guards[1].at_ns <= 102'500'000);
}

TEST_CASE("a component with 'max_age: off' flies on, and the mission gets a warning") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  one:  {fills: law, use: lab/Law, in: {signal: {from: plan.signal, max_age: off}}}\n" +
          std::string(one_phase),
      {{"plan.stop_at", "0.1"}});
  REQUIRE(g.source.warnings.size() == 1);
  CHECK(g.source.warnings[0].find(
            "graph.age_unlimited(one, signal, , even when its writer was stopped: max_age is off)") !=
        std::string::npos);
  const FlightResult r = Flight(g, options(2)).run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "plan");
  CHECK(mission(std::string(through_plan) + one_phase).source.warnings.empty());
}

TEST_CASE("a component that waits for the first sample of a stopped writer does not wait forever") {
  const Graph by_role = mission(with_fallback, {{"filter.stop_at", "-10"}});
  const FlightResult r = Flight(by_role, options(1)).run();
  CHECK(r.outcome == Outcome::failed);
  REQUIRE(r.guards.size() >= 2);
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, filter)");
  CHECK(r.guards.back().action == "failsafe");
  CHECK(r.guards.back().at_ns <= -997'500'000);  // the second tick
  const Graph by_name = mission(std::string(through_plan) + with_fallback, {{"plan.stop_at", "-10"}});
  Flight flight(by_name, options(0.1));
  const FlightResult other = flight.run();
  REQUIRE(other.guards.size() == 2);
  CHECK(other.guards[1].action == "two takes over");
  CHECK(value(by_name, flight, "sim", "applied", "by") == 2);
}

TEST_CASE("a new component that fails in its first step leaves nothing of its predecessor's output") {
  const Graph g = mission(
      "  other: {fills: sense, use: lab/Filter, params: {stop_at: 0.1}}\n"
      "phases:\n"
      "  first:  {sense: filter, law: one, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
      "  second: {sense: other, law: one}\n");
  const FlightResult r = Flight(g, options(0.3)).run();
  REQUIRE(r.guards.size() == 2);
  CHECK(r.guards[0].component == "other");
  CHECK(r.guards[1].what == "run.input_of_stopped(signal, other)");
  CHECK(r.guards[1].at_ns <= 102'500'000);
}

TEST_CASE("a component that does not lead to the vehicle continues after any stop") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  seen: {use: lab/Filter, in: {signal: plan.signal}}\n" +
          std::string(one_phase),
      {{"plan.stop_at", "0.1"}});
  const FlightResult r = Flight(g, options(2)).run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.guards.size() == 1);
}

TEST_CASE("the age of a sample of the previous tick counts from that tick") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "  one:  {fills: law, use: lab/Law, in: {signal: {from: plan.signal, delayed: true, max_age: 300 "
      "ms}}}\n" +
      std::string(one_phase));
  CHECK(Flight(g, options(2)).run().guards.empty());
}

TEST_CASE("the last output of a stopped component decides nothing") {
  const Graph g = mission(
      "  plan: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"plan.signal.tick_s > 0 s\", for: 0.2 s}]}\n"
      "  second: {law: two}\n",
      {{"plan.stop_at", "0.1"}});
  CHECK(Flight(g, options(0.5)).run().phases.size() == 1);
}

TEST_CASE("a component without a role between the laws and the vehicle is watched, too") {
  const auto relayed = [](const std::string& params, const std::string& wire, double until_s) {
    const Graph g = mission("  sim: {fills: vehicle, use: lab/Cart, in: {command: " + wire +
                            "}}\n  relay: {use: lab/Late, in: {never: law.command}, params: {" + params +
                            "}}\n" + one_phase);
    Flight flight(g, options(until_s));
    FlightResult r = flight.run();
    return std::pair(r, value(g, flight, "sim", "applied", "u_frac"));
  };
  CHECK(relayed("", "relay.echo", 3).first.guards.empty());
  const auto [stopped, given] = relayed("stop_at: 0.1 s", "relay.echo", 0.2);
  CHECK(stopped.outcome == Outcome::failed);
  CHECK(stopped.reason == "run.failsafe(sim, run.input_of_stopped(command, relay))");
  REQUIRE(stopped.guards.size() == 2);
  CHECK(stopped.guards[0].component == "relay");
  CHECK(stopped.guards[1].action == "failsafe");
  CHECK(stopped.guards[1].at_ns == 100'000'000);
  CHECK(given == -0.25);
  const FlightResult silent = relayed("mute_at: 0.1 s", "{from: relay.echo, max_age: 100 ms}", 0.3).first;
  CHECK(silent.reason.starts_with("run.failsafe(sim, run.input_too_old(command, 0.10"));
  CHECK(silent.guards.at(0).at_ns == 200'000'000);
  CHECK(relayed("stop_at: 0.1 s", "{from: relay.echo, max_age: off}", 0.3).first.outcome == Outcome::flown);
}

/// Warnings and guard events of a flight of four seconds.
struct Printed {
  std::vector<std::string> lines;
  FlightResult result;
};
Printed printed_by(const std::string& tail, const std::vector<std::pair<std::string, std::string>>& set = {},
                   double until_s = 4) {
  const Graph g = mission(tail, set);
  FlightOptions o = options(until_s);
  Printed printed;
  o.say = [&](const std::string& line, bool warning) {
    if (warning) printed.lines.push_back(line);
  };
  Flight flight(g, o);
  printed.result = flight.run();
  return printed;
}

TEST_CASE("a regular output that stops is reported, and so is its return") {
  // a filter in a role, as the lab has it
  CHECK(printed_by(one_phase).lines.empty());
  const Printed filter = printed_by(
      one_phase, {{"filter.mute_at", "0.1"}, {"filter.until", "2.5"}, {"filter.mute_again", "2.8"}});
  REQUIRE(filter.lines.size() == 3);
  CHECK(filter.lines[0] == "    1.10 s  filter: run.output_silent_event(run.output_silent(signal, 1.0))");
  CHECK(filter.lines[1] == "    2.50 s  filter: run.output_resumed(signal)");
  CHECK(filter.lines[2].find("3.80 s  filter: run.output_silent_event(run.output_silent(signal, ") !=
        std::string::npos);
  // the result has it once
  REQUIRE(filter.result.guards.size() == 1);
  CHECK(filter.result.guards[0].component == "filter");
  CHECK(filter.result.guards[0].what == "run.output_silent(signal, 1.0)");
  CHECK(filter.result.guards[0].action == "its last sample stays");
  CHECK(filter.result.outcome == Outcome::flown);
  // without a role, on the way to the vehicle
  const std::string relay =
      "  sim: {fills: vehicle, use: lab/Cart, in: {command: relay.echo}}\n"
      "  relay: {use: lab/Late, in: {never: law.command}, params: {mute_at: 0.5 s}}\n";
  const Printed relayed = printed_by(relay + one_phase);
  REQUIRE(relayed.lines.size() == 1);
  CHECK(relayed.lines[0].starts_with("    1.5"));  // the outputs are checked in turn
  CHECK(relayed.lines[0].find("relay: run.output_silent_event(run.output_silent(echo, 1.0))") !=
        std::string::npos);
  // at its own rate; ticks without a step do not count
  const std::string slow =
      "  filter: {fills: sense, use: lab/Filter, rate: 100 Hz, params: {mute_at: 0.1 s}}\n";
  CHECK(printed_by(slow + one_phase).lines.size() == 1);
}

TEST_CASE("an output in every third step is regular; one with pauses has longer limits") {
  CHECK(printed_by(one_phase, {{"filter.every", "3"}}).lines.empty());
  CHECK(printed_by(one_phase, {{"filter.every", "3"}, {"filter.mute_at", "0.1"}}).lines.size() == 1);
  // 25 samples are enough, 15 are not
  CHECK(printed_by(one_phase, {{"filter.mute_at", "-0.9375"}}).lines.size() == 1);
  CHECK(printed_by(one_phase, {{"filter.mute_at", "-0.9625"}}).lines.empty());
  // pauses of 0.2 s: two seconds of silence are one
  const auto pausing = [](double until_s) {
    return printed_by(one_phase, {{"filter.every", "80"}, {"filter.mute_at", "5"}}, until_s).lines.size();
  };
  CHECK(pausing(6.7) == 0);
  CHECK(pausing(7.2) == 1);
}

TEST_CASE(
    "a watch that only a condition reads is reported when it stops publishing, and when it is stopped") {
  const std::string fence = "  fence: {use: lab/Filter, in: {signal: vehicle.signal}}\n";
  const std::string filter_broken = "the filter is broken";  // of the laboratory's filter
  for (const std::string key : {"failed", "done"}) {
    const std::string watched =
        fence + one_phase + key + ": {when: \"fence.signal.x_m > 1e6 m\", for: 2 s}\n";
    CHECK(printed_by(watched).lines.empty());
    const Printed silent = printed_by(watched, {{"fence.mute_at", "0.1"}});
    REQUIRE(silent.lines.size() == 1);
    CHECK(silent.lines[0].find("1.10 s  fence: run.output_silent_event(run.output_silent(signal, 1.0))") !=
          std::string::npos);
    CHECK(silent.result.guards.size() == 1);
    const Printed stopped = printed_by(watched, {{"fence.stop_at", "0.1"}});
    REQUIRE(stopped.lines.size() == 2);
    CHECK(stopped.lines[0].find("fence: " + filter_broken) != std::string::npos);
    CHECK(stopped.lines[1] == "    0.10 s  fence: run.condition_dead(" + key + ", fence.signal.x_m > 1e6 m)");
  }
  const std::string phases =
      fence +
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"fence.signal.x_m > 1e6 m\"}]}\n"
      "  second: {law: two, next: [{to: first, when: \"sense.signal.x_m > 1e6 m\"}]}\n";
  CHECK(printed_by(phases, {{"fence.mute_at", "0.1"}}).lines.size() == 1);
  const Printed stopped = printed_by(phases, {{"fence.stop_at", "0.1"}});
  REQUIRE(stopped.lines.size() == 2);
  CHECK(stopped.lines[1].find("run.condition_dead(second, fence.signal.x_m > 1e6 m)") != std::string::npos);
}

TEST_CASE("a phase that waits for a stopped component reports it at its start") {
  const std::string phases =
      "  fence: {use: lab/Filter, in: {signal: vehicle.signal}}\n"
      "phases:\n"
      "  first:  {law: one, next: [{to: second, when: \"sense.signal.tick_s > 1 s\"}]}\n"
      "  second: {law: two, next: [{to: first, when: \"fence.signal.tick_s > 2 s\"}]}\n";
  const Printed stopped = printed_by(phases, {{"fence.stop_at", "0.1"}});
  REQUIRE(stopped.lines.size() == 2);
  CHECK(stopped.lines[1].find("1.00 s  fence: run.condition_dead(first, fence.signal.tick_s > 2 s)") !=
        std::string::npos);
  CHECK(stopped.result.phases.size() == 2);
}

TEST_CASE("a law that sends nothing to the vehicle loses its role, when its inputs come") {
  const std::string law = "  one: {fills: law, use: lab/Mute}\n";
  CHECK(printed_by(law + with_fallback).lines.empty());
  const Printed fallen = printed_by(law + with_fallback, {{"one.mute_at", "0.1"}});
  REQUIRE(fallen.result.guards.size() == 2);
  CHECK(fallen.result.guards[1].what == "run.command_missing(command)");
  CHECK(fallen.result.guards[1].action == "two takes over");
  CHECK(std::abs(fallen.result.guards[1].at_ns - 1'100'000'000) < 10'000'000);
  CHECK(fallen.result.outcome == Outcome::flown);
  // one that reports a fault itself is not reported again
  CHECK(printed_by(law + with_fallback, {{"one.mute_at", "0.1"}, {"one.explains", "true"}})
            .result.guards.empty());
  const Printed lost = printed_by(law + one_phase, {{"one.mute_at", "0.1"}});
  CHECK(lost.result.outcome == Outcome::failed);
  CHECK(lost.result.guards.at(1).action == "failsafe");
  const Graph g = mission("  device: {use: lab/Ticker, run: driver}\n"s + one_phase);
  CHECK_FALSE(Intake(*find_named(g.components, "device")).all_younger_than(1'000'000'000, 0));  // has none
  // its inputs do not come: it has a reason, and publishes when they return
  const Printed waits = printed_by(law + with_fallback, {{"one.mute_at", "0.1"}, {"filter.mute_at", "0.05"}});
  REQUIRE(waits.result.guards.size() == 2);
  CHECK(waits.result.guards[0].component == "filter");
  CHECK(waits.result.guards[1].action == "its last sample stays");
}

}  // namespace ages_test
