// SPDX-License-Identifier: BSD-3-Clause
// Flies the shipped autopilot from the ground with a magnetometer that is turned about the body z axis.
#pragma once
#include <iterator>
#include <vector>

#include "bench/sensor_faults/flight.hpp"
#include "fulmar/flight/math/angles.hpp"

namespace fulmar::sensor_faults {

inline constexpr double settled_s = 5;  ///< from lift-off until the heading has to be right
inline constexpr double lift_off_m = 1;

struct CompassFlown {
  bool flown = false;
  double error_deg = 0;   ///< largest error of the heading from `settled_s` after lift-off on
  double report_s = 1e9;  ///< from lift-off to the report, negative in the run; 1e9: none
  double off_by_deg = 0;  ///< size of the last report
};

/// The shipped sensors `model`, their magnetometer turned.
inline fs::path mission_of_compass(const std::string& model, double degrees, const fs::path& folder) {
  std::ifstream in(FULMAR_SOURCE_DIR "/configs/sensors/" + model + ".yaml");
  std::string text(std::istreambuf_iterator<char>(in), {});
  const std::string before = "mag:   {", turn = "mount: {yaw: " + std::to_string(degrees) + " deg}, ";
  const auto at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error(sensor_faults_messages::mag_missing(model));
  std::ofstream(folder / "turned.yaml") << text.insert(at + before.size(), turn);
  std::ofstream(folder / "compass.yaml")
      << "mission: compass\nextends: " FULMAR_SOURCE_DIR
         "/configs/missions/hourglass.yaml\nlive: off\ntimeout: 300 s\ncomponents:\n"
         "  sim: {params: {sensors: null, sensor_file: turned.yaml, truth_rate: 400 Hz}}\n";
  return folder / "compass.yaml";
}

inline CompassFlown fly_compass(const std::string& model, double degrees, unsigned seed,
                                const fs::path& folder, const std::string& estimator) {
  core::Overrides overrides;
  if (!estimator.empty()) overrides.with.emplace_back("ekf", estimator);
  overrides.seed = seed;
  const core::Graph graph =
      core::load_mission(mission_of_compass(model, degrees, folder).string(), overrides);
  core::FlightOptions unlogged;
  unlogged.log = false;
  core::Flight flight(graph, unlogged);
  const core::Source truth = output_of(graph, "sim", "truth"), state = output_of(graph, "ekf", "state"),
                     health = output_of(graph, "ekf", "health");
  CompassFlown out;
  double lift_off_s = 1e9, report_s = 1e9;
  while (flight.step()) {
    const double now_s = 1e-9 * static_cast<double>(flight.now_ns());
    const auto* const x = reinterpret_cast<const VehicleState*>(flight.sample(truth));
    const auto* const s = reinterpret_cast<const VehicleState*>(flight.sample(state));
    const auto* const h = reinterpret_cast<const NavigationHealth*>(flight.sample(health));
    if (!x || !s || !h) continue;
    if (x->height_m > lift_off_m) lift_off_s = std::min(lift_off_s, now_s);
    if (h->mag.state == SensorState::biased) {
      report_s = std::min(report_s, now_s);
      out.off_by_deg = h->mag_turn_rad * 57.29577951308232;
    }
    if (now_s < lift_off_s + settled_s) continue;
    out.error_deg =
        std::max(out.error_deg, 57.29577951308232 * std::abs(angle_difference(s->yaw_rad, x->yaw_rad)));
  }
  out.flown = flight.finish().outcome == core::Outcome::flown;
  if (report_s < 1e9) out.report_s = report_s - lift_off_s;
  return out;
}

/// Prints a row for each model and angle. Returns the number of flights below the bounds.
inline unsigned fly_compasses(unsigned first, unsigned seeds, const fs::path& folder,
                              const std::string& estimator) {
  constexpr double found_deg = 60, right_deg = 10;  // smaller turns may stay below the noise
  std::printf(
      "| sensors | turned by, deg | flown | heading error, deg | reported | after lift-off, s: median "
      "| last | reported turn, deg |\n|---|---|---|---|---|---|---|---|\n");
  unsigned misses = 0;
  for (const char* model : {"rosflight", "ublox"})
    for (int degrees = 0; degrees <= 180; degrees += 30) {
      std::vector<double> report_s;
      double error_deg = 0, least_deg = 1e9, most_deg = -1e9;
      unsigned flown = 0;
      for (unsigned seed = first; seed < first + seeds; ++seed) {
        const CompassFlown f = fly_compass(model, degrees, seed, folder, estimator);
        flown += f.flown;
        error_deg = std::max(error_deg, f.error_deg);
        const bool reported = f.report_s < 1e9;
        if (!f.flown || (degrees == 0 && reported) ||
            (degrees >= found_deg && (f.report_s > settled_s || f.error_deg > right_deg)))
          ++misses;
        if (!reported) continue;
        report_s.push_back(f.report_s);
        least_deg = std::min(least_deg, std::abs(f.off_by_deg));
        most_deg = std::max(most_deg, std::abs(f.off_by_deg));
      }
      std::sort(report_s.begin(), report_s.end());
      std::printf("| %s | %d | %u of %u | %.1f | %zu |", model, degrees, flown, seeds, error_deg,
                  report_s.size());
      if (report_s.empty())
        std::printf(" - | - | - |\n");
      else
        std::printf(" %.1f | %.1f | %.0f to %.0f |\n", report_s[report_s.size() / 2], report_s.back(),
                    least_deg, most_deg);
      std::fflush(stdout);
    }
  return misses;
}

}  // namespace fulmar::sensor_faults
