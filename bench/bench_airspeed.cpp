// SPDX-License-Identifier: BSD-3-Clause
// Pitot and receiver fail together in flights of the shipped autopilot: error and reported standard deviation
// of the airspeed, with thrust and drag in place of the pitot and without. Exits 1 when a bound is exceeded.
// bench_airspeed [--json] [--seeds N] [--with PLUGIN.so] [NAME]: PLUGIN.so in place of the shipped estimator
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/airspeed/flight.hpp"

using namespace fulmar::lost_airspeed;

namespace {

nlohmann::json json_of(const Case& c, const std::string& sensors, bool wired, const Flown& f, unsigned down) {
  return {{"case", c.name},
          {"what", c.words},
          {"sensors", sensors},
          {"throttle_wired", wired},
          {"not_flown", down},
          {"airspeed_rms_mps", f.rms()},
          {"airspeed_most_mps", f.most},
          {"claimed_rms_mps", f.claimed()},
          {"within_1_std", f.share(f.within_1)},
          {"within_2_std", f.share(f.within_2)},
          {"valid", f.share(f.valid)},
          {"from_model", f.share(f.modelled)},
          {"least_true_airspeed_mps", f.min_true}};
}

void print(const Case& c, const std::string& sensors, bool wired, const Flown& f, unsigned down) {
  std::printf("| %s | `%s` | %s | %.2f | %.1f | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %u |\n",
              c.words.c_str(), sensors.c_str(), wired ? "yes" : "no", f.rms(), f.most, f.claimed(),
              f.share(f.within_1), f.share(f.within_2), f.share(f.valid), f.share(f.modelled), f.min_true,
              down);
  std::fflush(stdout);
}

/// Bounds of the case that were exceeded.
unsigned missed(const Case& c, const std::string& sensors, const Flown& f, unsigned down) {
  unsigned n = 0;
  const auto bar = [&](bool kept, const char* what, double value) {
    if (kept) return;
    std::fprintf(stderr, "missed: %s, %s: %s %.2f\n", c.name.c_str(), sensors.c_str(), what, value);
    ++n;
  };
  bar(down == 0, "flights not flown:", down);
  bar(f.rms() <= c.rms_mps, "rms", f.rms());
  bar(f.most <= c.max_mps, "an error of", f.most);
  bar(f.share(f.within_2) >= c.within_2, "within two deviations", f.share(f.within_2));
  bar(!c.modelled || f.share(f.modelled) >= 0.95, "flagged", f.share(f.modelled));
  bar(f.share(f.modelled) <= c.max_modelled, "flagged", f.share(f.modelled));
  return n;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned seeds = 10, misses = 0;
  bool json = false;
  std::string only, estimator;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--with" && i + 1 < argc)
      estimator = argv[++i];
    else if (word == "--json")
      json = true;
    else if (word[0] != '-' && only.empty())
      only = word;
    else {
      std::fprintf(stderr, "usage: bench_airspeed [--json] [--seeds N] [--with PLUGIN.so] [NAME]\n");
      return 2;
    }
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-airspeed-" + std::to_string(getpid()));
  try {
    if (!only.empty()) case_of(only);
    fs::create_directories(folder);
    if (!json)
      std::printf(
          "| lost | sensors | throttle | rms, m/s | most, m/s | claimed, m/s | within 1 | within 2 | "
          "valid | flagged | least airspeed, m/s | not flown |\n|---|---|---|---|---|---|---|---|---|"
          "---|---|---|\n");
    nlohmann::json all = nlohmann::json::array();
    for (const Case& c : cases())
      for (const std::string sensors : {"ublox", "rosflight"})
        for (const bool wired : {false, true}) {
          if (!only.empty() && c.name != only) continue;
          Flown sum;
          unsigned down = 0;
          for (unsigned seed = 1; seed <= seeds; ++seed) {
            const Flown f = fly(c, sensors, wired, seed, folder, estimator);
            sum.add(f);
            down += f.crashed;
          }
          if (wired) misses += missed(c, sensors, sum, down);
          if (json)
            all.push_back(json_of(c, sensors, wired, sum, down));
          else
            print(c, sensors, wired, sum, down);
        }
    if (json) std::printf("%s\n", all.dump(2).c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++misses;
  }
  fs::remove_all(folder);
  return misses == 0 ? 0 : 1;
}
