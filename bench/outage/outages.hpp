// SPDX-License-Identifier: BSD-3-Clause
// A recorded flight with a time without fixes: error of the estimate at the last withheld fix.
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fulmar/flight/earth/geodesy.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/schema.hpp>
#include <fulmar/testing.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/outage/messages.hpp"
#include "core/graph/record.hpp"
#include "core/graph/yaml.hpp"
#include "core/loader/table.hpp"
#include "core/run/flight.hpp"
#include "plugins/sensor_log/recorded.hpp"

namespace fulmar::outage {

struct Fix {
  double arrived_s = 0, valid_s = 0;
  Gnss gnss;
};

/// Errors at the last withheld fix.
struct Outcome {
  double start_s = 0, after_s = 0;  ///< after: time since the last possible arrival of a used fix
  double horizontal_m = 0, claimed_m = 0;
  double height_m = 0, height_claimed_m = 0;  ///< height: above the receiver's
};

/// With all fixes: root mean squares of the difference from the fixes, which have errors themselves.
struct Aided {
  int fixes = 0;
  double horizontal_m = 0, height_m = 0, height_claimed_m = 0, down_mps = 0;
  double step_m = 0;  ///< largest change of height from one state to the next, beyond that of the climb
};

struct Recipe {
  std::string log, folder, mission = "configs/missions/sensor_log.yaml";
  core::Overrides overrides;
};

/// The description, read as by the host.
inline sensor_log::Description description_file(const std::string& path) {
  core::Report report;
  const core::Node root = core::parse_yaml(core::read_source(path, path), report);
  sensor_log::Description d;
  core::fill_record(*core::copy_type(fulmar::describe<sensor_log::Description>()), root,
                    reinterpret_cast<std::byte*>(&d), "", report);
  report.throw_if_any();
  return d;
}

/// Every three-dimensional fix of the recording.
inline std::vector<Fix> fixes_of(sensor_log::Description description, const std::string& folder) {
  description.gnss.withhold = {};
  Bench<sensor_log::Recorded> bench;
  bench.params.log.value = description;
  bench.params.folder.value = Text<256>(folder);
  std::vector<Fix> fixes;
  do {
    if (bench.read() != Status::ok) throw std::runtime_error(bench.error());
    if (!bench.out.gnss.written || bench.out.gnss.value.fix < FixType::fix_3d) continue;
    fixes.push_back({1e-9 * static_cast<double>(bench.tick.now_ns),
                     1e-9 * static_cast<double>(bench.out.gnss.valid_at_ns), bench.out.gnss.value});
  } while (!bench.out.recording.ended);
  return fixes;
}

inline core::Source output_of(const core::Graph& graph, const std::string& role, const std::string& port) {
  for (std::size_t i = 0; i < graph.roles.size(); ++i)
    for (std::size_t k = 0; graph.roles[i].name == role && k < graph.roles[i].outputs.size(); ++k)
      if (graph.roles[i].outputs[k].name == port)
        return {core::Source::Kind::role, static_cast<int>(i), static_cast<int>(k)};
  throw std::runtime_error("the mission has no role " + role + " with " + port);
}

class Outages {
 public:
  explicit Outages(Recipe recipe)
      : recipe_(std::move(recipe)),
        description_(description_file(recipe_.log)),
        fixes_(fixes_of(description_, recipe_.folder)) {}

  Outcome fly(double start_s, double seconds) const {
    const Fix& last = last_withheld(start_s, start_s + seconds);
    Outcome outcome;
    const auto between = [&](const Moment& a, const Moment& b) {
      if (b.t_s < last.valid_s) return true;
      outcome = compare(a, b, last, start_s);
      return false;
    };
    const std::string reason = each(windows(start_s, start_s + seconds), last.valid_s + 1, between);
    if (!reason.empty())
      throw std::runtime_error("the flight of the outage at " + std::to_string(start_s) + " s: " + reason);
    return outcome;
  }

  /// The whole recording with all fixes, compared with each fix that is valid in the air; with all of them
  /// when none is.
  Aided aided() const {
    Aided sums;
    std::size_t next = 0;
    const bool flies =
        std::any_of(fixes_.begin(), fixes_.end(), [&](const Fix& f) { return airborne(f.valid_s); });
    const auto between = [&](const Moment& a, const Moment& b) {
      if (!flies || airborne(b.t_s)) {
        const double climbed = b.state.climb_rate_mps * (b.t_s - a.t_s);
        sums.step_m = std::max(sums.step_m, std::abs(b.state.height_m - a.state.height_m - climbed));
      }
      for (; next < fixes_.size() && fixes_[next].valid_s <= b.t_s; ++next)
        if (fixes_[next].valid_s > a.t_s && (!flies || airborne(fixes_[next].valid_s)))
          add(sums, a, b, fixes_[next]);
      return next < fixes_.size();
    };
    const std::string reason = each(windows(), fixes_.back().valid_s + 1, between);
    if (!reason.empty()) throw std::runtime_error("the flight with all fixes: " + reason);
    for (double* const mean : {&sums.horizontal_m, &sums.height_m, &sums.height_claimed_m, &sums.down_mps})
      *mean = std::sqrt(*mean / std::max(sums.fixes, 1));
    return sums;
  }

 private:
  struct Moment {
    double t_s = -1;
    VehicleState state;
  };

  /// Runs the recording without the fixes in `withheld`, and calls between(earlier, later) for two
  /// consecutive states until it returns false. Returns the reason when it never does, or "".
  template <class Between>
  std::string each(const std::string& withheld, double duration_s, Between&& between) const {
    core::Overrides overrides = recipe_.overrides;
    const std::vector<std::pair<std::string, std::string>> here = {
        {"recorded.log", std::filesystem::absolute(recipe_.log).string()},
        {"recorded.folder", recipe_.folder},
        {"recorded.log.gnss.withhold", withheld}};
    overrides.set.insert(overrides.set.begin(), here.begin(), here.end());
    const core::Graph graph = core::load_mission(recipe_.mission, overrides);
    const core::Source source = output_of(graph, "nav", "state");
    core::FlightOptions options;
    options.log = false;
    options.duration_s = duration_s;
    core::Flight flight(graph, options);
    Moment before, after;
    bool goes_on = true;
    while (goes_on && flight.step()) {
      const std::byte* const bytes = flight.sample(source);
      if (!bytes) continue;
      before = after;
      std::memcpy(&after.state, bytes, sizeof after.state);
      after.t_s = 1e-9 * static_cast<double>(flight.now_ns());
      if (before.t_s >= 0) goes_on = between(before, after);
    }
    const core::FlightResult result = flight.finish();
    return goes_on || !result.guards.empty() ? result.reason : "";
  }

  bool airborne(double t_s) const {
    return t_s > 0 && t_s >= description_.airborne.from_s && t_s <= description_.airborne.to_s;
  }

  const Fix& last_withheld(double from_s, double to_s) const {
    const Fix* last = nullptr;
    for (const Fix& fix : fixes_)
      if (fix.arrived_s >= from_s && fix.arrived_s < to_s) last = &fix;
    if (fixes_.empty()) throw std::runtime_error(outage_messages::fixes_missing(recipe_.log));
    if (!last || fixes_.back().arrived_s < to_s)
      throw std::runtime_error(outage_messages::fixes_outside(
          sensor_log::seconds(from_s), sensor_log::seconds(to_s), recipe_.log,
          sensor_log::seconds(fixes_.front().arrived_s), sensor_log::seconds(fixes_.back().arrived_s)));
    return *last;
  }

  /// Windows, with those of the description.
  std::string windows(double from_s, double to_s) const {
    const std::string reported = windows();
    return reported.substr(0, reported.size() - 1) + (reported == "[]" ? "" : ", ") + window(from_s, to_s) +
           "]";
  }
  std::string windows() const {
    std::string text = "[";
    for (const sensor_log::Window& w : description_.gnss.withhold)
      text += (text == "[" ? "" : ", ") + window(w.from_s, w.to_s);
    return text + "]";
  }
  static std::string window(double from_s, double to_s) {
    return "{from: " + sensor_log::seconds(from_s) + ", to: " + sensor_log::seconds(to_s) + "}";
  }

  static double part_of(const Moment& a, const Moment& b, const Fix& fix) {
    return (fix.valid_s - a.t_s) / (b.t_s - a.t_s);
  }
  /// Estimate minus receiver, m, NED, at the time of the fix.
  static Eigen::Vector3d off(const Moment& a, const Moment& b, const Fix& fix) {
    const LocalFrame frame(b.state.origin_latitude_deg, b.state.origin_longitude_deg,
                           b.state.origin_altitude_m);
    const Eigen::Vector3d there =
        frame.to_ned(fix.gnss.latitude_deg, fix.gnss.longitude_deg, fix.gnss.altitude_m);
    const Eigen::Vector3d from = eigen(a.state.position_m);
    return from + part_of(a, b, fix) * (eigen(b.state.position_m) - from) - there;
  }
  static Outcome compare(const Moment& a, const Moment& b, const Fix& fix, double start_s) {
    const Eigen::Vector3d error = off(a, b, fix);
    Outcome o;
    o.start_s = start_s;
    o.after_s = fix.valid_s - start_s;
    o.horizontal_m = error.head<2>().norm();
    o.claimed_m = std::hypot(b.state.position_std_m.north, b.state.position_std_m.east);
    o.height_m = -error.z();
    o.height_claimed_m = b.state.position_std_m.down;
    return o;
  }
  static void add(Aided& sums, const Moment& a, const Moment& b, const Fix& fix) {
    const Eigen::Vector3d error = off(a, b, fix);
    const double k = part_of(a, b, fix), from = a.state.velocity_mps.down;
    const double down = from + k * (b.state.velocity_mps.down - from) - fix.gnss.velocity_mps.down;
    ++sums.fixes;
    sums.horizontal_m += error.head<2>().squaredNorm();
    sums.height_m += error.z() * error.z();
    sums.height_claimed_m += b.state.position_std_m.down * b.state.position_std_m.down;
    sums.down_mps += down * down;
  }

  Recipe recipe_;
  sensor_log::Description description_;
  std::vector<Fix> fixes_;
};

/// Quantile of `values`, with linear interpolation.
inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const std::size_t i = static_cast<std::size_t>(at), next = std::min(i + 1, values.size() - 1);
  return values[i] + (at - static_cast<double>(i)) * (values[next] - values[i]);
}

inline double rms(const std::vector<double>& values) {
  double squares = 0;
  for (const double x : values) squares += x * x;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace fulmar::outage
