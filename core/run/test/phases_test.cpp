// SPDX-License-Identifier: BSD-3-Clause
// Changes of phases, and the initial state of components that begin in one.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/run/test/lab.hpp"

namespace phases_test {

namespace {

/// The laboratory's mission with one more role, which two watches can fill.
Graph with_watches(const std::string& phases) {
  std::string text = base;
  const std::string vehicle = "  vehicle:";
  text.insert(text.find(vehicle), "  look:    {in: {burst: vehicle.burst}, out: {tally: Tally}}\n");
  text += "  w1: {fills: look, use: lab/Watch}\n  w2: {fills: look, use: lab/Watch}\n" + phases;
  const fs::path file = folder().path / "watches.yaml";
  std::ofstream(file) << text;
  return load_mission(file.string(), {});
}
const char* const back_and_forth =
    "phases:\n"
    "  first:  {law: one, look: w1, next: [{to: second, when: \"vehicle.signal.tick_s >= 0.1 s\"}]}\n"
    "  second: {law: one, look: w2, next: [{to: third, when: \"vehicle.signal.tick_s >= 0.3 s\"}]}\n"
    "  third:  {law: one, look: w1}\n";

}  // namespace

TEST_CASE("a condition holds for its time without a break") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: one, next: [{to: second, for: 0.15 s, when: \"vehicle.status.armed and "
      "(vehicle.signal.tick_s < 0.1 s or vehicle.signal.tick_s >= 0.3 s)\"}]}\n"
      "  second: {law: two}\n");
  const FlightResult r = Flight(g, options(0.6)).run();
  REQUIRE(r.phases.size() == 2);
  CHECK(r.phases[1].from_ns == 450'000'000);
}

TEST_CASE("a transition from anywhere that was made must hold for its time again") {
  const Graph g = mission(
      "phases:\n"
      "  any: {next: [{to: b, when: \"vehicle.status.armed\", for: 0.1 s}]}\n"
      "  a: {law: one}\n"
      "  b: {law: two, next: [{to: a, when: \"vehicle.signal.tick_s >= 0.2 s\"}]}\n");
  const FlightResult r = Flight(g, options(0.35)).run();
  REQUIRE(r.phases.size() >= 4);
  CHECK(r.phases[1].from_ns == 100'000'000);
  CHECK(r.phases[2].from_ns == 200'000'000);
  CHECK(r.phases[3].from_ns >= 300'000'000);
}

TEST_CASE("the time of a condition counts from the beginning of its phase") {
  const Graph g = mission(
      "phases:\n"
      "  any: {next: [{to: b, when: \"vehicle.signal.tick_s >= 0.2 s and vehicle.signal.tick_s < 0.205 "
      "s\"}]}\n"
      "  a: {law: one, next: [{to: c, when: \"vehicle.status.armed\", for: 0.3 s}]}\n"
      "  b: {law: two, next: [{to: c, when: \"vehicle.status.armed\", for: 0.3 s}]}\n"
      "  c: {law: one}\n");
  const FlightResult r = Flight(g, options(0.6)).run();
  REQUIRE(r.phases.size() == 3);
  CHECK(r.phases[1].from_ns == 200'000'000);
  CHECK(r.phases[2].from_ns >= 500'000'000);
}

TEST_CASE("a component that begins has the samples that came to its queue while another was active") {
  const Graph g = with_watches(back_and_forth);
  Flight flight(g, options(0.2));
  flight.run();
  CHECK(value(g, flight, "w2", "tally", "steps_ratio") == 41);
  CHECK(value(g, flight, "w2", "tally", "lost_ratio") == 0);
  CHECK(value(g, flight, "w2", "tally", "samples_ratio") == 3 * 40);
}

TEST_CASE("dt of the first step after a pause is one period, not the pause") {
  const Graph g = with_watches(back_and_forth);
  Flight flight(g, options(0.4));
  double max_s = 0;
  while (flight.step()) max_s = std::max(max_s, value(g, flight, "w1", "tally", "dt_s"));
  CHECK(flight.phase() == "third");
  CHECK(max_s == doctest::Approx(0.0025));
}

TEST_CASE("a phase overlays the vehicle's parameters, from its first tick to its last") {
  const Graph g = mission(
      "phases:\n"
      "  first:  {law: one, vehicle: {set: {burst_size: 1}}, next: [{to: second, when: \"time >= 0.1 s\"}]}\n"
      "  second: {law: one, next: [{to: third, when: \"time >= 0.2 s\"}]}\n"
      "  third:  {law: one, vehicle: {use: sim, set: {burst_size: 0}}}\n");
  Flight flight(g, options(0.3));
  double before = 0;
  const auto samples_until = [&](double t_s) {
    while (flight.step() && static_cast<double>(flight.now_ns()) < t_s * 1e9 - 1) {
    }
    const double all = value(g, flight, "watch", "tally", "samples_ratio");
    return all - std::exchange(before, all);
  };
  CHECK(samples_until(0.1) == 441);  // one a tick, from -1 s
  CHECK(flight.phase() == "second");
  CHECK(samples_until(0.2) == 3 * 40);
  CHECK(samples_until(0.3) == 0);
}

}  // namespace phases_test
