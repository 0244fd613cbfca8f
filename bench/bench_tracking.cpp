// SPDX-License-Identifier: BSD-3-Clause
// Tracking of plans over wind and turbulence: hourglass, orbit, square, and 50 m up and down, Anaconda,
// `ublox` sensors, wind from the south-east. Root mean squares relative to the estimate, means over the
// seeds. Exits 1 when a flight is lost, or a cell of the hourglass in 5 m/s and light turbulence exceeds its
// bar.
#include <array>
#include <cmath>
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

struct Plan {
  const char *name, *mission, *plan;  ///< plan: replaces that of the mission; "": none
};
constexpr std::array<Plan, 4> plans{
    {{"hourglass", "configs/missions/hourglass.yaml", ""},
     {"orbit", "configs/missions/orbit.yaml", ""},
     {"square", "configs/missions/hourglass.yaml", "bench/tracking/square.yaml"},
     {"climb", "configs/missions/hourglass.yaml", "bench/tracking/climb.yaml"}}};
constexpr std::array winds_mps{0, 4, 5, 8, 12};
struct Column {
  const char* key;
  double bar;  ///< for the hourglass in 5 m/s, light turbulence
};
constexpr std::array<Column, 7> columns{{{"north_m", 0.60},
                                         {"east_m", 0.45},
                                         {"altitude_m", 0.28},
                                         {"course_deg", 1.5},
                                         {"roll_deg", 0.65},
                                         {"pitch_deg", 0.45},
                                         {"airspeed_mps", 0.20}}};

/// Sums of the flights of one cell. Lost: flights that did not reach the end.
struct Cell {
  std::map<std::string, double> sums;
  int flown = 0, lost = 0;
  double mean(const std::string& key) const {
    const auto at = sums.find(key);
    return at == sums.end() || flown == 0 ? 0 : at->second / flown;
  }
};

Cell fly(const Plan& plan, int wind_mps, const char* turbulence, int seeds) {
  Cell cell;
  for (int seed = 1; seed <= seeds; ++seed) {
    char wind[80];
    std::snprintf(wind, sizeof wind, "[%.4f, %.4f, 0]", wind_mps * std::sqrt(0.5),
                  -wind_mps * std::sqrt(0.5));
    Overrides overrides;
    overrides.seed = static_cast<std::uint64_t>(seed);
    overrides.set = {{"sim.sensors", "ublox"}, {"sim.wind_ned", wind}, {"sim.turbulence", turbulence}};
    if (*plan.plan) overrides.set.push_back({"plan.plan", plan.plan});
    const Graph graph = load_mission(plan.mission, overrides);
    FlightOptions options;
    options.log = false;
    Flight flight(graph, options);
    const FlightResult result = flight.run();
    if (result.outcome != Outcome::flown || !result.guards.empty()) {
      std::fprintf(stderr, "%s, %d m/s, %s, seed %d: %s\n", plan.name, wind_mps, turbulence, seed,
                   result.reason.c_str());
      ++cell.lost;
      continue;
    }
    ++cell.flown;
    const nlohmann::json figures = result_json(graph, flight, result);
    for (const char* group : {"tracking_rmse", "mission_figures"})
      for (const auto& [key, value] : figures.at(group).items())
        if (value.is_number()) cell.sums[key] += value.get<double>();
  }
  return cell;
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 20;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else if (std::strcmp(argv[i], "--seeds") == 0 && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      seeds = std::atoi(argv[++i]);
    else {
      std::fprintf(stderr, "usage: bench_tracking [--seeds N] [--json]\n");
      return 2;
    }
  }
  int bad = 0;
  nlohmann::json all = nlohmann::json::object();
  if (!json)
    std::printf(
        "| plan | wind, m/s | turbulence | north, m | east, m | altitude, m | course, deg | roll, deg | "
        "pitch, "
        "deg | airspeed, m/s | surfaces, rad/s | lost "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  try {
    for (const Plan& plan : plans)
      for (const int wind : winds_mps)
        for (const char* turbulence : {"light", "moderate"}) {
          const Cell cell = fly(plan, wind, turbulence, seeds);
          bad += cell.lost;
          const bool judged = &plan == &plans[0] && wind == 5 && std::strcmp(turbulence, "light") == 0;
          if (!json) std::printf("| %s | %d | %s |", plan.name, wind, turbulence);
          nlohmann::json& out = all[plan.name][std::to_string(wind)][turbulence];
          for (const Column& c : columns) {
            const bool above = judged && cell.mean(c.key) > c.bar;
            bad += above;
            if (!json) std::printf(" %.3f%s |", cell.mean(c.key), above ? " **above**" : "");
            out[c.key] = cell.mean(c.key);
          }
          out["surface_rate_rms_radps"] = cell.mean("surface_rate_rms_radps");
          out["lost"] = cell.lost;
          if (!json) std::printf(" %.3f | %d |\n", cell.mean("surface_rate_rms_radps"), cell.lost);
          std::fflush(stdout);
        }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  if (json) std::printf("%s\n", all.dump(2).c_str());
  return bad == 0 ? 0 : 1;
}
