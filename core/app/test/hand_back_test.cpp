// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, whose pilot takes over for a while and gives back: controllers without effect must not wind
// up.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

Graph mission(bool held) {
  const std::string configs = std::string(FULMAR_SOURCE_DIR) + "/configs/";
  const fs::path file =
      fs::temp_directory_path() / ("fulmar-hand-back-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "mission: hand_back\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
      << (held ? "" : "control: []\n")
      << "components:\n  sim:  {params: {sensors: rosflight, start_heading: 135 deg}}\n"
      << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n";
  Graph graph = load_mission(file.string());
  fs::remove(file);
  return graph;
}

class Trial {
 public:
  explicit Trial(bool held) : graph_(mission(held)), flight_(graph_, options()) {}
  void pilot(double roll, double pitch, double throttle) {
    set("stick_roll", roll);
    set("stick_pitch", pitch);
    set("stick_throttle", throttle);
    set("pilot_flies", 0, 1);
  }
  void give_back() { set("pilot_flies", 0, 0); }
  void fly_until(double t_s) {
    while (1e-9 * static_cast<double>(flight_.now_ns()) < t_s - 1e-6) REQUIRE(flight_.step());
  }
  double truth(const char* name) const { return field("sim", "truth", name); }
  double elevator() const { return field("attitude", "actuators", "elevator_rad"); }

 private:
  void set(const char* param, double number, std::int64_t integer = 0) {
    ParamValue v;
    v.number[0] = number;
    v.integer = integer;
    set_parameter(flight_, "sim", param, v);
  }
  double field(const char* component, const char* port, const char* name) const {
    const auto at = std::find_if(graph_.components.begin(), graph_.components.end(),
                                 [&](const Component& c) { return c.name == component; });
    REQUIRE(at != graph_.components.end());
    const int output = at->info().output(port);
    const FieldRef ref = resolve_field(*at->info().outputs[static_cast<std::size_t>(output)].type, name);
    const Source source{Source::Kind::component, static_cast<int>(at - graph_.components.begin()), output};
    return number_at(*ref.field, flight_.sample(source) + ref.offset);
  }
  static FlightOptions options() {
    FlightOptions o;
    o.log = false;
    return o;
  }
  Graph graph_;
  Flight flight_;
};

}  // namespace

TEST_CASE(
    "a pilot who has flown for 20 s gets no kick of the elevator when he gives back; without 'control' he "
    "does") {
  constexpr double trim_stick = -0.165,
                   throw_rad = 0.6981317;  // stick that holds about cruise; 40 degrees, of the airframe file
  double kick[2], lowest[2];
  for (const bool held : {false, true}) {
    Trial trial(held);
    trial.fly_until(60);
    trial.pilot(0.006, trim_stick, 0.62);
    trial.fly_until(80);
    CHECK(trial.truth("roll_rad") < -0.5);  // a spiral, far from the mission's command
    trial.give_back();
    trial.fly_until(80.0025);  // the first command that the aircraft follows
    kick[held] = std::abs(trial.elevator() + trim_stick * throw_rad);
    lowest[held] = 1e9;
    for (double t = 80; t < 100; t += 0.1) {
      trial.fly_until(t);
      lowest[held] = std::min(lowest[held], trial.truth("height_m"));
    }
  }
  MESSAGE("elevator's kick: " << kick[false] << " rad without, " << kick[true] << " rad with; lowest "
                              << lowest[false] << " m, " << lowest[true] << " m");
  CHECK(kick[false] > 0.5);
  CHECK(kick[true] < 0.15);
  CHECK(lowest[true] > 60);  // commanded: 70 m
}
