// SPDX-License-Identifier: BSD-3-Clause
// Flies the hourglass with ten seeds and both sensor presets and compares the means with the figures of the
// ROSplane 2.0 paper: tracking with its hardware flight, estimation with its simulated estimator. Exits 1
// when a figure is worse.
// bench_missions [--json | --markdown] [--seeds N] [--mission FILE]
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/app/report.hpp"
#include "core/run/flight.hpp"

using namespace fulmar::core;

namespace {

struct Bar {
  const char *group, *key;
  double limit;
  const char* preset;  // "" : both
};

const std::vector<Bar> bars = {
    {"tracking", "north_m", 3.05, ""},
    {"tracking", "east_m", 3.29, ""},
    {"tracking", "altitude_m", 1.19, ""},
    {"tracking", "roll_deg", 7.55, ""},
    {"tracking", "pitch_deg", 3.04, ""},
    {"tracking", "course_deg", 8.51, ""},
    {"tracking", "airspeed_mps", 0.58, ""},
    {"tracking_true", "north_m", 3.05, ""},
    {"tracking_true", "east_m", 3.29, ""},
    {"tracking_true", "altitude_m", 1.19, ""},
    {"tracking_true", "roll_deg", 7.55, ""},
    {"tracking_true", "pitch_deg", 3.04, ""},
    {"tracking_true", "course_deg", 8.51, ""},
    {"tracking_true", "airspeed_mps", 0.58, ""},
    {"estimation", "vel_x_mps", 0.045, "rosflight"},
    {"estimation", "vel_y_mps", 0.089, "rosflight"},
    {"estimation", "vel_z_mps", 0.105, "rosflight"},
    {"estimation", "roll_deg", 0.189, "rosflight"},
    {"estimation", "pitch_deg", 0.074, "rosflight"},
    {"estimation", "course_deg", 0.112, "rosflight"},
    {"estimation_over_gnss", "north_ratio", 1.05, "rosflight"},
    {"estimation_over_gnss", "east_ratio", 1.05, "rosflight"},
};

struct Figure {
  double sum = 0, worst = 0;
  int n = 0;
  double mean() const { return n > 0 ? sum / n : 0; }
  void add(double v) {
    sum += v;
    worst = std::max(worst, v);
    ++n;
  }
};
using Figures = std::map<std::string, std::map<std::string, Figure>>;  // group -> key

void add_flight(Figures& figures, const nlohmann::json& result) {
  for (const char* group : {"tracking", "tracking_true", "estimation", "gnss_error"}) {
    const nlohmann::json& values = result.at(std::string(group) + "_rmse");
    for (const auto& [key, value] : values.items()) figures[group][key].add(value.get<double>());
  }
  for (const char* axis : {"north", "east"}) {
    const std::string key = std::string(axis) + "_m";
    figures["estimation_over_gnss"][std::string(axis) + "_ratio"].add(
        result["estimation_rmse"][key].get<double>() / result["gnss_error_rmse"][key].get<double>());
  }
}

int fly(Figures& figures, const std::string& mission, const std::string& preset, int seeds) {
  int lost = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Overrides overrides;
    overrides.seed = static_cast<std::uint64_t>(seed);
    overrides.set = {{"sim.sensors", preset}};
    const Graph graph = load_mission(mission, overrides);
    FlightOptions options;
    options.log = false;
    Flight flight(graph, options);
    const FlightResult result = flight.run();
    if (result.outcome != Outcome::flown || !result.guards.empty()) {
      std::fprintf(stderr, "%s, seed %d: %s\n", preset.c_str(), seed, result.reason.c_str());
      ++lost;
      continue;
    }
    add_flight(figures, result_json(graph, flight, result));
  }
  return lost;
}

const Bar* bar_of(const std::string& group, const std::string& key, const std::string& preset) {
  for (const Bar& b : bars)
    if (group == b.group && key == b.key && (b.preset[0] == '\0' || preset == b.preset)) return &b;
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  std::string mission = "configs/missions/hourglass.yaml", format = "text";
  int seeds = 10;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      format = "json";
    else if (std::strcmp(argv[i], "--markdown") == 0)
      format = "markdown";
    else if (std::strcmp(argv[i], "--seeds") == 0 && i + 1 < argc)
      seeds = std::atoi(argv[++i]);
    else if (std::strcmp(argv[i], "--mission") == 0 && i + 1 < argc)
      mission = argv[++i];
    else {
      std::fprintf(stderr, "usage: bench_missions [--json | --markdown] [--seeds N] [--mission FILE]\n");
      return 2;
    }
  }
  int bad = 0;
  nlohmann::json all = nlohmann::json::object();
  try {
    if (format == "markdown")
      std::printf(
          "| sensors | figure | | mean of %d seeds | worst | to be below |\n|---|---|---|---|---|---|\n",
          seeds);
    for (const std::string preset : {"rosflight", "ublox"}) {
      Figures figures;
      bad += fly(figures, mission, preset, seeds);
      for (const auto& [group, keys] : figures)
        for (const auto& [key, figure] : keys) {
          const Bar* bar = bar_of(group, key, preset);
          const bool worse = bar && !(figure.mean() < bar->limit);
          if (worse) ++bad;
          char limit[32] = "";
          if (bar) std::snprintf(limit, sizeof limit, "%.3f", bar->limit);
          if (format == "json")
            all[preset][group][key] = {{"mean", figure.mean()}, {"worst", figure.worst}};
          else if (format == "markdown")
            std::printf("| %s | %s | %s | %.3f | %.3f | %s |\n", preset.c_str(), group.c_str(), key.c_str(),
                        figure.mean(), figure.worst, limit);
          else
            std::printf("%-10s %-22s %-14s %9.3f  worst %9.3f  %s%s%s\n", preset.c_str(), group.c_str(),
                        key.c_str(), figure.mean(), figure.worst, bar ? "below " : "", limit,
                        worse ? "  WORSE" : "");
        }
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  if (format == "json") std::printf("%s\n", all.dump(2).c_str());
  return bad == 0 ? 0 : 1;
}
