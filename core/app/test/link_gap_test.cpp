// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, whose vehicle sends nothing for a while in the middle of a turn, as with a loose cable: no
// sensor data, then all again. The flight continues.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/app/report.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

constexpr double deg = 3.14159265358979323846 / 180;

struct Row {
  double t_s, north_m, east_m, down_m, roll_rad;  // truth
  double estimated_roll_rad, aileron_rad, elevator_rad, throttle_frac;
  bool valid;
};

Graph mission(const std::string& outer, const std::string& sensors) {
  const std::string configs = std::string(FULMAR_SOURCE_DIR) + "/configs/";
  const fs::path file = fs::temp_directory_path() / ("fulmar-gap-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "mission: gap\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
      << "done: \"manage.progress.circuits >= 1\"\ncomponents:\n"
      << "  sim:  {params: {sensors: " << sensors
      << ", wind_ned: [3.5355, -3.5355, 0], turbulence: light, start_heading: 135 deg}}\n"
      << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n"
      << "phases:\n  cruise: {outer: " << outer << "}\n";
  Graph graph = load_mission(file.string());
  fs::remove(file);
  return graph;
}

/// One field of one component's output, read between ticks.
class Look {
 public:
  Look(const Graph& graph, const char* component, const char* output, const char* field) {
    const auto found = std::find_if(graph.components.begin(), graph.components.end(),
                                    [&](const auto& c) { return c.name == component; });
    REQUIRE(found != graph.components.end());
    const int port = found->info().output(output);
    source_ = {Source::Kind::component, static_cast<int>(found - graph.components.begin()), port};
    offset_ = resolve_field(*found->info().outputs[static_cast<std::size_t>(port)].type, field).offset;
  }
  template <class T = double>
  T at(const Flight& flight) const {
    T value{};
    if (const std::byte* message = flight.sample(source_)) std::memcpy(&value, message + offset_, sizeof(T));
    return value;
  }

 private:
  Source source_;
  std::uint32_t offset_ = 0;
};

struct Flown {
  FlightResult result;
  std::vector<Row> rows;
};

Flown fly(const Graph& graph, double silent_from_s = 1e9, double silent_for_s = 0) {
  FlightOptions o;
  o.log = false;
  Flight flight(graph, o);
  const Look north(graph, "sim", "truth", "position_m.north"), east(graph, "sim", "truth", "position_m.east"),
      down(graph, "sim", "truth", "position_m.down"), roll(graph, "sim", "truth", "roll_rad"),
      estimated_roll(graph, "ekf", "state", "roll_rad"), valid(graph, "ekf", "state", "attitude_valid"),
      aileron(graph, "attitude", "actuators", "aileron_rad"),
      elevator(graph, "attitude", "actuators", "elevator_rad"),
      throttle(graph, "attitude", "actuators", "throttle_frac");
  Flown flown;
  bool silent = false;
  do {
    const double t = 1e-9 * static_cast<double>(flight.now_ns());
    const bool silence = t >= silent_from_s && t < silent_from_s + silent_for_s;
    if (silence != silent) {
      ParamValue works;
      works.integer = silence ? 0 : 1;
      for (const char* sensor : {"imu_works", "gnss_works", "mag_works", "baro_works", "pitot_works"})
        set_parameter(flight, "sim", sensor, works);
      silent = silence;
    }
    flown.rows.push_back({t, north.at(flight), east.at(flight), down.at(flight), roll.at(flight),
                          estimated_roll.at(flight), aileron.at(flight), elevator.at(flight),
                          throttle.at(flight), valid.at<std::uint8_t>(flight) != 0});
  } while (flight.step());
  flown.result = flight.finish();
  return flown;
}

double middle_of_a_turn(const Flown& whole) {
  const auto turn = std::find_if(whole.rows.begin(), whole.rows.end(),
                                 [](const Row& r) { return r.t_s > 20 && std::abs(r.roll_rad) > 0.4; });
  REQUIRE(turn != whole.rows.end());
  return turn->t_s + 0.5;
}

}  // namespace

namespace {

/// Effect of a gap on the flight. Steps are those of one tick, in degrees: in the gap, in two seconds after
/// it, and without a gap.
struct Effect {
  double lowest_m = 1e9, highest_m = 0, off_track_m = 0, valid_after_s = -1, first_roll_error_deg = 0;
  double aileron_back_deg = 0, elevator_back_deg = 0, aileron_always_deg = 0, elevator_always_deg = 0,
         throttle_back_frac = 0;
};

Effect effect(const Flown& flown, const Flown& whole, double from_s, double length_s) {
  Effect e;
  const double end_s = from_s + length_s;
  for (std::size_t i = 1; i < flown.rows.size(); ++i) {
    const Row &r = flown.rows[i], &b = flown.rows[i - 1];
    if (r.t_s < from_s) continue;
    e.lowest_m = std::min(e.lowest_m, -r.down_m);
    e.highest_m = std::max(e.highest_m, -r.down_m);
    if (r.t_s > end_s + 0.02 && r.valid && e.valid_after_s < 0) {
      e.valid_after_s = r.t_s - end_s;
      e.first_roll_error_deg = std::abs(r.estimated_roll_rad - r.roll_rad) / deg;
    }
    if (r.t_s > end_s && r.t_s < end_s + 2) {
      e.aileron_back_deg = std::max(e.aileron_back_deg, std::abs(r.aileron_rad - b.aileron_rad) / deg);
      e.elevator_back_deg = std::max(e.elevator_back_deg, std::abs(r.elevator_rad - b.elevator_rad) / deg);
      e.throttle_back_frac = std::max(e.throttle_back_frac, std::abs(r.throttle_frac - b.throttle_frac));
    }
    if (i % 40 != 0) continue;
    double near_m = 1e9;
    for (std::size_t j = 0; j < whole.rows.size(); j += 40) {
      const Row& w = whole.rows[j];
      near_m = std::min(near_m, std::hypot(r.north_m - w.north_m, r.east_m - w.east_m, r.down_m - w.down_m));
    }
    e.off_track_m = std::max(e.off_track_m, near_m);
  }
  for (std::size_t i = 1; i < whole.rows.size(); ++i) {
    const Row &r = whole.rows[i], &b = whole.rows[i - 1];
    if (r.t_s < 30) continue;  // take-off
    e.aileron_always_deg = std::max(e.aileron_always_deg, std::abs(r.aileron_rad - b.aileron_rad) / deg);
    e.elevator_always_deg = std::max(e.elevator_always_deg, std::abs(r.elevator_rad - b.elevator_rad) / deg);
  }
  return e;
}

}  // namespace

TEST_CASE(
    "all sensors fall silent in a turn, for 0.1, 1 or 5 s: the flight is completed and control resumes "
    "without a step") {
  struct Setup {
    const char *outer, *sensors;
  };
  for (const Setup& setup : {Setup{"slc", "rosflight"}, Setup{"tecs", "ublox"}}) {
    const Graph graph = mission(setup.outer, setup.sensors);
    const Flown whole = fly(graph);
    REQUIRE(whole.result.outcome == Outcome::flown);
    const double turn_s = middle_of_a_turn(whole);
    for (const double length_s : {0.1, 1.0, 5.0})
      for (const double from_s :
           {turn_s, turn_s + 5, turn_s + 17}) {  // in the turn, rolling out of it, straight
        CAPTURE(std::string(setup.sensors));
        CAPTURE(length_s);
        CAPTURE(from_s);
        const Flown flown = fly(graph, from_s, length_s);
        CHECK(flown.result.outcome == Outcome::flown);
        CHECK(flown.result.guards.empty());
        const Effect e = effect(flown, whole, from_s, length_s);
        MESSAGE(std::string(setup.outer)
                << ", " << std::string(setup.sensors) << ", " << length_s << " s: valid after "
                << e.valid_after_s << " s with " << e.first_roll_error_deg << " deg of roll error, "
                << e.off_track_m << " m off the track, height " << e.lowest_m << " to " << e.highest_m
                << " m, steps of aileron " << e.aileron_back_deg << " and elevator " << e.elevator_back_deg
                << " deg (otherwise " << e.aileron_always_deg << " and " << e.elevator_always_deg << ")");
        CHECK(e.valid_after_s >= 0);
        CHECK(e.valid_after_s < (length_s < 0.3 ? 0.05 : 2));
        CHECK(e.first_roll_error_deg < (length_s < 0.3 ? 2 : 5));
        CHECK(e.off_track_m < (length_s < 0.3 ? 2 : length_s < 2 ? 80 : 200));
        CHECK(e.lowest_m > 55);
        CHECK(e.highest_m < 85);
        CHECK(e.aileron_back_deg < 5);
        CHECK(e.elevator_back_deg < (length_s < 0.3 ? 8 : 5));
        CHECK(e.throttle_back_frac < 0.05);
      }
  }
}

TEST_CASE("the progress line shows no invalid figure") {
  const Graph graph = mission("slc", "rosflight");
  FlightOptions o;
  o.log = false;
  Flight flight(graph, o);
  const auto fly_until = [&](double t_s) {
    while (1e-9 * static_cast<double>(flight.now_ns()) < t_s) REQUIRE(flight.step());
  };
  const auto sensors = [&](bool work) {
    ParamValue value;
    value.integer = work ? 1 : 0;
    for (const char* sensor : {"imu_works", "gnss_works", "mag_works", "baro_works", "pitot_works"})
      set_parameter(flight, "sim", sensor, value);
  };
  const auto shows = [&](const char* words) {
    return progress_line(graph, flight).find(words) != std::string::npos;
  };
  fly_until(40);
  CHECK_FALSE(shows("height -"));
  CHECK_FALSE(shows("airspeed -"));
  sensors(false);
  fly_until(41);
  CAPTURE(progress_line(graph, flight));
  CHECK(shows("height -"));
  CHECK(shows("airspeed -"));
  sensors(true);
  fly_until(45);
  CHECK_FALSE(shows("height -"));
}
