// SPDX-License-Identifier: BSD-3-Clause
// One thing fails while a mission with plugins/safety is flown: all that bench_safety and safety_flights_test
// fly, and what is measured of such a flight.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/safety/rows.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::safety_flights {

namespace fs = std::filesystem;

/// Geometry scaled to the airframe: the hourglass is too small for all but the Anaconda. The X8 is thrown,
/// unless it begins in the air.
inline std::string mission_text(const Row& row) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs";
  const auto list = [](const std::string& s) { return s.empty() ? "" : ", " + s; };
  const std::string failing = "  failing: {use: " FULMAR_TEST_PLUGIN_DIR
                              "/failing.so, "
                              "in: {status: vehicle.status, state: nav.state}, params: {" +
                              row.failing + "}}\n";
  const std::string watch = std::string("  watch: {") +
                            (row.relayed ? "in: {status: failing.status, state: failing.state}, " : "") +
                            "params: {";
  const std::string done = row.end == End::aloft   ? "manage.progress.circuits >= 1"
                           : row.end == End::stood ? "time > 60 s"
                                                   : "ground.state.landed";
  const std::string head = "mission: failing\nlive: off\ntimeout: 900 s\ndone: {when: \"" + done +
                           "\", for: 10 s}\nextends: " + configs + "/missions/";
  if (row.airframe == "anaconda")
    return head + "return_home.yaml\ncomponents:\n" + failing +
           "  sim: {in: {fault: failing.fault}, params: {motor: true" + list(row.sim) + "}}\n" + watch +
           "landing: false" + list(row.watch) + "}}\n";
  const bool x8 = row.airframe == "x8", thrown = x8 && row.sim.find("start_height") == std::string::npos;
  const auto unless = [&](const char* said, const char* params) {
    return row.sim.find(said) == std::string::npos ? params : "";
  };
  const std::string fence =
      row.watch.find("fence: ") != std::string::npos
          ? ""
          : ", fence: {floor: 20 m, ceiling: 200 m, corners: [{north: 1200 m, east: -1300 m}, {north: 1200 "
            "m, east: 600 m}, {north: -1000 m, east: 600 m}, {north: -1000 m, east: -1300 m}]}";
  return head + "safe.yaml\nairframe: " + configs + "/airframes/" + row.airframe + ".yaml\n" +
         "origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
         "components:\n" +
         failing + "  sim: {in: {fault: failing.fault}, params: {sensors: rosflight, start_heading: 135 deg" +
         unless("wind_ned", ", wind_ned: [3.5355, -3.5355, 0]") +
         unless("turbulence", ", turbulence: light") +
         (thrown ? ", launch: hand, launch_speed: 11 m/s, launch_after: 3 s" : "") + list(row.sim) +
         "}}\n"
         "  plan: {params: {plan: {airspeed: " +
         (x8 ? "18" : "25") +
         " m/s, turn_radius: 110 m, end: circuit, waypoints: [{north: 700 m, east: -400 m, up: 100 m}, "
         "{north: -500 m, east: -400 m, up: 100 m}, {north: -500 m, east: 200 m, up: 100 m}, {north: 700 m, "
         "east: 200 m, up: 100 m}]}}}\n" +
         watch +
         "places: {places: &places [{north: 0 m, east: 0 m}, {north: 600 m, east: -300 "
         "m}, {north: -400 m, east: -300 m}]}" +
         fence + list(row.watch) +
         "}}\n"
         "  back: {params: {places: {places: *places}, return_height: 100 m" +
         (x8 ? "" : ", radius: 120 m, glide_radius: 80 m") +
         "}}\n"
         "  land: {params: {runway: {north: 0 m, east: 0 m, up: 0 m, heading: 135 deg, length: 600 m}, "
         "final_length: 800 m, circle_radius: 150 m}}\n" +
         // in a gale the X8's Dutch roll needs this limit
         (x8 ? std::string("  slc: {params: {roll_rate_limit: 0.5 rad/s") +
                   (thrown ? ", launch_acceleration: 15 m/s2, launch_delay: 0.3 s" : "") + "}}\n"
             : "") +
         "phases:\n" + (thrown ? "  hold: {outer: {use: slc, set: {law: takeoff}}}\n" : "") +
         "  cruise: {next: [{to: home, when: \"guard.safety.answer == home or guard.safety.answer == "
         "land\"}, {to: approach, when: \"manage.progress.circuits >= 1\"}]}\n";
}

struct Flown {
  End end = End::aloft;
  double reported_s = -1;      ///< time from the failure; -1: never
  bool reported_else = false;  ///< a fault was reported that did not occur, or too early
  bool in_order = false;       ///< all phases of the row occurred
  double touch_sink_mps = 0;   ///< true sink rate at the first contact
  double home_m = 0;           ///< true distance from home at the end
  double outside_m = -1e9;     ///< largest true distance outside of the fence
  double seconds = 0;          ///< from the failure to the ground
  std::string outcome;
  bool kept(const Row& row) const {
    const bool in_time = reported_s >= 0 && reported_s <= row.reported_within_s;
    const bool reported = row.cause ? in_time || (row.may_be_reported && reported_s < 0) : !reported_else;
    return end == row.end && reported && in_order && (outside_m <= 0 || end == End::stood || row.may_leave);
  }
};

/// Distance of a position outside of the row's fence; negative: inside.
inline double outside(const Row& row, const VehicleState& x) {
  const bool big = row.airframe != "anaconda", near = row.watch.find("fence: ") != std::string::npos;
  const double north = big ? 1200 : 600, east = big ? 600 : 350, west = big ? 1300 : 700;
  const double south = row.south_m > 0 ? row.south_m : big ? 1000 : 600;
  const double up = row.up_m > 0 ? row.up_m : near ? 1e9 : big ? 200 : 150;
  const auto& at = x.position_m;
  return std::max({at.north - north, -at.north - south, at.east - east, -at.east - west, x.height_m - up});
}

inline Flown fly(const Row& row, unsigned seed, const fs::path& folder) {
  using namespace core;
  const fs::path file = folder / "failing.yaml";
  std::ofstream(file) << mission_text(row);
  Overrides overrides;
  overrides.seed = seed;
  FlightOptions options;
  options.log = false;
  const Graph graph = load_mission(file.string(), overrides);
  Flight flight(graph, options);
  const Source truth = output_of(graph, "sim", "truth"), contact = output_of(graph, "sim", "contact"),
               watch = output_of(graph, "watch", "safety");
  Flown f;
  std::size_t next = 0;
  bool flew = false;
  double touched_s = -1, climb_mps = 0, at_s = row.below_m > 0 ? 1e9 : row.at_s, top_m = 0;
  while (flight.step()) {
    const double now = 1e-9 * static_cast<double>(flight.now_ns());
    if (next < row.phases.size() && flight.phase() == row.phases[next]) ++next;
    const auto* const safety = reinterpret_cast<const SafetyState*>(flight.sample(watch));
    const auto* const x = reinterpret_cast<const VehicleState*>(flight.sample(truth));
    const auto* const v = reinterpret_cast<const ContactTruth*>(flight.sample(contact));
    if (!x || !v) continue;
    if (safety) {
      if (row.cause && safety->*row.cause && f.reported_s < 0 && now >= at_s) f.reported_s = now - at_s;
      f.reported_else = f.reported_else || (safety->airborne && safety->answer != SafetyAnswer::none &&
                                            (now < at_s || !row.cause));
    }
    f.outside_m = std::max(f.outside_m, outside(row, *x));
    top_m = std::max(top_m, x->height_m);
    if (at_s > 1e8 && top_m > 40 && x->height_m < row.below_m) at_s = now;
    flew = flew || x->height_m > 5;
    if (flew && v->touching && touched_s < 0) {
      touched_s = now;
      f.touch_sink_mps = -climb_mps;
    }
    climb_mps = x->climb_rate_mps;
    f.home_m = std::hypot(x->position_m.north, x->position_m.east);
    if (touched_s >= 0 && row.cause == &SafetyState::wind_excessive && now - touched_s > 5) break;
  }
  const FlightResult result = flight.finish();
  f.outcome = result.reason;
  f.in_order = next == row.phases.size();
  f.end = result.reason.find("crashed") != std::string::npos ? End::broken
          : !flew                                            ? End::stood
          : touched_s >= 0                                   ? End::on_ground
                                                             : End::aloft;
  f.seconds = touched_s - at_s;
  return f;
}

}  // namespace fulmar::safety_flights
