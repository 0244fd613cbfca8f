// SPDX-License-Identifier: BSD-3-Clause
// Runs a case of draw.hpp, and evaluates it by the truth and by the lines that the flight reports.
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/failures/draw.hpp"
#include "core/run/flight.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/output_of.hpp"
#include "core/run/verdict.hpp"
#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::failing_flights {

namespace fs = std::filesystem;

/// Class of a flight and of its reports.
enum class Class : std::uint8_t {
  done,    ///< the mission was completed, by the truth
  named,   ///< not completed, and a reason names the failure
  other,   ///< not completed and reported, with another reason
  silent,  ///< not completed, but reported as flown, without a reason
};
inline const char* word(Class c) {
  static constexpr const char* words[] = {"mission done", "reason named", "another reason", "silent"};
  return words[static_cast<std::size_t>(c)];
}

/// Requirements of a mission, by the truth: largest time off the plan, and the place of the end of a landing.
struct Asked {
  static constexpr double level_m = 40, height_m = 15, for_s = 3;
  static constexpr double runway_m = 330, before_m = 30, aside_m = 15;
};

struct Flown {
  Class of = Class::done;
  std::string verdict, missed{}, reason{};  ///< missed: part of the mission; reason: the decisive line
  std::vector<std::string> lines{};         ///< since the failure
  bool failed_at_all = false;               ///< the flight lasted until the failure
};

class FailingFlight {
 public:
  FailingFlight(const Drawn& drawn, const core::Graph& graph)
      : d_(drawn), graph_(graph), flight_(graph, options()) {
    truth_ = core::output_of(graph, "sim", "truth");
    contact_ = core::output_of(graph, "sim", "contact");
    plan_ = core::output_of(graph, "plan", "plan");
    progress_ = core::output_of(graph, "manage", "progress");
  }

  Flown fly() {
    while (flight_.step()) {
      now_s_ = 1e-9 * static_cast<double>(flight_.now_ns());
      const auto* const x = at<VehicleState>(truth_);
      const auto* const touch = at<ContactTruth>(contact_);
      if (!x || !touch) continue;
      if (aloft_s_ < 0 && x->height_m > 5 && !touch->touching) aloft_s_ = now_s_;
      crashed_ = touch->crashed;
      last_ = *x;
      fail();
      off_plan(*x);
    }
    const core::FlightResult result = flight_.finish();
    flown_.verdict = core::verdict_of(graph_, flight_, result);
    flown_.failed_at_all = failed_s_ >= 0;
    judge(result);
    return flown_;
  }

 private:
  core::FlightOptions options() {
    core::FlightOptions o;
    o.log = false;
    o.say = [this](const std::string& line, bool) {
      if (failed_s_ >= 0 && line.find("phase ") == std::string::npos &&
          line.find("phase_entered") == std::string::npos)
        flown_.lines.push_back(line);
    };
    return o;
  }
  template <class T>
  const T* at(const core::Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }

  void set(double share) {
    if (d_.fault.kind != FaultKind::none) {
      FaultRequest r = d_.fault;
      if (share <= 0) {
        r.kind = FaultKind::none;
        r.size_ratio = 0;
      }
      core::request(flight_, "sim", "fault", r);
      return;
    }
    for (const Setting& s : d_.settings) {
      core::ParamValue value;
      for (std::size_t i = 0; i < 3; ++i) value.number[i] = s.back[i] + share * (s.value[i] - s.back[i]);
      value.integer = static_cast<std::int64_t>(value.number[0]);
      core::set_parameter(flight_, "sim", s.name, value);
    }
  }
  void fail() {
    if (failed_s_ < 0 && aloft_s_ >= 0 && now_s_ >= aloft_s_ + d_.at_s) {
      failed_s_ = now_s_;
      set(d_.grows_s > 0 ? 0.01 : 1);
    }
    if (failed_s_ >= 0 && !over_ && share_ < 1 && d_.grows_s > 0 &&
        now_s_ >= failed_s_ + (share_ + 0.02) * d_.grows_s) {
      share_ = std::min(1.0, share_ + 0.02);
      set(share_);
    }
    if (failed_s_ >= 0 && !over_ && d_.lasts_s > 0 && now_s_ >= failed_s_ + d_.lasts_s) {
      over_ = true;
      set(0);
    }
  }

  /// Time during which the aircraft is far from the plan that is reported as active.
  void off_plan(const VehicleState& x) {
    const auto* const plan = at<Plan>(plan_);
    const auto* const progress = at<Progress>(progress_);
    const bool follows = plan && progress && progress->reached > 0 && !progress->joining &&
                         progress->plan_revision == plan->revision && flight_.phase() == "cruise";
    if (!follows) return;
    const double dt_s = now_s_ - looked_s_;
    if (dt_s < 0.1) return;
    looked_s_ = now_s_;
    const RoutePoint nearest = nearest_of(Route(*plan), *progress, x);
    const double height_m = std::abs(nearest.height_m - x.height_m);
    const bool off = nearest.distance_m > Asked::level_m || height_m > Asked::height_m;
    off_s_ = off ? off_s_ + std::min(dt_s, 1.0) : 0;
    if (off_s_ < Asked::for_s) return;
    worst_level_m_ = std::max(worst_level_m_, nearest.distance_m);
    worst_height_m_ = std::max(worst_height_m_, height_m);
  }
  static RoutePoint nearest_of(const Route& route, const Progress& progress, const VehicleState& x) {
    const double north = x.position_m.north, east = x.position_m.east;
    if (progress.finished) {
      const RouteOrbit o = route.final_orbit();
      return {o.north_m, o.east_m, o.height_m,
              std::abs(std::hypot(north - o.north_m, east - o.east_m) - o.radius_m)};
    }
    static std::array<RouteLeg, 16> legs;
    NearestSearch search(north, east);
    for (std::uint32_t i = route.closed() ? 0 : 1; i < route.size(); ++i)
      search.consider(legs[i % legs.size()] = route.leg(i));
    return search.result();
  }

  bool lands() const {
    return d_.mission == "return_home" || d_.mission == "runway_to_runway" || d_.mission == "hand_launch";
  }
  /// "": on the runway, which begins at the origin and points to 135 deg.
  std::string off_runway() const {
    const double n = last_.position_m.north, e = last_.position_m.east, half = std::sqrt(0.5);
    const double along = half * (e - n), aside = std::abs(half * (-e - n));
    char text[64] = "";
    if (along < -Asked::before_m || along > Asked::runway_m || aside > Asked::aside_m)
      std::snprintf(text, sizeof text, "%.0f m along, %.0f m beside the runway", along, aside);
    return text;
  }

  std::string missed(const core::FlightResult& result) const {
    if (crashed_) return "crashed";
    char text[64];
    std::snprintf(text, sizeof text, "%.0f m beside, %.0f m above or below the plan", worst_level_m_,
                  worst_height_m_);
    if (worst_level_m_ > 0) return text;
    if (result.outcome != core::Outcome::flown) return "not to its end";
    return lands() ? off_runway() : "";
  }

  bool names(const std::string& line) const {
    return std::any_of(d_.names.begin(), d_.names.end(),
                       [&](const std::string& name) { return line.find(name) != std::string::npos; });
  }
  /// Figures of a crash are not a reason. An answer of safety before it may be one.
  std::string story() const {
    const std::size_t before = flown_.verdict.find("before: ");
    if (before != std::string::npos) return flown_.verdict.substr(before);
    return flown_.verdict.find("crashed") == 0 ? "" : flown_.verdict;
  }
  void judge(const core::FlightResult& result) {
    flown_.missed = missed(result);
    if (flown_.missed.empty()) return;
    const auto line = std::find_if(flown_.lines.begin(), flown_.lines.end(),
                                   [&](const std::string& l) { return names(l); });
    if (line != flown_.lines.end() || names(story())) {
      flown_.of = Class::named;
      flown_.reason = line != flown_.lines.end() ? *line : flown_.verdict;
      return;
    }
    const bool called_flown = result.outcome == core::Outcome::flown;
    flown_.of = called_flown ? Class::silent : Class::other;
    flown_.reason = flown_.lines.empty() ? flown_.verdict : flown_.lines.front();
  }

  const Drawn& d_;
  const core::Graph& graph_;
  Flown flown_;
  double now_s_ = 0, aloft_s_ = -1, failed_s_ = -1, off_s_ = 0, looked_s_ = 0;
  double worst_level_m_ = 0, worst_height_m_ = 0;
  double share_ = 0;
  bool over_ = false, crashed_ = false;
  VehicleState last_;
  core::Flight flight_;
  core::Source truth_, contact_, plan_, progress_;
};

inline Flown fly(const Drawn& drawn, unsigned seed, const fs::path& folder) {
  const fs::path file = folder / "drawn.yaml";
  std::ofstream(file) << "mission: drawn\nlive: off\ntimeout: 600 s\nextends: " FULMAR_SOURCE_DIR
                         "/configs/missions/"
                      << drawn.mission << ".yaml\n";
  core::Overrides overrides;
  overrides.seed = seed;
  const core::Graph graph = core::load_mission(file.string(), overrides);
  return FailingFlight(drawn, graph).fly();
}

}  // namespace fulmar::failing_flights
