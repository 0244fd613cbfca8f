// SPDX-License-Identifier: BSD-3-Clause
// From take-off to landing: the shipped mission in several winds, judged by the simulated truth.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/app/test/fault_campaign.hpp"
#include "core/run/component/allocation.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/landing_progress.hpp"

using namespace fulmar::core;

namespace landing_test {

namespace {

struct Touch {
  bool stopped = false;
  double sink_mps = 0, nose_rad = 0, cross_m = 1e9, along_m = 1e9, slowest_mps = 1e9;
  unsigned go_arounds = 0;
};

Touch landed(double wind_mps, double from_deg, std::uint64_t seed, const std::string& sensors) {
  Overrides overrides;
  const double to_rad = (from_deg + 180) * std::acos(-1.0) / 180;
  overrides.seed = seed;
  overrides.set = {{"sim.sensors", sensors},
                   {"sim.wind_ned", "[" + std::to_string(wind_mps * std::cos(to_rad)) + ", " +
                                        std::to_string(wind_mps * std::sin(to_rad)) + ", 0]"}};
  const Graph graph = load_mission(FULMAR_SOURCE_DIR "/configs/missions/runway_to_runway.yaml", overrides);
  FlightOptions options;
  options.log = false;
  Flight flight(graph, options);
  const Source truth = output_of(graph, "sim", "truth"), progress = output_of(graph, "land", "progress");
  Touch t;
  double sink = 0;
  while (flight.step()) {
    const auto* const x = reinterpret_cast<const fulmar::VehicleState*>(flight.sample(truth));
    const auto* const p = reinterpret_cast<const fulmar::LandingProgress*>(flight.sample(progress));
    if (!x || !p || flight.phase() == "hold" || flight.phase() == "takeoff") continue;
    t.go_arounds = p->go_arounds;
    if (p->stage < fulmar::LandingStage::roll_out) {
      sink = -x->climb_rate_mps;
      if (flight.phase() == "approach") t.slowest_mps = std::min(t.slowest_mps, x->airspeed_mps);
    } else if (t.cross_m == 1e9) {  // the runway begins at the origin, to the south-east
      const double c = std::sqrt(0.5), n = x->position_m.north, e = x->position_m.east;
      t.along_m = -c * n + c * e;
      t.cross_m = -c * n - c * e;
      t.sink_mps = sink;
      t.nose_rad = std::abs(x->yaw_rad - 135 * std::acos(-1.0) / 180);
    }
  }
  const FlightResult result = flight.finish();
  t.stopped = result.outcome == Outcome::flown && result.guards.empty();
  return t;
}

}  // namespace

TEST_CASE("it takes off, flies its circuit and lands on the runway, with headwind and crosswind") {
  const struct {
    double wind_mps, from_deg;
    const char* sensors;
  } winds[] = {{0, 135, "rosflight"}, {5, 150, "ublox"}, {8, 110, "rosflight"}, {10, 135, "ublox"}};
  std::uint64_t seed = 0;
  for (const auto& w : winds) {
    CAPTURE(w.wind_mps);
    const Touch t = landed(w.wind_mps, w.from_deg, ++seed, w.sensors);
    CHECK(t.stopped);
    CHECK(t.sink_mps < 1.5);
    CHECK(std::abs(t.cross_m) < 5 + 3);  // 5 m and the error of the receiver
    CHECK(t.along_m > -30);
    CHECK(t.along_m < 200);
    CHECK(t.nose_rad < 0.12);          // of a crab angle of 0.3 rad at most
    CHECK(t.slowest_mps > 11);         // 1.1 times the stall
    if (!counts_allocations()) break;  // under the sanitizers a flight takes twenty times as long
  }
}

TEST_CASE("an approach that the wind limits reject for three minutes is flown anyway, with a warning") {
  Overrides overrides;
  overrides.set = {{"sim.wind_ned", "[6.36, 6.36, 0]"}};  // 9 m/s across the runway
  const Graph graph = load_mission(FULMAR_SOURCE_DIR "/configs/missions/runway_to_runway.yaml", overrides);
  FlightOptions options;
  options.log = false;
  const FlightResult result = Flight(graph, options).run();
  CHECK(result.outcome == Outcome::flown);
  const auto& p = result.phases;
  const auto at = std::find_if(p.begin(), p.end(), [](const auto& v) { return v.name == "approach"; });
  REQUIRE(at != p.end());
  CHECK(at->to_ns - at->from_ns >= 180'000'000'000);
  CHECK(std::next(at)->name == "flare");
  CHECK(p.back().name == "roll_out");
}

namespace {

struct Thrown {
  bool stopped = false, crashed = false;
  double lowest_m = 1e9, motor_s = 1e9, max_bank_rad = 0;  ///< motor_s: after the release
  bool motor_at_end = false;
};

Thrown thrown(const std::vector<std::pair<std::string, std::string>>& set, double for_s) {
  Overrides overrides;
  overrides.set = set;
  const Graph graph = load_mission(FULMAR_SOURCE_DIR "/configs/missions/hand_launch.yaml", overrides);
  FlightOptions options;
  options.log = false;
  options.duration_s = for_s;
  Flight flight(graph, options);
  const Source truth = output_of(graph, "sim", "truth"), contact = output_of(graph, "sim", "contact"),
               actuators = output_of(graph, "attitude", "actuators");
  Thrown t;
  double free_s = -1;
  while (flight.step()) {
    const auto* const x = reinterpret_cast<const fulmar::VehicleState*>(flight.sample(truth));
    const auto* const s = reinterpret_cast<const fulmar::ContactTruth*>(flight.sample(contact));
    const auto* const u = reinterpret_cast<const fulmar::Actuators*>(flight.sample(actuators));
    const double now_s = 1e-9 * static_cast<double>(flight.now_ns());
    if (!x || !s || !u || now_s < 0) continue;
    if (free_s < 0 && !s->touching) free_s = now_s;
    if (u->throttle_frac > 0.05 && t.motor_s == 1e9) t.motor_s = free_s < 0 ? -1 : now_s - free_s;
    t.motor_at_end = u->throttle_frac > 0;
    t.crashed = t.crashed || s->crashed;
    if (free_s < 0 || flight.phase() != "takeoff") continue;
    t.lowest_m = std::min(t.lowest_m, x->height_m);
    t.max_bank_rad = std::max(t.max_bank_rad, std::abs(x->roll_rad));
  }
  const FlightResult result = flight.finish();
  t.crashed = result.outcome != Outcome::flown;
  t.stopped = flight.phase() == "roll_out";
  return t;
}

}  // namespace

TEST_CASE(
    "thrown by hand and off a catapult it climbs away, wings level, the motor after the hand, and lands") {
  using Set = std::vector<std::pair<std::string, std::string>>;
  const std::vector<Set> launches = {
      Set{{"sim.launch_speed", "9"}, {"sim.wind_ned", "[0, 0, 0]"}},
      Set{{"sim.wind_ned", "[5.66, -5.66, 0]"}},  // 8 m/s headwind
      Set{{"sim.launch", "catapult"}, {"slc.launch_delay", "0.6"}, {"sim.launch_speed", "16"}},
      Set{{"sim.launch_after", "240"}}};
  for (const auto& set : launches) {
    CAPTURE(set[0].second);
    const Thrown t = thrown(set, 500);
    CHECK(t.stopped);
    CHECK_FALSE(t.crashed);
    CHECK(t.lowest_m > 0.7);  // released at 2 m, in calm air below its stall speed
    CHECK(t.motor_s > 0.2);
    CHECK(t.motor_s < 1);
    CHECK(t.max_bank_rad < 0.2);
    if (!counts_allocations()) break;
  }
}

TEST_CASE("launched by hand with a dead motor it lands ahead, undamaged, and stops the motor") {
  for (const char* speed : {"9", "11", "14"}) {
    CAPTURE(speed);
    const Thrown t = thrown({{"sim.motor", "false"}, {"sim.launch_speed", speed}}, 30);
    CHECK_FALSE(t.crashed);
    CHECK(t.max_bank_rad < 0.2);
    CHECK_FALSE(t.motor_at_end);
  }
}

TEST_CASE("a landing without a runway, in it or in its plan, and a short one are rejected by file and line") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("landing_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto refusal = [&](const std::string& params, const std::string& runway) {
    std::ofstream(folder / "plan.yaml") << "airspeed: 17 m/s\nwaypoints:\n  - {north: 400 m, east: 0 m, up: "
                                           "70 m}\n  - {north: -400 m, east: 0 "
                                           "m, up: 70 m}\n"
                                        << runway;
    std::ofstream(folder / "land.yaml")
        << "mission: land\nextends: " FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml\ncomponents:\n"
        << "  plan: {params: {plan: plan.yaml}}\n  land: {fills: guide, use: path/Landing, rate: 100 Hz"
        << params << "}\nphases:\n  cruise: {guide: land}\n";
    try {
      FlightOptions options;
      options.log = false;
      const Graph graph = load_mission((folder / "land.yaml").string(), {});
      Flight flight(graph, options);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string("flies");
  };
  const auto reported = [](const std::string& all, const char* some) {
    return all.find(some) != std::string::npos;
  };
  std::string of = refusal("", "");
  CHECK_MESSAGE(reported(of, "land.yaml:5"), of);
  CHECK_MESSAGE(reported(of, "path.runway_missing"), of);
  of = refusal(", params: {plan: plan.yaml}", "");
  CHECK_MESSAGE(reported(of, "plan.yaml:1"), of);
  CHECK_MESSAGE(reported(of, "path.runway_missing"), of);
  const std::string here = "runway: {north: 0 m, east: 0 m, up: 0 m, heading: 135 deg, ";
  of = refusal(", params: {plan: plan.yaml}", here + "length: 150 m}\n");
  CHECK_MESSAGE(reported(of, "plan.yaml:5"), of);
  CHECK_MESSAGE(reported(of, "path.runway_too_short(150, "), of);
  of = refusal(", params: {plan: plan.yaml}", here + "length: 300 m, lat: 40.2 deg}\n");
  CHECK_MESSAGE(reported(of, "path.runway_place_ambiguous"), of);
  of = refusal(", params: {plan: plan.yaml}", "runway: {north: 0 m, east: 0 m, up: 0 m, heading: 135 deg}\n");
  CHECK_MESSAGE(reported(of, "plan.yaml:5"), of);
  CHECK_MESSAGE(reported(of, "path.runway_length_missing"), of);
  of = refusal(", params: {plan: plan.yaml}", here + "length: 300 m}\n");
  CHECK_MESSAGE(of == "flies", of);
  of = refusal(
      ", params: {plan: plan.yaml}",
      "runway: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m, heading: 135 deg, length: 300 m}\n");
  CHECK_MESSAGE(of == "flies", of);
  std::filesystem::remove_all(folder);
}

}  // namespace landing_test
