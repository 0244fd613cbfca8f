// SPDX-License-Identifier: BSD-3-Clause
// The shipped autopilot flies one circuit of the hourglass, and on its first straight a part of the simulated
// aircraft fails permanently: all available failures, and the measured figures of such a flight.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/app/test/hourglass.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::core::failures {

namespace fs = std::filesystem;

struct Failure {
  std::string what, how, set;  ///< set: by the phase of the failure
};

inline std::vector<Failure> all_failures() {
  std::vector<Failure> list{{"nothing", "", "rc_link: true"}};
  for (const char* sensor : {"gyro", "accel", "gnss_position", "gnss_velocity", "mag", "baro", "pitot"})
    for (const char* how : {"off", "stuck", "wrong", "slow", "noisy", "jumping"})
      list.push_back({sensor, how, std::string(sensor) + "_fault: " + how});
  for (const char* surface : {"aileron", "elevator", "rudder"})
    for (const char* how : {"stuck", "hardover_positive", "hardover_negative", "slow", "free", "lost"})
      list.push_back({surface, how, std::string(surface) + "_fault: " + how});
  for (const char* how : {"off", "weak"})
    list.push_back({"engine", how, std::string("engine_fault: ") + how});
  list.push_back({"battery", "empty", "battery_fault: empty"});
  list.push_back({"radio", "off", "rc_link: false"});
  list.push_back({"icing", "growing", "icing_rate: 0.02 1/s"});
  return list;
}

inline const Failure& failure(const std::string& what, const std::string& how) {
  static const std::vector<Failure> list = all_failures();
  for (const Failure& f : list)
    if (f.what == what && f.how == how) return f;
  throw std::runtime_error("no failure " + what + " " + how);
}

/// Writes the mission to `folder`: the hourglass with an additional phase.
inline fs::path mission_of(const Failure& f, const fs::path& folder) {
  const fs::path file = folder / (f.what + "_" + f.how + ".yaml");
  std::ofstream(file) << "mission: failing\nextends: " FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml\n"
                      << "live: off\ntimeout: 270 s\ndone: \"manage.progress.circuits >= 1\"\nphases:\n"
                      << "  cruise: {outer: {use: slc, fallback: tecs}, next: [{to: failing, when: "
                         "\"manage.progress.item >= 1\", for: 10 s}]}\n"
                      << "  failing: {vehicle: {set: {" << f.set
                      << "}}, outer: {use: slc, fallback: tecs}}\n";
  return file;
}

struct After {
  bool flown = false, down = false;  ///< neither: still in the air, its circuit not complete
  double plan_m = 0;                 ///< largest horizontal distance from the plan while it flew
  double lowest_m = 1e9;
  double height_error_m = 0;  ///< of the estimate, largest
  double position_error_m = 0;
  double down_s = -1;     ///< from the failure to the ground
  bool reported = false;  ///< a message came after the failure
  bool admitted = false;  ///< the estimate marked a value of itself as invalid
  std::size_t guards = 0;
  std::string outcome;
};

class FailingFlight {
 public:
  FailingFlight(const Graph& graph, FlightOptions options) : flight_(graph, watched(std::move(options))) {
    truth_ = output_of(graph, "sim", "truth");
    contact_ = output_of(graph, "sim", "contact");
    state_ = output_of(graph, "ekf", "state");
  }

  After fly() {
    double touched_s = -1;
    while (flight_.step()) {
      now_s_ = 1e-9 * static_cast<double>(flight_.now_ns());
      if (failed_s_ < 0 && flight_.phase() == "failing") failed_s_ = now_s_;
      if (failed_s_ < 0) continue;
      look_at();
      const auto* const contact = at<fulmar::ContactTruth>(contact_);
      if (contact && contact->touching && touched_s < 0) touched_s = now_s_;
      if (touched_s >= 0 && now_s_ - touched_s > 1) break;  // it is on the ground
    }
    const FlightResult result = flight_.finish();
    after_.guards = result.guards.size();
    after_.outcome = result.reason;
    after_.down = touched_s >= 0 || result.reason.find("crashed") != std::string::npos;
    after_.flown = result.outcome == Outcome::flown && !after_.down;
    if (after_.down) after_.down_s = (touched_s >= 0 ? touched_s : now_s_) - failed_s_;
    return after_;
  }

 private:
  FlightOptions watched(FlightOptions o) {
    o.say = [this](const std::string& line, bool) {
      const bool of_the_end = line.find("phase ") == 0;
      if (failed_s_ >= 0 && !of_the_end) after_.reported = true;
    };
    return o;
  }
  void look_at() {
    const auto* const x = at<fulmar::VehicleState>(truth_);
    const auto* const s = at<fulmar::VehicleState>(state_);
    if (!x || !s) return;
    after_.admitted = after_.admitted || !s->attitude_valid || !s->position_valid || !s->velocity_valid ||
                      !s->height_valid || !s->airspeed_valid;
    after_.plan_m = std::max(after_.plan_m, plan_.distance_m(x->position_m.north, x->position_m.east));
    after_.lowest_m = std::min(after_.lowest_m, x->height_m);
    after_.height_error_m = std::max(after_.height_error_m, std::abs(s->height_m - x->height_m));
    after_.position_error_m = std::max(
        after_.position_error_m,
        std::hypot(s->position_m.north - x->position_m.north, s->position_m.east - x->position_m.east));
  }
  template <class T>
  const T* at(const Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }

  double now_s_ = 0, failed_s_ = -1;
  After after_;
  test::Hourglass plan_;
  Flight flight_;
  Source truth_, contact_, state_;
};

inline After fly(const Failure& f, unsigned seed, const fs::path& folder, FlightOptions options) {
  Overrides overrides;
  overrides.seed = seed;
  return FailingFlight(load_mission(mission_of(f, folder).string(), overrides), std::move(options)).fly();
}

}  // namespace fulmar::core::failures
