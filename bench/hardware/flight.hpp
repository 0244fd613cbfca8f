// SPDX-License-Identifier: BSD-3-Clause
// One flight of a mission through the software flight controller in virtual time (fcu_virtual). It publishes
// the messages of a real controller: no ground contact, no thrust, no crash. The truth is the reference.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/hardware/cases.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/output_of.hpp"
#include "fulmar/msg/autotune_report.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "tools/fulmar_replay/replay.hpp"

namespace fulmar::hardware_bench {

namespace fs = std::filesystem;

inline constexpr double recognised_95_s = 0.3, recognised_most_s = 0.6;

struct Landing {
  std::uint64_t seed = 0;
  bool crashed = false, landed = false, flew = false, again = false;  ///< again: airborne after the landing
  double recognised_s = 1e9;   ///< delay of the detected touch-down after the true one; below 0: before it
  double throttle_after = 0;   ///< largest throttle of the motor after the landing
  double takeoff_m = 0;        ///< height at the end of the take-off phase
  bool replayed_equal = true;  ///< also true without a replay
  bool tuned = false;
  std::vector<std::string> phases;
  std::vector<std::pair<double, std::string>> said;
  double last_event_s = -1;
  std::string reason;

  bool has(const std::string& phase) const {
    return std::find(phases.begin(), phases.end(), phase) != phases.end();
  }
  std::string flown() const {
    std::string all;
    for (const std::string& p : phases) all += (all.empty() ? "" : " ") + p;
    return all;
  }
};

inline bool in_order(const std::vector<std::string>& flown, const std::vector<std::string>& wanted) {
  std::size_t next = 0;
  for (const std::string& phase : flown)
    if (next < wanted.size() && phase == wanted[next]) ++next;
  return next == wanted.size();
}

/// `parts`: one, or several separated by '|': a sentence and its code.
inline bool holds_one_of(const std::string& line, const std::string& parts) {
  std::istringstream all(parts);
  for (std::string part; std::getline(all, part, '|');)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

/// "": the flight meets its case. Otherwise the first deviation.
inline std::string verdict(const Case& c, const Landing& l) {
  if (l.crashed) return "crashed";
  if (l.again) return "took off again by itself";
  if (!l.landed) return "did not land";
  if (l.throttle_after > 0) return "motor on after the landing";
  if (l.takeoff_m < 20) return "the take-off ended early";
  for (const std::string& phase : c.never)
    if (l.has(phase)) return "flew " + phase;
  if (!in_order(l.phases, c.phases)) return "left out a phase";
  for (const std::string& words : c.reported)
    if (std::none_of(l.said.begin(), l.said.end(), [&](const auto& line) {
          return holds_one_of(line.second, words) && line.first >= l.last_event_s &&
                 line.first <= l.last_event_s + c.reported_within_s;
        }))
      return "no line with \"" + words + "\"";
  if (c.tunes && !l.tuned) return "the autotune was aborted";
  if (!l.replayed_equal) return "its log replays otherwise";
  if (std::abs(l.recognised_s) > recognised_most_s) return "touch-down recognised late";
  return "";
}

inline core::Graph graph_of(const Case& c, std::uint64_t seed, const fs::path& folder) {
  const std::string source = FULMAR_SOURCE_DIR "/",
                    base = c.mission == "safe" ? "bench/hardware/" : "configs/missions/";
  const bool lands = c.height_off_m != 0;
  const fs::path file = folder / ("hardware_" + c.mission + ".yaml");
  std::ofstream(file) << "mission: hardware\nextends: " << source << base << c.mission
                      << ".yaml\narm: off\nlive: off\ndone: {when: \"ground.state.landed\", for: "
                      << c.watch_s << " s}\ntimeout: 900 s\nsummary: null\ncomponents:\n  sim: null\n"
                      << (c.mission == "manual" ? "  pilot: null\n  keys: null\n  radio: {only: sim}\n" : "")
                      << "  craft: {fills: vehicle, use: " FULMAR_TEST_PLUGIN_DIR
                         "/fcu_virtual.so, in: {state: nav.state, ground: ground.state}}\n";
  core::Overrides o;
  o.seed = seed;
  o.set = c.set;
  if (lands) o.set.emplace_back("land.runway.up", std::to_string(c.height_off_m) + " m");
  return core::load_mission(file.string(), o);
}

class Watched {
 public:
  /// `log`: a file to write; empty: none.
  Watched(const core::Graph& graph, const Case& c, std::uint64_t seed, const fs::path& log)
      : case_(c), done_(c.events.size(), false), due_s_(c.events.size(), -1), flight_(graph, options(log)) {
    out_.seed = seed;
    truth_ = output_of(graph, "craft", "truth");
    contact_ = output_of(graph, "craft", "contact");
    script_ = output_of(graph, "craft", "script_s");
    throttle_ = output_of(graph, "craft", "throttle_ratio");
    ground_ = output_of(graph, "ground", "state");
    if (c.tunes) tune_ = output_of(graph, "attitude", "report");
  }

  Landing fly() {
    while (flight_.step()) look();
    const core::FlightResult result = flight_.finish();
    out_.reason = result.reason;
    return out_;
  }

 private:
  core::FlightOptions options(const fs::path& log) {
    core::FlightOptions o;
    o.log = !log.empty();
    o.log_file = log;
    o.say = [this](const std::string& line, bool) { out_.said.emplace_back(now_s_, line); };
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }

  void look() {
    now_s_ = 1e-9 * static_cast<double>(flight_.now_ns());
    const auto* const x = at<VehicleState>(truth_);
    if (out_.phases.empty() || flight_.phase() != out_.phases.back()) {
      if (x && !out_.phases.empty() && out_.phases.back() == "takeoff") out_.takeoff_m = x->height_m;
      out_.phases.push_back(flight_.phase());
      begin(flight_.phase());
    }
    if (const auto* const t = at<double>(script_); t && *t >= 0) begin("start");
    act();
    const auto* const contact = at<ContactTruth>(contact_);
    const auto* const ground = at<GroundState>(ground_);
    if (x && contact && ground) judge(*x, *contact, *ground);
  }

  void judge(const VehicleState& x, const ContactTruth& contact, const GroundState& ground) {
    out_.crashed = out_.crashed || contact.crashed;
    out_.flew = out_.flew || x.height_m > 5;
    if (out_.flew && contact.touching && touched_s_ < 0) touched_s_ = now_s_;
    const bool grounded = out_.flew && ground.contact == Contact::ground;
    if (grounded && recognised_s_ < 0) recognised_s_ = now_s_;
    if (touched_s_ >= 0 && recognised_s_ >= 0) out_.recognised_s = recognised_s_ - touched_s_;
    if (tune_.kind != core::Source::Kind::none)
      if (const auto* const report = at<AutotuneReport>(tune_))
        out_.tuned = report->stage == AutotuneStage::finished;
    if (out_.flew && ground.landed && !std::exchange(out_.landed, true)) {
      rest_m_ = x.height_m;
      begin("landed");
    }
    if (!out_.landed) return;
    out_.throttle_after = std::max(out_.throttle_after, *at<double>(throttle_));
    out_.again = out_.again || x.height_m > rest_m_ + 1;
  }

  /// Records the first occurrence.
  void begin(const std::string& when) {
    for (std::size_t i = 0; i < case_.events.size(); ++i)
      if (case_.events[i].when == when && due_s_[i] < 0) due_s_[i] = now_s_ + case_.events[i].after_s;
  }
  void act() {
    for (std::size_t i = 0; i < case_.events.size(); ++i) {
      if (due_s_[i] < 0 || done_[i] || now_s_ < due_s_[i]) continue;
      done_[i] = true;
      out_.last_event_s = now_s_;
      const Event& e = case_.events[i];
      const double t = *at<double>(script_);
      if (e.lasts_s <= 0) set(e.param, e.value);
      if (e.lasts_s > 0) set(e.param + "_until", t + e.lasts_s);
      if (e.lasts_s > 0) set(e.param + "_from", t);
    }
  }
  void set(const std::string& param, double number) {
    core::ParamValue value;
    value.number[0] = number;
    core::set_parameter(flight_, "craft", param, value);
  }

  Case case_;
  std::vector<bool> done_;
  std::vector<double> due_s_;
  double now_s_ = 0, touched_s_ = -1, recognised_s_ = -1, rest_m_ = 0;
  Landing out_;
  core::Flight flight_;
  core::Source truth_, contact_, script_, throttle_, ground_, tune_;
};

/// Replays the log. Returns false for a difference.
inline bool replays_equal(const fs::path& log, const fs::path& again) {
  const core::Recording recording(log);
  core::ReplayOptions o;
  o.out = again;
  const auto [flight, result] = core::replay(recording, recording.mission({}, {}), o);
  return result.equal() && result.same_file && result.notes.empty();
}

inline Landing fly(const Case& c, std::uint64_t seed, const fs::path& folder, bool replayed = false) {
  const fs::path log = folder / "flight.mcap", again = folder / "again.mcap";
  Landing l = Watched(graph_of(c, seed, folder), c, seed, replayed ? log : fs::path()).fly();
  if (!replayed) return l;
  l.replayed_equal = replays_equal(log, again);
  fs::remove(log);
  fs::remove(again);
  return l;
}

}  // namespace fulmar::hardware_bench
