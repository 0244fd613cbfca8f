// SPDX-License-Identifier: BSD-3-Clause
// A recorded flight without its fixes for a while: how far off the estimate is at the last one withheld.
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fulmar/flight/geodesy.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/schema.hpp>
#include <fulmar/testing.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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

/// At the last fix withheld.
struct Outcome {
  double start_s = 0, after_s = 0;  ///< after: since the last fix that was used could arrive
  double horizontal_m = 0, claimed_m = 0;
  double height_m = 0, height_claimed_m = 0;  ///< height: above the receiver's
};

struct Recipe {
  std::string log, folder, mission = "configs/missions/sensor_log.yaml";
  core::Overrides overrides;
};

/// The description, read as the host does.
inline sensor_log::Description description_file(const std::string& path) {
  core::Report report;
  const core::Node root = core::parse_yaml(core::read_source(path, path), report);
  sensor_log::Description d;
  core::fill_record(*core::copy_type(fulmar::describe<sensor_log::Description>()), root,
                    reinterpret_cast<std::byte*>(&d), "", report);
  report.throw_if_any();
  return d;
}

/// Every three-dimensional fix that the recording would give.
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
    core::Overrides overrides = recipe_.overrides;
    const std::vector<std::pair<std::string, std::string>> here = {
        {"recorded.log", std::filesystem::absolute(recipe_.log).string()},
        {"recorded.folder", recipe_.folder},
        {"recorded.log.gnss.withhold", windows(start_s, start_s + seconds)}};
    overrides.set.insert(overrides.set.begin(), here.begin(), here.end());
    const core::Graph graph = core::load_mission(recipe_.mission, overrides);
    const core::Source source = output_of(graph, "nav", "state");
    core::FlightOptions options;
    options.log = false;
    options.duration_s = last.valid_s + 1;
    core::Flight flight(graph, options);
    VehicleState before, after;
    double before_s = -1, after_s = -1;
    while (after_s < last.valid_s && flight.step()) {
      const std::byte* const bytes = flight.sample(source);
      if (!bytes) continue;
      before = after, before_s = after_s;
      std::memcpy(&after, bytes, sizeof after);
      after_s = 1e-9 * static_cast<double>(flight.now_ns());
    }
    const core::FlightResult result = flight.finish();
    if (before_s < 0 || after_s < last.valid_s || !result.guards.empty())
      throw std::runtime_error("the flight of the outage at " + std::to_string(start_s) +
                               " s: " + result.reason);
    const double part = (last.valid_s - before_s) / (after_s - before_s);
    return compare(before, after, part, last, start_s);
  }

 private:
  const Fix& last_withheld(double from_s, double to_s) const {
    const Fix* last = nullptr;
    for (const Fix& fix : fixes_)
      if (fix.arrived_s >= from_s && fix.arrived_s < to_s) last = &fix;
    if (fixes_.empty()) throw std::runtime_error(recipe_.log + " has no fixes");
    if (!last || fixes_.back().arrived_s < to_s)
      throw std::runtime_error("no fixes to withhold from " + sensor_log::seconds(from_s) + " to " +
                               sensor_log::seconds(to_s) + "; those of " + recipe_.log + " arrive from " +
                               sensor_log::seconds(fixes_.front().arrived_s) + " to " +
                               sensor_log::seconds(fixes_.back().arrived_s));
    return *last;
  }

  /// Those of the description as well.
  std::string windows(double from_s, double to_s) const {
    std::string text;
    const auto add = [&](double from, double to) {
      text += (text.empty() ? "[" : ", ") + ("{from: " + sensor_log::seconds(from)) +
              ", to: " + sensor_log::seconds(to) + "}";
    };
    for (const sensor_log::Window& w : description_.gnss.withhold) add(w.from_s, w.to_s);
    add(from_s, to_s);
    return text + "]";
  }

  /// Between two states, `part` of the way.
  static Outcome compare(const VehicleState& before, const VehicleState& after, double part, const Fix& fix,
                         double start_s) {
    const LocalFrame frame(after.origin_latitude_deg, after.origin_longitude_deg, after.origin_altitude_m);
    const Eigen::Vector3d there =
        frame.to_ned(fix.gnss.latitude_deg, fix.gnss.longitude_deg, fix.gnss.altitude_m);
    const Eigen::Vector3d error =
        eigen(before.position_m) + part * (eigen(after.position_m) - eigen(before.position_m)) - there;
    Outcome o;
    o.start_s = start_s;
    o.after_s = fix.valid_s - start_s;
    o.horizontal_m = error.head<2>().norm();
    o.claimed_m = std::hypot(after.position_std_m.north, after.position_std_m.east);
    o.height_m = -error.z();
    o.height_claimed_m = after.position_std_m.down;
    return o;
  }

  Recipe recipe_;
  sensor_log::Description description_;
  std::vector<Fix> fixes_;
};

/// Of `values`, linear between two of them in order.
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
