// SPDX-License-Identifier: BSD-3-Clause
// One flight of a shipped mission through the software flight controller in virtual time (fcu_virtual), which
// publishes what a real controller does: no ground contact, no thrust, no crash. The truth judges.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::hardware_bench {

/// What happens on the way. Times are of the flight; below 0: not.
struct Case {
  std::string mission = "return_home";
  std::string name = "as planned";
  double height_off_m = 0;      ///< the runway is given that much too high
  double no_fix_landed_s = -1;  ///< so long after it has landed the receiver loses its fix, for 20 s
  double no_fix_ground_s = -1;  ///< so long after the first command, standing or in the take-off run, for 3 s
  double watch_s = 30;          ///< how long it is watched after the landing
};

struct Landing {
  std::uint64_t seed = 0;
  bool crashed = false, landed = false, flew = false, again = false;  ///< again: airborne after it has landed
  double recognised_s = 1e9;  ///< of the touch-down, after the true one
  double throttle_after = 0;  ///< largest command to the motor after it has landed
  double takeoff_m = 0;       ///< height at which the phase of the take-off ended
  std::string phases, reason;
};

inline core::Graph graph_of(const Case& c, std::uint64_t seed, const std::filesystem::path& folder) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs/";
  const std::filesystem::path file = folder / ("hardware_" + c.mission + ".yaml");
  std::ofstream(file) << "mission: hardware\nextends: " << configs << "missions/" << c.mission
                      << ".yaml\narm: off\nlive: off\ndone: {when: \"ground.state.landed\", for: "
                      << c.watch_s << " s}\ntimeout: 900 s\nsummary: null\ncomponents:\n  sim: null\n"
                      << "  craft: {fills: vehicle, use: " FULMAR_TEST_PLUGIN_DIR
                         "/fcu_virtual.so, in: {state: nav.state, ground: ground.state}}\n";
  core::Overrides o;
  o.seed = seed;
  if (c.height_off_m != 0) o.set.emplace_back("land.runway.up", std::to_string(c.height_off_m) + " m");
  if (c.no_fix_ground_s >= 0) {
    o.set.emplace_back("craft.no_fix_from", std::to_string(c.no_fix_ground_s));
    o.set.emplace_back("craft.no_fix_until", std::to_string(c.no_fix_ground_s + 3));
  }
  return core::load_mission(file.string(), o);
}

class Watched {
 public:
  Watched(const core::Graph& graph, const Case& c, std::uint64_t seed) : case_(c), flight_(graph, options()) {
    out_.seed = seed;
    truth_ = output_of(graph, "craft", "truth");
    contact_ = output_of(graph, "craft", "contact");
    script_ = output_of(graph, "craft", "script_s");
    ground_ = output_of(graph, "ground", "state");
    actuators_ = output_of(graph, "attitude", "actuators");
  }

  Landing fly() {
    while (flight_.step()) look();
    const core::FlightResult result = flight_.finish();
    out_.reason = result.reason;
    return out_;
  }

 private:
  static core::FlightOptions options() {
    core::FlightOptions o;
    o.log = false;
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }

  void look() {
    const double now = 1e-9 * static_cast<double>(flight_.now_ns());
    if (flight_.phase() != phase_) {
      if (phase_ == "takeoff")
        if (const auto* const x = at<VehicleState>(truth_)) out_.takeoff_m = x->height_m;
      phase_ = flight_.phase();
      out_.phases += (out_.phases.empty() ? "" : " ") + phase_;
    }
    const auto* const x = at<VehicleState>(truth_);
    const auto* const contact = at<ContactTruth>(contact_);
    const auto* const ground = at<GroundState>(ground_);
    if (!x || !contact || !ground) return;
    out_.crashed = out_.crashed || contact->crashed;
    out_.flew = out_.flew || x->height_m > 5;
    if (out_.flew && contact->touching && touched_s_ < 0) touched_s_ = now;
    if (touched_s_ >= 0 && ground->contact == Contact::ground && out_.recognised_s == 1e9)
      out_.recognised_s = now - touched_s_;
    if (ground->landed && !std::exchange(out_.landed, true)) landed(now);
    if (!out_.landed) return;
    if (const auto* const u = at<Actuators>(actuators_); u && !ground->throttle_locked)
      out_.throttle_after = std::max(out_.throttle_after, u->throttle_frac);
    out_.again = out_.again || x->height_m > rest_m_ + 1;
  }
  void landed(double) {
    const auto* const x = at<VehicleState>(truth_);
    rest_m_ = x->height_m;
    if (case_.no_fix_landed_s < 0) return;
    const double t = *at<double>(script_) + case_.no_fix_landed_s;
    set("no_fix_from", t);
    set("no_fix_until", t + 20);
  }
  void set(const char* param, double number) {
    core::ParamValue value;
    value.number[0] = number;
    core::set_parameter(flight_, "craft", param, value);
  }

  Case case_;
  core::Flight flight_;
  core::Source truth_, contact_, script_, ground_, actuators_;
  Landing out_;
  std::string phase_;
  double touched_s_ = -1, rest_m_ = 0;
};

inline Landing fly(const Case& c, std::uint64_t seed, const std::filesystem::path& folder) {
  return Watched(graph_of(c, seed, folder), c, seed).fly();
}

}  // namespace fulmar::hardware_bench
