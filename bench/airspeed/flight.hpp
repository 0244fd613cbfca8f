// SPDX-License-Identifier: BSD-3-Clause
// Flies the shipped autopilot through legs, turns, climbs and descents, with some sensors missing for a
// while, and measures the error and the reported standard deviation of the airspeed meanwhile.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "bench/airspeed/cases.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/fault_request.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::lost_airspeed {

namespace fs = std::filesystem;

/// Results from the loss until the return of the sensors.
struct Flown {
  double ticks = 0, square = 0, variance = 0, most = 0, within_1 = 0, within_2 = 0, valid = 0, modelled = 0,
         min_true = 1e9;  ///< m/s, m2/s2, ticks
  bool crashed = false;

  double rms() const { return std::sqrt(square / std::max(ticks, 1.0)); }
  double claimed() const { return std::sqrt(variance / std::max(ticks, 1.0)); }
  double share(double n) const { return n / std::max(ticks, 1.0); }
  void add(const Flown& f) {
    ticks += f.ticks;
    square += f.square;
    variance += f.variance;
    within_1 += f.within_1;
    within_2 += f.within_2;
    valid += f.valid;
    modelled += f.modelled;
    most = std::max(most, f.most);
    min_true = std::min(min_true, f.min_true);
    crashed = crashed || f.crashed;
  }
};

inline fs::path mission_of(const Case& c, const std::string& sensors, bool wired, const fs::path& folder) {
  std::ofstream(folder / "plan.yaml")
      << "name: climbing\nend: circuit\nairspeed: 17 m/s\nturn_radius: 50 m\nwaypoints:\n"
         "  - {north: 400 m, east: -250 m, up: 80 m}\n  - {north: -400 m, east: -50 m, up: 140 m}\n"
         "  - {north: -400 m, east: -250 m, up: 140 m}\n  - {north: 400 m, east: -50 m, up: 90 m}\n";
  const fs::path file = folder / (c.name + ".yaml");
  std::ofstream(file) << "mission: lost_airspeed\nextends: " FULMAR_SOURCE_DIR
                         "/configs/missions/hourglass.yaml\nlive: off\ntimeout: 400 s\n"
                      << "done: {when: \"vehicle.status.armed\", for: " << c.from_s + c.lost_s + 5
                      << " s}\ncomponents:\n  sim: {params: {sensors: " << sensors
                      << ", truth_rate: 400 Hz, turbulence: " << c.turbulence
                      << "}}\n  plan: {params: {plan: plan.yaml}}\n"
                      << (wired ? "" : "  ekf: {in: {commands: null}}\n");
  return file;
}

class Watched {
 public:
  Watched(const Case& c, const core::Graph& graph) : case_(c), flight_(graph, unlogged()) {
    truth_ = output_of(graph, "sim", "truth");
    state_ = output_of(graph, "ekf", "state");
  }

  Flown fly() {
    while (flight_.step()) {
      const double t_s = 1e-9 * static_cast<double>(flight_.now_ns()) - case_.from_s;
      const bool lost = t_s >= 0 && t_s < case_.lost_s;
      fault(off_, lost, FaultTarget::pitot);
      if (case_.gnss) fault(gnss_off_, lost, FaultTarget::gnss_position);
      const double failing_s = case_.engine_s < 0 ? -1 : t_s - case_.engine_s;
      engine(lost && failing_s >= 0 && failing_s < case_.engine_for_s);
      const auto* const x = at<VehicleState>(truth_);
      const auto* const s = at<VehicleState>(state_);
      if (x && s && lost) look(*x, *s);
    }
    out_.crashed = flight_.finish().outcome != core::Outcome::flown;
    return out_;
  }

 private:
  static core::FlightOptions unlogged() {
    core::FlightOptions o;
    o.log = false;
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }
  void fault(bool& is, bool off, FaultTarget target) {
    if (is == off) return;
    is = off;
    core::request(flight_, "sim", "fault", FaultRequest{target, off ? FaultKind::off : FaultKind::none});
  }
  void engine(bool bad) {
    if (bad == engine_bad_) return;
    engine_bad_ = bad;
    FaultRequest r{FaultTarget::engine, FaultKind::none};
    if (bad) r.kind = case_.left_ratio > 0 ? FaultKind::weak : FaultKind::off;
    if (bad) {
      r.size_ratio = case_.left_ratio;
      r.ramp_s = case_.ramp_s;
    }
    core::request(flight_, "sim", "fault", r);
  }
  void look(const VehicleState& x, const VehicleState& s) {
    const double e = std::abs(s.airspeed_mps - x.airspeed_mps);
    ++out_.ticks;
    out_.square += e * e;
    out_.variance += s.airspeed_std_mps * s.airspeed_std_mps;
    out_.most = std::max(out_.most, e);
    out_.within_1 += e < s.airspeed_std_mps;
    out_.within_2 += e < 2 * s.airspeed_std_mps;
    out_.valid += s.airspeed_valid;
    out_.modelled += s.airspeed_from_model;
    out_.min_true = std::min(out_.min_true, x.airspeed_mps);
  }

  Case case_;
  Flown out_;
  bool off_ = false, gnss_off_ = false, engine_bad_ = false;
  core::Flight flight_;
  core::Source truth_, state_;
};

/// `estimator`: a plugin in place of the shipped one, or empty.
inline Flown fly(const Case& c, const std::string& sensors, bool wired, unsigned seed, const fs::path& folder,
                 const std::string& estimator = "") {
  core::Overrides overrides;
  if (!estimator.empty()) overrides.with.emplace_back("ekf", estimator);
  overrides.seed = seed;
  const core::Graph graph = core::load_mission(mission_of(c, sensors, wired, folder).string(), overrides);
  return Watched(c, graph).fly();
}

}  // namespace fulmar::lost_airspeed
