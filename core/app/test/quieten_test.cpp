// SPDX-License-Identifier: BSD-3-Clause
// The hourglass on servos so slow that three times the gain of an axis oscillates: the gain is reduced within
// 2 s, and reported. With the normal gains it is never reduced, not even in moderate turbulence.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>

#include "core/run/flight.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

const std::string configs = std::string(FULMAR_SOURCE_DIR) + "/configs/";

struct Case {
  std::string airframe, nav, surface, gains;
};

/// 60 s into the flight, all gains of one axis are three times as high. The sides of the Aerosonde's plan fit
/// its speed.
Graph mission(const Case& c, bool quieten) {
  const fs::path file = fs::temp_directory_path() / ("fulmar-quieten-" + std::to_string(getpid()) + ".yaml");
  std::ofstream out(file);
  out << "mission: quieten\nextends: " << configs
      << "missions/hourglass.yaml\nlive: off\nairframe: " << configs << "airframes/" << c.airframe
      << ".yaml\ndone: \"time > 100 s\"\ncomponents:\n";
  out << "  plan: {params: {plan: {name: straight, end: orbit, airspeed: "
      << (c.airframe == "anaconda" ? 17 : 25)
      << " m/s, turn_radius: 120 m, waypoints: [{north: -200 m, east: 200 m, up: 90 m}, {north: -6000 m, "
         "east: 6000 m, up: 90 m}]}}}\n";
  out << "  attitude: {params: {quieten: " << (quieten ? "true" : "false") << "}}\nphases:\n"
      << "  cruise: {outer: slc, next: [{to: loud, when: \"time > 60 s\"}]}\n"
      << "  loud: {outer: slc, inner: {use: attitude, set: {" << c.gains << "}}}\n";
  out.close();
  Overrides o;
  o.roles = {{"nav", c.nav}};
  for (const char* s : {"aileron", "elevator", "rudder"}) {
    o.set.emplace_back(std::string("sim.airframe.") + s + ".natural_frequency",
                       c.surface == "aileron_rad" ? "20 rad/s" : "25 rad/s");
    o.set.emplace_back(std::string("sim.airframe.") + s + ".damping", "0.7");
  }
  Graph graph = load_mission(file.string(), o);
  fs::remove(file);
  return graph;
}

struct Flown {
  bool flown = false;
  double from_s = -1,
         last_s = -1;  ///< time at which the surface moves faster than 2 rad/s, root mean square over 0.3 s
  double reported_s = -1;
  std::string reported;
};

Flown fly(const Graph& graph, const std::string& surface) {
  Flown flown;
  FlightOptions options;
  options.log = false;
  double now_s = 0;
  options.say = [&](const std::string& words, bool) {
    if (words.find("oscillates") == std::string::npos || now_s < 60) return;
    if (flown.reported_s < 0) flown.reported_s = now_s;
    flown.reported += words + "\n";
  };
  Flight flight(graph, options);
  const auto named = std::find_if(graph.components.begin(), graph.components.end(),
                                  [](const Component& c) { return c.name == "attitude"; });
  const int inner = static_cast<int>(named - graph.components.begin());
  const int output = graph.components[static_cast<std::size_t>(inner)].info().output("actuators");
  const Type& type = *graph.components[static_cast<std::size_t>(inner)]
                          .info()
                          .outputs[static_cast<std::size_t>(output)]
                          .type;
  const std::uint32_t at = resolve_field(type, surface).offset;
  std::deque<double> squares;
  double before = 0, sum = 0;
  do {
    now_s = 1e-9 * static_cast<double>(flight.now_ns());
    const std::byte* message = flight.sample({Source::Kind::component, inner, output});
    if (!message || now_s < 50) continue;
    double u = 0;
    std::memcpy(&u, message + at, sizeof u);
    const double rate = (u - before) * 400;  // steps of 100 Hz, sampled 400 times a second
    before = u;
    squares.push_back(rate * rate / 4);
    sum += squares.back();
    if (squares.size() > 120) {
      sum -= squares.front();
      squares.pop_front();
    }
    if (now_s < 51 || sum / 120 < 2 * 2) continue;
    if (flown.from_s < 0) flown.from_s = now_s;
    flown.last_s = now_s;
  } while (flight.step());
  flown.flown = flight.finish().outcome == Outcome::flown;
  return flown;
}

}  // namespace

TEST_CASE("three times the gain on slow servos oscillates; it is quiet within 2 s of that, and reported") {
  const std::string roll = "roll_kp: 3.6, roll_ki: 0.3, roll_kd: 0.06";
  for (const std::string nav : {"truth", "ekf"})
    for (const Case& c :
         {Case{"anaconda", nav, "aileron_rad", roll},
          Case{"anaconda", nav, "elevator_rad", "pitch_kp: 12, pitch_ki: 6, pitch_kd: 0.84"},
          Case{"aerosonde", nav, "aileron_rad", roll},
          Case{"aerosonde", nav, "elevator_rad", "pitch_kp: 12, pitch_ki: 6, pitch_kd: 1.5"}}) {
      CAPTURE(c.airframe);
      CAPTURE(c.nav);
      CAPTURE(c.surface);
      const Flown loud = fly(mission(c, false), c.surface), quiet = fly(mission(c, true), c.surface);
      CHECK(loud.from_s > 60);
      CHECK(loud.last_s > 95);  // to the end
      CHECK(loud.reported == "");
      CHECK(quiet.flown);
      CHECK(quiet.from_s > 60);
      CHECK(quiet.last_s < quiet.from_s + 2);
      CHECK(quiet.reported_s < quiet.from_s + 2);
      CHECK(quiet.reported_s > 0);
      CHECK(quiet.reported.find(c.surface == "aileron_rad" ? "axis_oscillates(roll"
                                                           : "axis_oscillates(pitch") != std::string::npos);
    }
}

TEST_CASE("in moderate turbulence nothing is taken for an oscillation" * doctest::test_suite("amounts")) {
  for (int seed = 1; seed <= 10; ++seed) {
    Overrides o;
    o.seed = static_cast<std::uint64_t>(seed);
    o.set = {{"sim.turbulence", "moderate"}};
    const Graph graph = load_mission(configs + "missions/hourglass.yaml", o);
    FlightOptions options;
    options.log = false;
    std::string reported;
    options.say = [&](const std::string& words, bool) {
      if (words.find("oscillates") != std::string::npos) reported += words;
    };
    Flight flight(graph, options);
    CHECK(flight.run().outcome == Outcome::flown);
    CHECK(reported == "");
  }
}
