// SPDX-License-Identifier: BSD-3-Clause
// Flies the shipped missions through the software flight controller, which has no contact switch: what is
// planned, wrong heights, lost fixes on the ground. Exits 1 when a bar is missed.
//   bench_hardware [--seeds N] [--first SEED] [--json]
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/hardware/flight.hpp"

using namespace fulmar::hardware_bench;

namespace {

constexpr double recognised_95_s = 0.3, recognised_most_s = 0.6;

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* mission : {"return_home", "runway_to_runway"})
    for (const double off : {0.0, 4.0, -4.0, 6.0, -6.0}) {
      Case c;
      c.mission = mission;
      c.height_off_m = off;
      c.name = off == 0 ? "as planned" : "runway " + std::to_string(static_cast<int>(off)) + " m off";
      all.push_back(c);
    }
  Case shaded;
  shaded.name = "no fix after the landing";
  shaded.no_fix_landed_s = 5;
  all.push_back(shaded);
  Case gap;
  gap.name = "no fix for 3 s in the take-off run";
  gap.no_fix_ground_s = 6;
  all.push_back(gap);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 20;
  std::uint64_t first = 1;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--json")
      json = true;
    else if (word == "--seeds" && i + 1 < argc)
      seeds = std::atoi(argv[++i]);
    else if (word == "--first" && i + 1 < argc)
      first = std::strtoull(argv[++i], nullptr, 10);
    else
      return std::fprintf(stderr, "usage: bench_hardware [--seeds N] [--first SEED] [--json]\n"), 2;
  }
  const auto folder =
      std::filesystem::temp_directory_path() / ("fulmar-bench-hardware-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  nlohmann::json rows = nlohmann::json::array();
  std::vector<double> delays;
  bool kept = true;
  if (!json)
    std::printf(
        "| mission | case | flights | landed | crashed | airborne again | throttle after, most | "
        "touch-down after, most, s |\n|---|---|---|---|---|---|---|---|\n");
  for (const Case& c : cases()) {
    int landed = 0, crashed = 0, again = 0, skipped = 0;
    double throttle = 0, latest = 0;
    for (int i = 0; i < seeds; ++i) {
      const Landing l = fly(c, first + static_cast<std::uint64_t>(i), folder);
      landed += l.landed;
      crashed += l.crashed;
      again += l.again;
      skipped += l.takeoff_m < 20;
      throttle = std::max(throttle, l.throttle_after);
      if (l.recognised_s < 1e9) delays.push_back(l.recognised_s);
      latest = std::max(latest, l.recognised_s);
      if (l.crashed || l.again || !l.landed || l.takeoff_m < 20)
        std::fprintf(stderr, "%s, %s, seed %llu: %s; %s\n", c.mission.c_str(), c.name.c_str(),
                     static_cast<unsigned long long>(l.seed), l.phases.c_str(), l.reason.c_str());
    }
    kept = kept && landed == seeds && crashed == 0 && again == 0 && throttle == 0 && skipped == 0;
    rows.push_back({{"mission", c.mission},
                    {"case", c.name},
                    {"flights", seeds},
                    {"landed", landed},
                    {"crashed", crashed},
                    {"airborne_again", again},
                    {"takeoff_skipped", skipped},
                    {"throttle_after_max_frac", throttle},
                    {"touch_down_recognised_max_s", latest}});
    if (!json)
      std::printf("| %s | %s | %d | %d | %d | %d | %.2f | %.2f |\n", c.mission.c_str(), c.name.c_str(), seeds,
                  landed, crashed, again, throttle, latest);
  }
  std::filesystem::remove_all(folder);
  std::sort(delays.begin(), delays.end());
  const std::size_t n = delays.size();
  const double p95 =
      n > 0 ? delays[std::min(n - 1, static_cast<std::size_t>(0.95 * static_cast<double>(n)))] : 1e9;
  const double most = n > 0 ? delays.back() : 1e9;
  kept = kept && p95 <= recognised_95_s && most <= recognised_most_s;
  if (json)
    std::printf("%s\n", nlohmann::json{{"rows", rows},
                                       {"touch_down_recognised_95_s", p95},
                                       {"touch_down_recognised_max_s", most},
                                       {"kept", kept}}
                            .dump(2)
                            .c_str());
  else
    std::printf("\nTouch-down recognised after %.2f s in 95 %%, %.2f s at most, of %zu flights.\n", p95, most,
                n);
  return kept ? 0 : 1;
}
