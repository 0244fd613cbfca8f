// SPDX-License-Identifier: BSD-3-Clause
// Every shipped scheme hands over to every other one that fills its role, in a climbing and in a sinking
// turn. The steps of the surfaces are within the limits of docs/loop.md.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/app/test/fault_campaign.hpp"
#include "core/run/component/allocation.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/guidance_command.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace schemes_test {

namespace {

struct Scheme {
  const char *name, *phase;  ///< roles of the phase
};
const std::vector<Scheme> outer{{"slc", "outer: slc"},       {"tecs", "outer: tecs"},
                                {"errors", "outer: errors"}, {"held", "outer: held"},
                                {"speed", "outer: speed"},   {"lqr", "outer: lqr, inner: lqr"}};
const std::vector<Scheme> inner{
    {"attitude", "outer: slc"},
    {"indi", "outer: slc, inner: indi"},
    {"rates", "outer: {use: held, set: {roll: flown, pitch: flown}}, inner: stick"},
    {"surfaces",
     "outer: {use: held, set: {roll: flown, pitch: flown}}, inner: {use: stick, set: {aileron: surface, "
     "elevator: "
     "surface, rudder: surface}}"},
    {"angles",
     "outer: slc, inner: {use: stick, set: {aileron: attitude, elevator: attitude, throttle: automatic}}"},
    {"whole", "outer: lqr, inner: lqr"}};

/// A helix to `height_m`, in the wind and light turbulence; one phase per scheme.
Graph mission(const std::vector<Scheme>& schemes, const char* turn, double height_m, double airspeed_mps,
              double stick) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs/", test = FULMAR_TEST_PLUGIN_DIR;
  const fs::path file = fs::temp_directory_path() / ("fulmar-schemes-" + std::to_string(getpid()) + ".yaml");
  std::ofstream text(file);
  text << "mission: schemes\nextends: " << configs
       << "missions/common.yaml\nlive: null\nairframe: " << configs
       << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
       << "components:\n"
       << "  sim: {params: {sensors: rosflight, turbulence: light, wind_ned: [3.5355, -3.5355, 0], "
          "start_height: "
          "300 m, start_heading: 135 deg, stick_roll: "
       << stick << ", stick_pitch: 0.1, stick_throttle: 0.7}}\n"
       << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n"
       << "  round: {fills: guide, use: path/Loiter, rate: 100 Hz, params: {turn: " << turn
       << ", height: " << height_m << ", airspeed: " << airspeed_mps << "}}\n"
       << "  errors: {fills: outer, use: control_tecs/ErrorLaw, rate: 100 Hz}\n"
       << "  level: {use: control_slc/Outer, rate: 100 Hz, in: {state: nav.state, command: guide.command}}\n"
       << "  held: {fills: outer, use: control_manual/Outer, rate: 100 Hz, in: {rc: vehicle.rc, automatic: "
          "level.attitude}}\n"
       << "  speed: {fills: outer, use: control_slc/Airspeed, rate: 100 Hz, in: {wanted: level.attitude}}\n"
       << "  stick: {fills: inner, use: control_manual/Inner, rate: 100 Hz, in: {rc: vehicle.rc}}\n"
       << "  indi: {fills: inner, use: " << test << "/indi.so, rate: 200 Hz}\n"
       << "  lqr: {fills: [outer, inner], use: " << test << "/lqr.so, rate: 100 Hz}\n"
       << "phases:\n  hold: null\n  takeoff: null\n  cruise: {guide: round, outer: slc, next: [";
  for (const Scheme& s : schemes)
    text << (&s == &schemes[0] ? "" : ", ") << "{to: " << s.name << ", when: \"time > 1e6 s\"}";
  text << "]}\n";
  for (const Scheme& s : schemes) text << "  " << s.name << ": {guide: round, " << s.phase << "}\n";
  text.close();
  Graph graph = load_mission(file.string());
  fs::remove(file);
  return graph;
}

/// Largest changes of a surface, rad, and of the throttle from tick to tick.
struct Moved {
  double surface_rad = 0, throttle_frac = 0;
  void add(const fulmar::Actuators& from, const fulmar::Actuators& to) {
    surface_rad =
        std::max({surface_rad, std::abs(to.aileron_rad - from.aileron_rad),
                  std::abs(to.elevator_rad - from.elevator_rad), std::abs(to.rudder_rad - from.rudder_rad)});
    throttle_frac = std::max(throttle_frac, std::abs(to.throttle_frac - from.throttle_frac));
  }
};

class Trial {
 public:
  explicit Trial(const Graph& graph) : flight_(graph, options()) {
    for (std::size_t i = 0; i < graph.roles.size(); ++i)
      for (std::size_t k = 0; k < graph.roles[i].outputs.size(); ++k)
        if (graph.roles[i].name == "inner" && graph.roles[i].outputs[k].name == "actuators")
          actuators_ = {Source::Kind::role, static_cast<int>(i), static_cast<int>(k)};
  }
  Moved fly(double for_s) {
    Moved most;
    const std::int64_t until = flight_.now_ns() + std::llround(for_s * 1e9);
    while (flight_.now_ns() < until) {
      REQUIRE(flight_.step());
      const auto* const u = reinterpret_cast<const fulmar::Actuators*>(flight_.sample(actuators_));
      if (!u) continue;
      if (known_) most.add(last_, *u);
      last_ = *u;
      known_ = true;
    }
    return most;
  }
  /// In the tick of the hand-over and 0.3 s after it.
  Moved hand_over(const char* to) {
    enter_phase(flight_, to);
    return fly(0.3);
  }
  FlightResult finish() { return flight_.finish(); }

 private:
  static FlightOptions options() {
    FlightOptions o;
    o.log = false;
    return o;
  }
  Flight flight_;
  Source actuators_;
  fulmar::Actuators last_;
  bool known_ = false;
};

/// Each of `n` to each other one, and back.
std::vector<std::size_t> all_pairs(std::size_t n) {
  std::vector<std::size_t> way;
  for (std::size_t i = 0; i < n; ++i) {
    way.push_back(i);
    for (std::size_t j = i + 1; j < n; ++j) {
      way.push_back(j);
      way.push_back(i);
    }
  }
  return way;
}

// Limits of docs/loop.md; the second where the attitude command stays the same.
constexpr double most_rad = 0.08, same_attitude_rad = 0.02, max_throttle_frac = 0.05;

bool attitude_of_slc(const Scheme& s) { return std::string(s.phase).find("outer: slc") == 0; }

/// The largest steps of a flight in which each scheme hands over to each other one.
Moved flown(const std::vector<Scheme>& schemes, const Graph& graph) {
  Moved worst;
  Trial trial(graph);
  trial.fly(20);
  const std::vector<std::size_t> way = all_pairs(schemes.size());
  for (std::size_t k = 0; k < way.size(); ++k) {
    const Scheme &to = schemes[way[k]], &from = schemes[way[k > 0 ? k - 1 : 0]];
    const std::string hand_over = std::string(from.name) + " to " + to.name;
    CAPTURE(hand_over);
    const Moved m = trial.hand_over(to.name);
    const bool same = &schemes == &inner && attitude_of_slc(from) && attitude_of_slc(to);
    CHECK(m.surface_rad < (same ? same_attitude_rad : most_rad));
    CHECK(m.throttle_frac < max_throttle_frac);
    worst.surface_rad = std::max(worst.surface_rad, m.surface_rad);
    worst.throttle_frac = std::max(worst.throttle_frac, m.throttle_frac);
    trial.fly(3);
  }
  CHECK(trial.finish().guards.empty());
  return worst;
}

}  // namespace

TEST_CASE(
    "every shipped scheme hands over to every other one, in a climbing and a sinking turn, without a step") {
  for (const auto* schemes : {&outer, &inner})
    for (const double stick : {0.75, -0.2})
      for (const bool climbs : {true, false}) {
        CAPTURE(stick);
        CAPTURE(climbs);
        const Graph graph =
            climbs ? mission(*schemes, "left", 2000, 17, -stick) : mission(*schemes, "right", 10, 21, stick);
        const Moved worst = flown(*schemes, graph);
        MESSAGE((schemes == &outer ? "outer" : "inner") << ", stick " << stick << ": " << worst.surface_rad
                                                        << " rad, throttle " << worst.throttle_frac);
        if (!counts_allocations()) return;  // under the sanitizers a flight takes twenty times as long
      }
}

TEST_CASE("the total energy law of errors flies Aerosonde and X8 with the gains of their airframe files") {
  const struct {
    const char* airframe;
    double airspeed_mps, height_rms_m, airspeed_rms_mps;
  } aircraft[] = {{"aerosonde", 25, 0.9, 0.45},
                  {"x8", 18, 1.6, 0.8}};  // 0.68 m and 0.31 m/s, 1.2 m and 0.54 m/s
  for (const auto& craft : aircraft) {
    CAPTURE(craft.airframe);
    const std::string configs = FULMAR_SOURCE_DIR "/configs/";
    const fs::path file = fs::temp_directory_path() / ("fulmar-errors-" + std::to_string(getpid()) + ".yaml");
    std::ofstream(file)
        << "mission: errors\nextends: " << configs
        << "missions/common.yaml\nlive: null\nairframe: " << configs << "airframes/" << craft.airframe
        << ".yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 1\ncomponents:\n"
        << "  sim: {params: {sensors: rosflight, start_height: 100 m, start_heading: 135 deg, wind_ned: "
           "[3.5355, "
           "-3.5355, 0], turbulence: light}}\n"
        << "  errors: {fills: outer, use: control_tecs/ErrorLaw, rate: 100 Hz}\n"
        << "  plan: {params: {plan: {airspeed: " << craft.airspeed_mps
        << " m/s, turn_radius: 110 m, waypoints: [{north: 700 m, east: -400 m, up: 100 m}, {north: -500 m, "
           "east: "
           "-400 m, up: 120 m}, {north: -500 m, east: 200 m, up: 120 m}, {north: 700 m, east: 200 m, up: 100 "
           "m}]}}}\n"
        << "phases:\n  cruise: {outer: errors}\n";
    const Graph graph = load_mission(file.string());
    fs::remove(file);
    FlightOptions options;
    options.log = false;
    options.duration_s = 180;
    Flight flight(graph, options);
    const Source truth = output_of(graph, "sim", "truth"), command = output_of(graph, "follow", "command");
    double height2 = 0, airspeed2 = 0, n = 0;
    while (flight.step()) {
      const auto* const x = reinterpret_cast<const fulmar::VehicleState*>(flight.sample(truth));
      const auto* const c = reinterpret_cast<const fulmar::GuidanceCommand*>(flight.sample(command));
      if (!x || !c || flight.now_ns() < 30'000'000'000) continue;
      height2 += std::pow(x->height_m - c->height_m, 2);
      airspeed2 += std::pow(x->airspeed_mps - c->airspeed_mps, 2);
      ++n;
    }
    CHECK(flight.finish().guards.empty());
    CHECK(std::sqrt(height2 / n) < craft.height_rms_m);
    CHECK(std::sqrt(airspeed2 / n) < craft.airspeed_rms_mps);
    MESSAGE(craft.airframe << ": " << std::sqrt(height2 / n) << " m, " << std::sqrt(airspeed2 / n) << " m/s");
    if (!counts_allocations()) return;
  }
}

}  // namespace schemes_test
