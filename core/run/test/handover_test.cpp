// SPDX-License-Identifier: BSD-3-Clause
// Side effects of a hand-over: activation, passed values, rejections, the record in the result.
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"

namespace handover_test {

namespace {

const char* const one_then_two =
    "phases:\n"
    "  first:  {law: one, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
    "  second: {law: two}\n";

double probe(const Graph& g, const Flight& flight, const std::string& component, const std::string& name) {
  return value(g, flight, component, name, "");
}

}  // namespace

TEST_CASE("the last applied output is passed on only for an equal message type") {
  const Graph g =
      mission("  new: {fills: law, use: lab/NewLaw}\n"s +
              "phases:\n  first: {law: new, next: [{to: second, when: \"vehicle.status.armed\"}]}\n"
              "  second: {law: two}\n");
  Flight flight(g, options(0.1));
  flight.run();
  CHECK(value(g, flight, "sim", "applied", "by") == 2);
  CHECK(probe(g, flight, "two", "taken_over_frac") == 0);  // not -77, the first field of the other's
}

TEST_CASE("a new component of a low rate steps in the tick of the change, not in that of its period") {
  const Graph g = mission(
      "  two: {fills: law, use: lab/Law, rate: 50 Hz, params: {id: 2, u: 0.2}}\n"
      "phases:\n"
      "  a: {law: two, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
      "  b: {law: {use: one, fallback: two}}\n",
      {{"one.fault", "nan"}, {"one.fault_at", "0.1075"}});  // in its period it would fly at 0.12 s
  Flight flight(g, options(0.1075));
  CHECK(flight.run().guards.size() == 1);
  CHECK(value(g, flight, "two", "command", "seen_m") == value(g, flight, "sim", "signal", "x_m"));
}

TEST_CASE("the result has the times of each active component, and the duration of each phase") {
  const Graph g = mission(one_then_two);
  Flight flight(g, options(0.3));
  const FlightResult r = flight.run();
  REQUIRE(r.phases.size() == 2);
  CHECK(r.phases[0].from_ns == -1'000'000'000);
  CHECK(r.phases[0].to_ns == 100'000'000);
  CHECK(r.phases[1].to_ns == 300'000'000);
  std::vector<Tenure> law;
  for (const Tenure& t : r.tenures)
    if (t.role == "law") law.push_back(t);
  REQUIRE(law.size() == 2);
  CHECK(law[0].component == "one");
  CHECK(law[0].from_ns == -1'000'000'000);
  CHECK(law[0].to_ns == 100'000'000);
  CHECK(law[1].component == "two");
  CHECK(law[1].from_ns == 100'000'000);
  CHECK(law[1].to_ns == 300'000'000);
}

TEST_CASE("a fallback that was stopped itself is not activated again") {
  const Graph g = mission(
      "phases:\n"
      "  a: {law: {use: two, fallback: one}, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.2 s\"}]}\n"
      "  b: {law: {use: one, fallback: two}}\n",
      {{"two.fault", "fails"}, {"two.fault_at", "0.1"}, {"one.fault", "fails"}, {"one.fault_at", "0.3"}});
  Flight flight(g, options(0.4));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 2);
  CHECK(r.guards[0].action == "one takes over");
  CHECK(r.guards[1].action == "failsafe");
}

TEST_CASE("the sender of a request to a component that is then stopped gets an answer") {
  const Graph g = mission(  // the request comes between two of its steps, and its exception arrives 10 ms
                            // later
      "  watch: {use: lab/Watch, rate: 20 Hz, run: async, latency: 10 ms, params: {stop_at: 0.1 s}, in: "
      "{burst: "
      "vehicle.burst, applied: vehicle.applied}}\n"s +
      one_phase);
  Flight flight(g, options(0.2));
  while (flight.now_ns() < 105'000'000) REQUIRE(flight.step());
  std::vector<std::string> answers;
  request(flight, "watch", "ask", 1.0, [&](const std::string& answer) { answers.push_back(answer); });
  while (flight.now_ns() < 115'000'000) REQUIRE(flight.step());
  CHECK(answers == std::vector<std::string>{"was stopped"});
}

TEST_CASE("a request without an answer does not get the previous one's") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0.2));
  std::vector<std::string> answers;
  for (const double to : {1.0, 200.0}) {  // the second is not answered
    request(flight, "watch", "ask", to, [&](const std::string& answer) { answers.push_back(answer); });
    REQUIRE(flight.step());
  }
  CHECK(answers == std::vector<std::string>{"", "was not answered"});
}

TEST_CASE("a sample is fresh once: not in the tick after the one that has read it") {
  const Graph g =
      mission("  one: {fills: law, use: lab/Law, rate: 50 Hz, params: {id: 1, u: 0.1}}\n"s + one_phase);
  Flight stepped(g, options(0.1025));  // the report is about the previous tick
  stepped.run();
  CHECK(value(g, stepped, "sim", "applied", "fresh") == 1);
  Flight between(g, options(0.105));
  between.run();
  CHECK(value(g, between, "sim", "applied", "present") == 1);
  CHECK(value(g, between, "sim", "applied", "fresh") == 0);
}

TEST_CASE("each item of a queue is checked, not only the first") {
  const Graph g = mission(one_phase, {{"sim.bad_item", "1"}});
  Flight flight(g, options(0.1));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "run.vehicle_failed(output 'burst': types.value_not_finite(x_m, nan))");
}

TEST_CASE("a component that stays with its group is not deactivated") {
  const Graph g = mission(
      "  both: {fills: [sense, law], use: lab/Both, in: {signal: vehicle.signal}, params: {u: 0.7}}\n"
      "  mute: {use: lab/Filter, in: {signal: vehicle.signal}, params: {mute_at: -1e9 s}}\n"
      "  hungry: {fills: sense, use: lab/Filter, in: {signal: mute.signal}}\n"
      "phases:\n"
      "  a: {law: both, next: [{to: b, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
      "  b: {sense: hungry, law: two}\n");
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "hungry");
  CHECK(value(g, flight, "sim", "applied", "by") == 7);
  CHECK(probe(g, flight, "both", "steps_ratio") > 400);  // since the beginning
}

TEST_CASE("a flight without a command has not begun, unless the aircraft has left the ground") {
  const Graph g = mission(
      "  fcu: {fills: vehicle, use: lab/Cart}\n"
      "  hungry: {fills: law, use: lab/Hungry, run: tick, in: {never: late.echo}}\n"
      "  late:   {use: lab/Late, run: tick, in: {never: {from: late.echo, delayed: true}}}\n"
      "phases:\n  a: {law: hungry}\nio: fcu\n");
  for (const bool flies : {false, true}) {
    CAPTURE(flies);
    Flight flight(g, options(100));
    if (flies) request(flight, "fcu", "arm", true);  // the cart stands while it is disarmed
    while (flight.now_ns() < 100'000'000) REQUIRE(flight.step());
    CHECK(flight.finish().idle == (flies ? "" : "law"));
  }
}

}  // namespace handover_test
