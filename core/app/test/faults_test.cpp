// SPDX-License-Identifier: BSD-3-Clause
// A part of the simulated aircraft fails while the shipped autopilot flies: some cases of bench_faults, a
// failure that one phase starts and another one ends, and their replays.
#include <doctest/doctest.h>

#include "core/app/test/fault_campaign.hpp"
#include "core/app/test/unlogged.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/run/component/allocation.hpp"
#include "core/run/test/commands.hpp"
#include "fulmar/msg/fault_request.hpp"
#include "tools/fulmar_replay/replay.hpp"

using namespace fulmar::core;
using namespace fulmar::core::failures;

namespace faults_test {

TEST_CASE("the circuit is flown with a barometer, a magnetometer or a rudder that fails") {
  const test::OwnStore folder;
  using Named = std::pair<const char*, const char*>;
  for (const Named& n :
       {Named{"nothing", ""}, Named{"baro", "stuck"}, Named{"mag", "jumping"}, Named{"rudder", "lost"}}) {
    CAPTURE(n.first);
    const After a = fly(failure(n.first, n.second), 1, folder.path, test::unlogged());
    CHECK(a.flown);
    CHECK(a.plan_m < 15);
    CHECK(a.lowest_m > 60);
    CHECK(a.guards == 0);
    if (!counts_allocations()) break;  // under the sanitizers a flight takes twenty times as long
  }
}

TEST_CASE(
    "without motor it glides down, with an elevator hard over it falls: no guard, and no flown circuit") {
  const test::OwnStore folder;
  const After glide = fly(failure("engine", "off"), 1, folder.path, test::unlogged());
  CHECK(glide.down);
  CHECK_FALSE(glide.flown);
  CHECK(glide.down_s > 10);
  const After fall = fly(failure("elevator", "hardover_positive"), 1, folder.path, test::unlogged());
  CHECK(fall.down);
  CHECK(fall.down_s < 8);
  CHECK(fall.down_s < glide.down_s);
}

/// The receiver's position is 50 m wrong for 30 s.
std::string recovers() {
  return "mission: recovers\nextends: " FULMAR_SOURCE_DIR
         "/configs/missions/hourglass.yaml\nlive: off\n"
         "done: {when: \"vehicle.status.armed\", for: 90 s}\nphases:\n"
         "  cruise:  {next: [{to: failing, when: \"vehicle.status.armed\", for: 20 s}]}\n"
         "  failing: {vehicle: {set: {gnss_position_fault: wrong}}, next: [{to: again, when: "
         "\"vehicle.status.armed\", for: 30 s}]}\n"
         "  again:   {}\n";
}

TEST_CASE("a sensor that fails and recovers is accepted again: the estimate returns to its error of before") {
  const test::OwnStore folder;
  const fs::path file = folder.path / "recovers.yaml";
  std::ofstream(file) << recovers();
  const Graph graph = load_mission(file.string(), {});
  Flight flight(graph, test::unlogged());
  const Source truth = output_of(graph, "sim", "truth"), state = output_of(graph, "ekf", "state");
  double off_m = 0, after_m = 0;
  bool admitted = false, valid = false;
  while (flight.step()) {
    const auto* const x = reinterpret_cast<const fulmar::VehicleState*>(flight.sample(truth));
    const auto* const s = reinterpret_cast<const fulmar::VehicleState*>(flight.sample(state));
    if (!x || !s) continue;
    const double error_m =
        std::hypot(s->position_m.north - x->position_m.north, s->position_m.east - x->position_m.east);
    if (flight.phase() == "failing") {
      off_m = std::max(off_m, error_m);
      admitted = admitted || !s->position_valid;
    }
    if (flight.phase() == "again") {
      after_m = error_m;
      valid = s->position_valid;
    }
  }
  flight.finish();
  CHECK(off_m > 10);
  CHECK(admitted);
  CHECK(valid);
  CHECK(after_m < 3);
}

/// The barometer sticks until the navigation filter reports it, and the mission continues when the filter
/// accepts it again.
std::string looks_at_health() {
  return "mission: looks_at_health\nextends: " FULMAR_SOURCE_DIR
         "/configs/missions/hourglass.yaml\nlive: off\n"
         "done: {when: \"vehicle.status.armed\", for: 60 s}\nphases:\n"
         "  cruise:  {next: [{to: failing, when: \"vehicle.status.armed\", for: 20 s}]}\n"
         "  failing: {vehicle: {set: {baro_fault: stuck}}, next: [{to: told, when: "
         "\"nav.health.baro.state == stuck\"}]}\n"
         "  told:    {next: [{to: again, when: \"nav.health.baro.state == ok\"}]}\n"
         "  again:   {}\n";
}

TEST_CASE("a mission reads the navigation filter's health of a sensor") {
  const test::OwnStore folder;
  const fs::path file = folder.path / "looks_at_health.yaml";
  std::ofstream(file) << looks_at_health();
  const Graph graph = load_mission(file.string(), {});
  Flight flight(graph, test::unlogged());
  int failing = 0, reported = 0, again = 0;  // ticks at 400 Hz
  while (flight.step()) {
    failing += flight.phase() == "failing";
    reported += flight.phase() == "told";
    again += flight.phase() == "again";
  }
  flight.finish();
  CHECK(failing > 0.45 * 400);
  CHECK(failing < 0.8 * 400);
  CHECK(reported > 0);
  CHECK(reported < 0.4 * 400);
  CHECK(again > 10 * 400);
}

/// The barometer is stuck in one phase, the pitot tube noisy in the next one.
std::string scheduled() {
  return "mission: scheduled\nextends: " FULMAR_SOURCE_DIR
         "/configs/missions/hourglass.yaml\nlive: off\n"
         "done: {when: \"vehicle.status.armed\", for: 40 s}\nphases:\n"
         "  cruise: {next: [{to: stuck, when: \"vehicle.status.armed\", for: 3 s}]}\n"
         "  stuck:  {vehicle: {set: {baro_fault: stuck}}, next: [{to: noisy, when: \"vehicle.status.armed\", "
         "for: 5 s}]}\n"
         "  noisy:  {vehicle: {set: {pitot_fault: noisy, gyro_fault: jumping, fault_time: 0.5 s}}}\n";
}

TEST_CASE("a failure starts and ends with the phases, and each log replays byte for byte") {
  const test::OwnStore folder;
  const fs::path file = folder.path / "scheduled.yaml";
  std::ofstream(file) << scheduled();
  std::vector<std::string> sha;
  for (const char* name : {"one.mcap", "two.mcap"}) {
    FlightOptions o;
    o.log_file = folder.path / name;
    const Graph graph = load_mission(file.string(), {});
    Flight flight(graph, o);
    const Source baro = output_of(graph, "sim", "baro");
    double last = 0;
    int equal = 0, different = 0, in_order = 0;
    while (flight.step()) {
      const auto* const pressure = reinterpret_cast<const double*>(flight.sample(baro));
      if (!pressure) continue;
      const bool same = *pressure == last;
      last = *pressure;
      if (flight.phase() == "stuck") (same ? equal : different) += 1;
      if (flight.phase() == "noisy") in_order += !same;
    }
    CHECK(equal > 1990);  // of 2000 ticks
    CHECK(different <= 2);
    CHECK(in_order > 1000);
    sha.push_back(flight.finish().log.sha256);
    const Recording recording(o.log_file);
    const auto [again, replayed] =
        replay(recording, recording.mission({}, [](const std::string&, bool) {}), {});
    CHECK(replayed.equal());
  }
  CHECK(sha[0] == sha[1]);
}

TEST_CASE("a failure that is requested in flight is answered, logged after all other topics, and replayed") {
  const test::OwnStore folder;
  Overrides overrides;
  overrides.set = {{"sim.start_height", "70 m"}};
  const Graph graph = load_mission(FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml", overrides);
  FlightOptions o;
  o.log_file = folder.path / "asked.mcap";
  o.duration_s = 8;
  Flight flight(graph, o);
  std::vector<std::string> answers;
  const auto ask = [&](fulmar::FaultTarget what, fulmar::FaultKind kind) {
    request(flight, "sim", "fault", fulmar::FaultRequest{what, kind},
            [&](const std::string& a) { answers.push_back(a); });
  };
  for (int tick = 0; flight.step(); ++tick)
    if (tick == 2400) {
      ask(fulmar::FaultTarget::pitot, fulmar::FaultKind::stuck);
      ask(fulmar::FaultTarget::pitot, fulmar::FaultKind::lost);
    }
  flight.finish();
  REQUIRE(answers.size() == 2);
  CHECK(answers[0] == "");
  CHECK(answers[1] == "sim_aero.fault_unknown(pitot, lost, none, off, stuck, wrong, slow, noisy, jumping)");
  // The hashes of the ticks use the numbers of the topics, so existing topics keep their numbers. Events for
  // viewers are in no hash, and last.
  const WholeLog file = read_mcap(o.log_file);
  const auto last = file.channel("/rosout");
  CHECK(last > file.channel("/sim/fault"));
  for (const auto& [id, channel] : file.channels) CHECK((id <= file.channel("/sim/fault") || id == last));
  const Recording recording(o.log_file);
  CHECK(replay(recording, recording.mission({}, [](const std::string&, bool) {}), {}).second.equal());
}

}  // namespace faults_test
