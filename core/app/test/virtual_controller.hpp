// SPDX-License-Identifier: BSD-3-Clause
// Flights of the shipped autopilot through the software flight controller in virtual time (fcu_virtual), in
// which the link is interrupted or the receiver loses its fix; and the measured figures of them.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/app/test/hourglass.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::core::through_controller {

using test::Hourglass;
using test::pi;

/// The hourglass at `height_m` with fcu_serial on its software controller. `folder` holds its input files.
inline Graph mission(const std::filesystem::path& folder, double height_m, unsigned seed,
                     const std::vector<std::pair<std::string, std::string>>& set = {}) {
  const std::string configs = FULMAR_SOURCE_DIR "/configs/";
  const std::filesystem::path file = folder / "virtual.yaml", plan = folder / "plan.yaml";
  std::ofstream(plan) << Hourglass::text(height_m);
  std::ofstream(file)
      << "mission: virtual\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\n"
      << "origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: " << seed
      << "\narm: off\nlive: off\ncomponents:\n  sim:  {fills: vehicle, use: "
      << FULMAR_TEST_PLUGIN_DIR "/fcu_virtual.so, in: {state: nav.state}}\n"
      << "  plan: {params: {plan: " << plan.string() << "}}\nphases:\n"
      << "  takeoff: {next: [{to: cruise, when: \"nav.state.height_m > 25 m\", for: 0.5 s}]}\n";
  Overrides overrides;
  overrides.set = set;
  return load_mission(file.string(), overrides);
}

struct Row {
  double t_s = 0, script_s = 0;
  double north_m = 0, east_m = 0, height_m = 0, roll_rad = 0, course_rad = 0;  ///< truth
  double off_estimate_m = 0, std_m = 0;  ///< the estimate and its reported standard deviation
  bool attitude_valid = false, host = false, circles = false;
};

/// A flight that is observed tick by tick.
class Flown {
 public:
  Flown(const Graph& graph, const FlightOptions& options) : flight_(graph, watched(options)) {
    truth_ = look(graph, "sim", "truth");
    state_ = look(graph, "ekf", "state");
    script_ = look(graph, "sim", "script_s");
    host_ = look(graph, "sim", "host_ratio");
    blind_ = look(graph, "sim", "blind_ratio");
    sticks_ = look(graph, "sim", "sticks_ratio");
    cross_ = look(graph, "follow", "cross_track_m");
  }
  bool step() {
    const bool goes_on = flight_.step();
    now_s_ = 1e-9 * static_cast<double>(flight_.now_ns());
    return goes_on;
  }
  /// Flies while `wanted` holds for the present row; false: the flight ended before.
  template <class Wanted>
  bool fly_while(Wanted wanted) {
    while (wanted(row())) {
      rows.push_back(row());
      if (!step()) return false;
    }
    return true;
  }
  void set(const char* param, double number) {
    ParamValue value;
    value.number[0] = number;
    set_parameter(flight_, "sim", param, value);
  }
  Row row() const {
    Row r;
    r.t_s = now_s_;
    r.script_s = probe(script_);
    r.host = probe(host_) > 0.5;
    if (const auto* x = at<fulmar::VehicleState>(truth_)) {
      r.north_m = x->position_m.north;
      r.east_m = x->position_m.east;
      r.height_m = x->height_m;
      r.roll_rad = x->roll_rad;
      r.course_rad = x->course_rad;
      if (const auto* s = at<fulmar::VehicleState>(state_)) {
        r.off_estimate_m = std::hypot(s->position_m.north - r.north_m, s->position_m.east - r.east_m);
        r.std_m = std::max(s->position_std_m.north, s->position_std_m.east);
        r.attitude_valid = s->attitude_valid;
      }
    }
    r.circles = probe(cross_) == 0 && flight_.phase() == "cruise";
    return r;
  }
  const fulmar::VehicleState* state() const { return at<fulmar::VehicleState>(state_); }
  double blind() const { return probe(blind_); }    ///< commands without a valid attitude
  double sticks() const { return probe(sticks_); }  ///< distance of the outputs from the pilot's sticks
  const std::string& phase() const { return flight_.phase(); }
  FlightResult finish() { return flight_.finish(); }
  /// Time of the first message with this code since `from_s`; -1: none. Needs FULMAR_MESSAGES=codes.
  double reported_s(const std::string& code, double from_s) const {
    for (const auto& [t_s, line] : printed)
      if (t_s >= from_s && line.find(code) != std::string::npos) return t_s;
    return -1;
  }

  std::vector<Row> rows;
  std::vector<std::pair<double, std::string>> printed;

 private:
  FlightOptions watched(FlightOptions o) {
    o.say = [this](const std::string& line, bool) { printed.emplace_back(now_s_, line); };
    return o;
  }
  static Source look(const Graph& graph, const std::string& component, const std::string& output) {
    for (std::size_t i = 0; i < graph.components.size(); ++i)
      if (graph.components[i].name == component)
        return {Source::Kind::component, static_cast<int>(i), graph.components[i].info().output(output)};
    throw std::runtime_error("no component " + component);
  }
  template <class T>
  const T* at(const Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }
  double probe(const Source& source) const {
    const auto* value = at<double>(source);
    return value ? *value : -1;
  }

  double now_s_ = 0;
  Flight flight_;
  Source truth_, state_, script_, host_, blind_, sticks_, cross_;
};

/// One gap of the link, in a turn of the cruise; without GNSS: no fix for 60 s from its begin.
struct Gap {
  double length_s = 1;
  bool gnss = true;
  double height_m = 70;
  unsigned seed = 1;
};
inline constexpr double gap_without_fix_s = 60;

struct AfterGap {
  bool crashed = false;  ///< or the flight ended
  double blind = 0, sticks = 0;
  double lost_m = 0;       ///< below plan and take-over, while the host commands
  double lowest_m = 1e9;   ///< for the host and the pilot
  double back_s = -1;      ///< after the gap: the host commands again, before the fix returns
  double returned_s = -1;  ///< after the fix: the host commands
  bool reported_blind = false, reported_known = false;
};

inline AfterGap fly(const Gap& gap, const std::filesystem::path& folder, const FlightOptions& options) {
  const Graph graph = mission(folder, gap.height_m, gap.seed);
  Flown f(graph, options);
  AfterGap a;
  double cruise_s = -1;
  const auto before_turn = [&](const Row& r) {
    if (cruise_s < 0 && f.phase() == "cruise") cruise_s = r.t_s;
    return r.t_s < 300 && !(cruise_s > 0 && r.t_s > cruise_s + 15 && std::abs(r.roll_rad) > 0.4);
  };
  const auto for_s = [&](double s) {
    const double until = f.row().t_s + s;
    return f.fly_while([until](const Row& r) { return r.t_s < until; });
  };
  a.crashed = !f.fly_while(before_turn) || !for_s(0.5) || f.row().t_s > 299;
  const double at_s = f.row().script_s, begin_s = f.row().t_s, end_s = begin_s + gap.length_s,
               fix_s = begin_s + gap_without_fix_s;
  f.rows.clear();
  f.set("gap_from", at_s);
  f.set("gap_until", at_s + gap.length_s);
  if (!gap.gnss) {
    f.set("no_fix_from", at_s);
    f.set("no_fix_until", at_s + gap_without_fix_s);
  }
  a.crashed = a.crashed || !for_s(gap.gnss ? gap.length_s + 30 : gap_without_fix_s + 20);
  double from_m = gap.height_m;
  bool host = true;
  for (const Row& r : f.rows) {
    a.lowest_m = std::min(a.lowest_m, r.height_m);
    if (r.host && !host) from_m = std::min(gap.height_m, r.height_m);
    host = r.host;
    if (!host) continue;
    a.lost_m = std::max(a.lost_m, from_m - r.height_m);
    if (r.t_s > end_s && a.back_s < 0 && (gap.gnss || r.t_s < fix_s)) a.back_s = r.t_s - end_s;
    if (!gap.gnss && r.t_s >= fix_s && a.returned_s < 0) a.returned_s = r.t_s - fix_s;
  }
  a.crashed = a.crashed || a.lowest_m < 1;
  a.blind = f.blind();
  a.sticks = f.sticks();
  a.reported_blind = f.reported_s("fcu_serial.attitude_unknown", begin_s) >= 0;
  a.reported_known = f.reported_s("fcu_serial.attitude_known", begin_s) >= 0;
  f.finish();
  return a;
}

/// First violated limit of a gap; "": none.
inline std::string missed(const Gap& gap, const AfterGap& a) {
  const bool his = !gap.gnss && gap.length_s > 2;
  if (a.crashed) return "crashed";
  if (a.blind > 0) return std::to_string(a.blind) + " commands without a valid attitude";
  if (a.sticks > 0.01) return "the pilot's sticks did not work";
  if (a.lost_m > 15) return std::to_string(a.lost_m) + " m lost";
  if (his && a.back_s >= 0) return "commands without a fix";
  if (!his && (a.back_s < 0 || a.back_s > 1)) return "no command within 1 s";
  if (!gap.gnss && (a.returned_s < 0 || a.returned_s > 2)) return "no command within 2 s of the fix";
  if (his && !(a.reported_blind && a.reported_known)) return "not told who has it";
  return "";
}

/// The receiver has no fix for a while, in cruise; with an even seed it sends no data at all.
struct Outage {
  double length_s = 100;
  unsigned seed = 1;
  double max_std_m = 50;  ///< the plan is followed up to this
};

struct AfterOutage {
  bool crashed = false;
  double plan_m = 0;      ///< from the plan at the end of the outage, 100 s after its begin, or at the circle
  double reckoned_m = 0;  ///< the estimate's error there
  double std_m = 0;       ///< reported standard deviation of the estimate
  double circle_s = -1;   ///< after the loss: the circle begins
  double turned_deg = 0;  ///< to the right, in the circle
  double reported_lost_s = -1;  ///< after the loss
  double reported_back_s = -1;  ///< after the return
  double resumed_s = -1;        ///< after the return: back on the plan, within 10 m
};

inline AfterOutage fly(const Outage& outage, const std::filesystem::path& folder,
                       const FlightOptions& options) {
  constexpr double before_s = 100, after_s = 60, reckons_s = 100, near_m = 10;
  const Hourglass plan;
  const Graph graph =
      mission(folder, 70, outage.seed, {{"follow.reckon_std", std::to_string(outage.max_std_m) + " m"}});
  Flown f(graph, options);
  AfterOutage a;
  a.crashed = !f.fly_while([&](const Row& r) { return f.phase() != "cruise" && r.t_s < 60; });
  const auto until = [&](double t_s) {
    a.crashed = a.crashed || !f.fly_while([t_s](const Row& r) { return r.t_s < t_s; });
  };
  until(f.row().t_s + before_s);
  const double begin_s = f.row().t_s, end_s = begin_s + outage.length_s, at_s = f.row().script_s;
  const bool silent = outage.seed % 2 == 0;
  f.set(silent ? "gnss_silent_from" : "no_fix_from", at_s);
  f.set(silent ? "gnss_silent_until" : "no_fix_until", at_s + outage.length_s);
  f.rows.clear();
  const double reckoned_s = begin_s + std::min(outage.length_s, reckons_s);
  a.crashed = a.crashed || !f.fly_while([=](const Row& x) { return x.t_s < reckoned_s && !x.circles; });
  const Row r = f.row();
  a.plan_m = plan.distance_m(r.north_m, r.east_m);
  a.reckoned_m = r.off_estimate_m;
  a.std_m = r.std_m;
  until(end_s);
  const auto circle = std::find_if(f.rows.begin(), f.rows.end(), [](const Row& x) { return x.circles; });
  if (circle != f.rows.end()) a.circle_s = circle->t_s - begin_s;
  for (auto x = circle; x < f.rows.end() - 1; ++x)
    a.turned_deg += 180 / pi * std::remainder((x + 1)->course_rad - x->course_rad, 2 * pi);
  until(end_s + after_s);
  for (std::size_t i = 0; i < f.rows.size() && a.resumed_s < 0; i += 40)
    if (f.rows[i].t_s > end_s && plan.distance_m(f.rows[i].north_m, f.rows[i].east_m) < near_m)
      a.resumed_s = f.rows[i].t_s - end_s;
  const auto since = [](double reported_s, double from_s) {
    return reported_s < 0 ? -1 : reported_s - from_s;
  };
  a.reported_lost_s = since(f.reported_s("fcu_serial.gnss_lost", begin_s), begin_s);
  a.reported_back_s = since(f.reported_s("fcu_serial.gnss_back(", end_s), end_s);
  f.finish();
  return a;
}

/// First violated limit of an outage. Its drift from the plan is random.
inline std::string missed(const Outage& outage, const AfterOutage& a) {
  constexpr double circle_s = 120, slack_s = 1;
  if (a.crashed) return "crashed";
  if (a.reported_lost_s < 0 || a.reported_lost_s > 1) return "the loss was not told within 1 s";
  if (a.reported_back_s < 0 || a.reported_back_s > 1) return "the return was not told within 1 s";
  if (a.circle_s > circle_s + slack_s || (a.circle_s < 0 && outage.length_s > circle_s + slack_s))
    return "no circle after " + std::to_string(circle_s) + " s";
  // The circle may begin in a turn to the other side, which takes 4 s to end.
  if (a.circle_s >= 0 && a.turned_deg < 5 * (outage.length_s - a.circle_s) - 20)
    return "a circle of " + std::to_string(a.turned_deg) + " deg";
  if (a.resumed_s < 0) return "not back on the plan";
  return "";
}

}  // namespace fulmar::core::through_controller
