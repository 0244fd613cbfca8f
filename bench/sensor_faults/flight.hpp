// SPDX-License-Identifier: BSD-3-Clause
// Flies the shipped autopilot with one sensor that is bad for a while, and measures what the estimate makes
// of it.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "bench/sensor_faults/rows.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::sensor_faults {

namespace fs = std::filesystem;

inline constexpr double from_s = 85;   ///< begin of the fault: a minute after the take-off, on a straight
inline constexpr double watch_s = 30;  ///< time after its end

struct Flown {
  double reported_s = -1;     ///< time from the begin of the fault; -1: never
  std::string reported_by{};  ///< a sensor's state, or a flag
  std::string accused{};      ///< working sensors with a report
  Each most{};                ///< largest errors from the begin of the fault on
  Each max_valid{};           ///< the same, of valid values
  Each step{};                ///< changes of the error from one tick to the next
  double over_std = 0;        ///< largest airspeed error, in reported standard deviations
  double recovered_s = 0;     ///< from the end of the fault on; -1: not within the flight
  bool shown = false;         ///< some sample was changed
  bool crashed = false;

 private:
  friend class Watched;
  Each before_{};
};

inline fs::path mission_of(const Row& row, const std::string& set, const fs::path& folder) {
  const fs::path file = folder / (row.name + ".yaml");
  const std::string sim = (row.sim.empty() ? "" : ", " + row.sim) + (set.empty() ? "" : ", " + set);
  const std::string wires = row.wires.empty() ? "kind: none" : row.wires;
  std::ofstream(file) << "mission: sensor_faults\nextends: " FULMAR_SOURCE_DIR
                         "/configs/missions/hourglass.yaml\nlive: off\ntimeout: 300 s\n"
                      << "done: {when: \"vehicle.status.armed\", for: " << from_s + row.lasts_s + watch_s
                      << " s}\nroles:\n  nav: {in: {imu: wires.imu, gnss: wires.gnss, mag: wires.mag, "
                         "baro: wires.baro, pitot: wires.pitot}}\ncomponents:\n"
                      << "  sim: {params: {sensors: ublox, truth_rate: 400 Hz" << sim << "}}\n"
                      << "  wires: {use: " FULMAR_TEST_PLUGIN_DIR
                         "/tampered.so, in: {imu: vehicle.imu, gnss: vehicle.gnss, mag: vehicle.mag, baro: "
                         "vehicle.baro, pitot: vehicle.pitot, status: vehicle.status}, params: {"
                      << wires << ", from: " << from_s << " s, lasts: " << row.lasts_s << " s}}\n";
  return file;
}

class Watched {
 public:
  /// `usual`: the errors of the same flight without a fault; 1.5 times these count as recovered.
  Watched(const Row& row, const core::Graph& graph, const Each& usual)
      : row_(row), flight_(graph, unlogged()) {
    for (std::size_t i = 0; i < whats; ++i) bound_[i] = std::max(1.5 * usual[i], least[i]);
    truth_ = output_of(graph, "sim", "truth");
    state_ = output_of(graph, "ekf", "state");
    health_ = output_of(graph, "ekf", "health");
    spoilt_ = output_of(graph, "wires", "spoilt_ratio");
  }

  Flown fly() {
    while (flight_.step()) {
      const double t_s = 1e-9 * static_cast<double>(flight_.now_ns()) - from_s;
      switch_sensors(t_s);
      const auto* const x = at<VehicleState>(truth_);
      const auto* const s = at<VehicleState>(state_);
      if (t_s >= 0) spoilt(t_s);
      if (x && s && t_s >= 0) look(t_s, *x, *s);
    }
    const core::FlightResult result = flight_.finish();
    out_.crashed = result.outcome != core::Outcome::flown;
    out_.shown = spoilt_s_ >= 0;
    if (bad_s_ > row_.lasts_s + watch_s - 1) out_.recovered_s = -1;
    return out_;
  }

 private:
  /// Errors that count as recovered in any case.
  static constexpr Each least{4, 1, 5, 3, 1.5};
  static constexpr std::array<const char*, whats> flags{"attitude_valid", "velocity_valid", "position_valid",
                                                        "height_valid", "airspeed_valid"};

  static core::FlightOptions unlogged() {
    core::FlightOptions o;
    o.log = false;
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }
  void switch_sensors(double t_s) {
    const bool off = t_s >= 0 && t_s < row_.lasts_s;
    if (off == off_) return;
    off_ = off;
    for (const FaultTarget target : row_.off)
      core::request(flight_, "sim", "fault", FaultRequest{target, off ? FaultKind::off : FaultKind::none});
  }

  /// True from the first changed sample on; with a limit it may come late.
  bool spoilt(double t_s) {
    if (spoilt_s_ < 0 && (row_.wires.empty() || *at<double>(spoilt_) > 0.5)) spoilt_s_ = t_s;
    return spoilt_s_ >= 0;
  }

  void look(double t_s, const VehicleState& x, const VehicleState& s) {
    const double degree = 57.29577951308232;
    const Each e{degree * eigen(s.attitude).angularDistance(eigen(x.attitude)),
                 (eigen(s.velocity_mps) - eigen(x.velocity_mps)).norm(),
                 std::hypot(s.position_m.north - x.position_m.north, s.position_m.east - x.position_m.east),
                 std::abs(s.height_m - x.height_m), std::abs(s.airspeed_mps - x.airspeed_mps)};
    const std::array<bool, whats> valid{s.attitude_valid, s.velocity_valid, s.position_valid, s.height_valid,
                                        s.airspeed_valid};
    for (std::size_t i = 0; i < whats; ++i) {
      out_.most[i] = std::max(out_.most[i], e[i]);
      if (valid[i]) out_.max_valid[i] = std::max(out_.max_valid[i], e[i]);
      if (t_s > 0.01) out_.step[i] = std::max(out_.step[i], std::abs(e[i] - out_.before_[i]));
      if (!valid[i]) reported(t_s, flags[i]);
      if (t_s > row_.lasts_s && (!valid[i] || e[i] > bound_[i])) bad_s_ = t_s;
    }
    out_.before_ = e;
    out_.over_std = std::max(out_.over_std, e[airspeed] / s.airspeed_std_mps);
    out_.recovered_s = std::max(bad_s_ - row_.lasts_s, 0.0);
    if (const auto* const h = at<NavigationHealth>(health_)) listen(t_s, *h);
  }
  void listen(double t_s, const NavigationHealth& health) {
    for (const auto& [name, sensor] : sensors) {
      const SensorState state = (health.*sensor).state;
      if (state == SensorState::ok || (state == SensorState::never && row_.name != "no_mag")) continue;
      const bool right = std::find(row_.sensors.begin(), row_.sensors.end(), name) != row_.sensors.end();
      if (right)
        reported(t_s, std::string(name) + " " + states[static_cast<std::size_t>(state)]);
      else if (out_.accused.find(name) == std::string::npos)
        out_.accused += (out_.accused.empty() ? "" : ", ") + std::string(name);
    }
  }
  void reported(double t_s, const std::string& by) {
    if (out_.reported_s >= 0 || t_s > row_.lasts_s || !spoilt(t_s)) return;
    out_.reported_s = t_s - spoilt_s_;
    out_.reported_by = by;
  }

  Row row_;
  Each bound_{};
  Flown out_;
  bool off_ = false;
  double bad_s_ = -1, spoilt_s_ = -1;
  core::Flight flight_;
  core::Source truth_, state_, health_, spoilt_;
};

/// `set`: parameters of the aircraft in addition to those of the row.
inline Flown fly(const Row& row, unsigned seed, const Each& usual, const fs::path& folder,
                 const std::string& set = "", const std::string& estimator = "") {
  core::Overrides overrides;
  if (!estimator.empty()) overrides.with.emplace_back("ekf", estimator);
  overrides.seed = seed;
  const core::Graph graph = core::load_mission(mission_of(row, set, folder).string(), overrides);
  return Watched(row, graph, usual).fly();
}

}  // namespace fulmar::sensor_faults
