// SPDX-License-Identifier: BSD-3-Clause
// A component that fills several roles takes over, hands over and falls back with all of them.
#include <doctest/doctest.h>

#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"

namespace groups_test {

const char* const both =
    "  both: {fills: [sense, law], use: lab/Both, in: {signal: vehicle.signal}, params: {u: 0.7}}\n";

/// The pair, then the group, then the pair again.
const char* const there_and_back =
    "phases:\n"
    "  first:  {law: one, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
    "  second: {law: both, next: [{to: third, when: \"vehicle.signal.tick_s >= 0.2 s\"}]}\n"
    "  third:  {law: two}\n";

std::vector<std::string> fillers(const Graph& g, const std::string& phase) {
  std::vector<std::string> names;
  for (const Phase& p : g.phases)
    if (p.name == phase)
      for (const Assignment& a : p.roles)
        names.push_back(
            (a.component < 0 ? "-" : g.components[static_cast<std::size_t>(a.component)].name) +
            (a.fallback < 0 ? "" : "/" + g.components[static_cast<std::size_t>(a.fallback)].name));
  return names;
}

std::string refusal(const std::string& tail) {
  try {
    mission(tail);
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return "accepted";
}

TEST_CASE("a phase that names it for one role has it in all of them") {
  const Graph g = mission(std::string(both) + there_and_back);
  CHECK(fillers(g, "first") == std::vector<std::string>{"sim", "filter", "one"});
  CHECK(fillers(g, "second") == std::vector<std::string>{"sim", "both", "both"});
  CHECK(fillers(g, "third") == std::vector<std::string>{"sim", "filter", "two"});
}

TEST_CASE("it takes over all its roles in one tick, and hands over all of them in one") {
  const Graph g = mission(std::string(both) + there_and_back);
  Flight during(g, options(0.15));
  CHECK(during.run().guards.empty());
  CHECK(value(g, during, "sim", "applied", "by") == 7);
  CHECK(value(g, during, "both", "taken_over_frac", "") == doctest::Approx(0.1));
  CHECK(value(g, during, "both", "taken_over_m", "") == 440);  // of the filter, in the tick of the change
  CHECK(value(g, during, "both", "steps_ratio", "") == 21);
  Flight after(g, options(0.3));
  CHECK(after.run().guards.empty());
  CHECK(value(g, after, "sim", "applied", "by") == 2);
  double taken = 0;
  std::memcpy(&taken, after.sample(port(g, "two", "taken_over_frac")), sizeof taken);
  CHECK(taken == doctest::Approx(0.7));
  // an inactive component does not step
  CHECK(value(g, after, "both", "steps_ratio", "") == 41);
}

TEST_CASE("when it is stopped each of its roles falls back in that tick, sources first") {
  for (const char* const fallbacks :
       {"{law: {use: both, fallback: two}}", "{sense: {use: both, fallback: filter}}",
        "{sense: {use: both, fallback: filter}, law: {fallback: one}}"}) {
    CAPTURE(fallbacks);
    const bool one = std::string(fallbacks).find("two") == std::string::npos;
    const Graph g =
        mission(std::string(both) + "phases:\n  fly: " + fallbacks + "\n", {{"both.fails_at", "0.1"}});
    Flight flight(g, options(0.1));
    const FlightResult r = flight.run();
    CHECK(r.outcome == Outcome::flown);
    REQUIRE(r.guards.size() == 1);
    CHECK(r.guards[0].what == "both are broken");
    CHECK(r.guards[0].action == (one ? "filter, one take over" : "filter, two take over"));
    const char* const law = one ? "one" : "two";
    CHECK(value(g, flight, law, "command", "seen_m") == value(g, flight, "sim", "signal", "x_m"));
  }
}

TEST_CASE("it is the fallback of single components, and takes its other role as well") {
  const Graph g = mission(std::string(both) + "phases:\n  fly: {law: {use: one, fallback: both}}\n",
                          {{"one.fault", "nan"}, {"one.fault_at", "0.1"}});
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].action == "both takes over");
  CHECK(value(g, flight, "sim", "applied", "by") == 7);
  const double filtered = value(g, flight, "filter", "signal", "tick_s");
  CHECK(filtered == doctest::Approx(0.1));  // it rests: no role needs it
}

TEST_CASE("without a usable fallback there is failsafe, not half a group") {
  const Graph g = mission(std::string(both) + "phases:\n  fly: {law: both}\n", {{"both.fails_at", "0.1"}});
  Flight flight(g, options(0.3));
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::failed);
  CHECK(r.reason == "run.failsafe(both, both are broken)");
  CHECK(value(g, flight, "sim", "applied", "u_frac") == -0.25);
}

TEST_CASE("one of its successors rejects its activation: it keeps all its roles") {
  const Graph g =
      mission(std::string(both) +
                  "phases:\n"
                  "  first:  {law: both, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
                  "  second: {law: two}\n",
              {{"two.refuse", "true"}});
  Flight flight(g, options(0.2));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].what == "run.cannot_take_over(refuses to take over)");
  CHECK(r.guards[0].action == "the old one stays");
  CHECK(value(g, flight, "sim", "applied", "by") == 7);
  CHECK(value(g, flight, "filter", "signal", "tick_s") == doctest::Approx(0.1));  // the tick of the attempt
}

TEST_CASE("it rejects its activation: the pair continues") {
  const Graph g = mission(std::string(both) + there_and_back, {{"both.refuse", "true"}});
  Flight flight(g, options(0.15));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].action == "the old one stays");
  CHECK(value(g, flight, "sim", "applied", "by") == 1);
}

TEST_CASE("a phase's settings apply in all its roles, and are written once") {
  const std::string set = std::string(both) + "phases:\n  fly: {law: {use: both, set: {u: -0.4}}}\n";
  const Graph g = mission(set);
  Flight flight(g, options(0.1));
  flight.run();
  CHECK(value(g, flight, "sim", "applied", "u_frac") == doctest::Approx(-0.4));
  const std::string twice =
      "phases:\n  fly: {sense: {use: both, set: {u: 0}}, law: {use: both, set: {u: -0.4}}}\n";
  CHECK(refusal(std::string(both) + twice).find("phases.fly: graph.phase_set_repeated(both)") !=
        std::string::npos);
}

TEST_CASE("--role puts the group, or a single one, in its place in every phase") {
  Overrides with_group, without;
  with_group.roles = {{"sense", "both"}};
  without.roles = {{"law", "two"}};
  mission(std::string(both) + there_and_back);
  const std::string file = (folder().path / "lab.yaml").string();
  CHECK(fillers(load_mission(file, with_group), "first") == std::vector<std::string>{"sim", "both", "both"});
  CHECK(fillers(load_mission(file, without), "second") == std::vector<std::string>{"sim", "filter", "two"});
  Overrides apart;
  apart.roles = {{"sense", "both"}, {"law", "two"}};
  CHECK_THROWS_WITH(load_mission(file, apart),
                    "--role: graph.components_share_roles(two, law, both, sense and law)");
}

TEST_CASE("impossible groups are rejected, with a sentence") {
  const std::string flies = one_phase;
  struct Case {
    std::string mission;
    const char* reported;
  };
  const Case cases[] = {
      {"  both: {fills: [sense, sense], use: lab/Both, in: {signal: vehicle.signal}}\n" + flies,
       "components.both.fills: graph.entry_repeated(sense)"},
      {"  both: {fills: [sense, lw], use: lab/Both, in: {signal: vehicle.signal}}\n" + flies,
       "components.both: types.name_unknown(role, lw,  [law] vehicle, sense, law)"},
      {"  both: {fills: [sense, law], use: lab/Both}\n" + flies, "graph.role_inputs_conflict(both, signal)"},
      {"  both: {fills: [vehicle, law], use: lab/Both}\n" + flies,
       "graph.vehicle_roles_shared(components.both.fills: )"},
      {std::string(both) + "phases:\n  fly: {sense: filter, law: both}\n",
       "phases.fly.law: graph.components_share_roles(both, sense and law, filter, sense)"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.mission);
    CHECK(refusal(c.mission).find(c.reported) != std::string::npos);
  }
}

}  // namespace groups_test
