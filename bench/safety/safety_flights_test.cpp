// SPDX-License-Identifier: BSD-3-Clause
// One flight of each row of bench_safety, and what it promises of it.
#include <doctest/doctest.h>

#include "bench/safety/flight.hpp"
#include "core/run/component/allocation.hpp"

namespace safety_flights_test {

using namespace fulmar::safety_flights;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-safety-test-" + std::to_string(getpid()));
  Folder() {
    fs::create_directories(path);
    setenv("FULMAR_STORE", (path / "store").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path); }
};

/// Flies the mission of `text` and returns the alarms of the monitor `watch`.
std::string raised(const fs::path& folder, const std::string& text) {
  using namespace fulmar::core;
  using fulmar::SafetyState;
  const fs::path file = folder / "watched.yaml";
  std::ofstream(file) << "live: off\n" << text;
  FlightOptions options;
  options.log = false;
  const Graph graph = load_mission(file.string(), {});
  Flight flight(graph, options);
  const Source watch = output_of(graph, "watch", "safety");
  SafetyState all;
  unsigned airborne = 0;
  while (flight.step()) {
    const auto* const s = reinterpret_cast<const SafetyState*>(flight.sample(watch));
    if (!s) continue;
    airborne += s->airborne;
    for (bool SafetyState::*flag :
         {&SafetyState::fence, &SafetyState::gnss_lost, &SafetyState::pitot_lost, &SafetyState::radio_lost,
          &SafetyState::link_lost, &SafetyState::battery_low, &SafetyState::attitude_excessive,
          &SafetyState::engine_failed, &SafetyState::wind_excessive, &SafetyState::estimator_failed})
      all.*flag = all.*flag || s->*flag;
  }
  const FlightResult result = flight.finish();
  std::string words =
      result.outcome == Outcome::flown && airborne > 1000 ? "" : "not flown: " + result.reason + " ";
  if (all.fence) words += "fence ";
  if (all.engine_failed) words += "engine ";
  if (all.gnss_lost || all.pitot_lost || all.radio_lost || all.link_lost || all.battery_low ||
      all.attitude_excessive || all.wind_excessive || all.estimator_failed)
    words += "others ";
  return words;
}

const std::string wires =
    "in: {state: nav.state, status: vehicle.status, health: nav.health, rc: vehicle.rc, actuators: "
    "inner.actuators}";

}  // namespace

TEST_CASE(
    "the shipped missions raise no alarm, take-off, climbs and landing included, in moderate turbulence") {
  const Folder folder;
  for (const char* mission : {"runway_to_runway", "two_schemes", "orbit"}) {
    CAPTURE(mission);
    const std::string watched = std::string("extends: " FULMAR_SOURCE_DIR "/configs/missions/") + mission +
                                ".yaml\ncomponents:\n  sim: {params: {turbulence: moderate}}\n  watch: {use: "
                                "safety/Monitor, rate: 100 Hz, " +
                                wires + "}\n";
    CHECK(raised(folder.path, watched) == "");
    if (!fulmar::core::counts_allocations()) return;
  }
}

TEST_CASE("a fence 60 m round the hourglass is not told in still air, and one 20 m round it is") {
  const Folder folder;
  const auto hourglass = [&](int room) {
    const auto north = std::to_string(400 + room), west = std::to_string(-250 - room),
               east = std::to_string(-50 + room);
    return raised(
        folder.path,
        "extends: " FULMAR_SOURCE_DIR
        "/configs/missions/hourglass.yaml\ndone: \"manage.progress.circuits >= "
        "1\"\ncomponents:\n  sim: {params: {wind_ned: [0, 0, 0], turbulence: none, start_height: 70 m, "
        "start_north: 400, start_east: -50, start_heading: -90 deg}}\n  watch: {use: safety/Monitor, rate: "
        "100 Hz, " +
            wires + ", params: {places: {places: [{north: 0 m, east: -150 m}]}, fence: {corners: [{north: " +
            north + " m, east: " + west + " m}, {north: " + north + " m, east: " + east + " m}, {north: -" +
            north + " m, east: " + east + " m}, {north: -" + north + " m, east: " + west + " m}]}}}\n");
  };
  CHECK(hourglass(60) == "");
  CHECK(hourglass(20) == "fence ");
}

TEST_CASE("whatever fails is told in time, answered as the table says, and ends on the ground, whole") {
  const Folder folder;
  for (const char* airframe : {"anaconda", "aerosonde"})
    for (const Row& row : rows_of(airframe)) {
      CAPTURE(airframe);
      CAPTURE(row.name);
      const Flown f = fly(row, 3, folder.path);
      CAPTURE(f.outcome);
      CHECK(f.end == row.end);
      CHECK(f.in_order);
      CHECK(f.touch_sink_mps < 3);
      CHECK(f.kept(row));
      if (row.cause) {
        CHECK((f.reported_s >= 0 || row.may_be_reported));
        CHECK(f.reported_s <= row.reported_within_s);
        CHECK_FALSE((row.at_s > 0 && f.reported_else));
      } else {
        CHECK_FALSE(f.reported_else);
      }
      if (!fulmar::core::counts_allocations())
        return;  // under the sanitizers a flight takes twenty times as long
    }
}

}  // namespace safety_flights_test
