// SPDX-License-Identifier: BSD-3-Clause
// Pitot tube and receiver fail together in flights of the shipped autopilot: how wrong the airspeed is, and
// what it claims, with a model of thrust and drag in place of the tube and without. bench_airspeed [--json]
// [--seeds N] [NAME]
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/airspeed/flight.hpp"

using namespace fulmar::lost_airspeed;

int main(int argc, char** argv) {
  unsigned seeds = 10;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc)
      seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else
      only = word;
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-airspeed-" + std::to_string(getpid()));
  fs::create_directories(folder);
  for (const Case& c : cases()) {
    if (!only.empty() && c.name.find(only) == std::string::npos) continue;
    for (const char* sensors : {"ublox", "rosflight"})
      for (const bool wired : {false, true}) {
        Flown all;
        unsigned down = 0;
        for (unsigned seed = 1; seed <= seeds; ++seed) {
          const Flown f = fly(c, sensors, wired, seed, folder);
          if (getenv("EACH"))
            std::printf("   seed %u rms %.2f most %.2f claimed %.2f valid %.2f model %.2f least %.1f%s\n", seed, f.rms(), f.most, f.claimed(), f.share(f.valid), f.share(f.modelled), f.least_true, f.crashed ? " CRASHED" : "");
          all.add(f);
          down += f.crashed;
        }
        std::printf("%-14s %-9s %-5s rms %5.2f most %5.2f (valid %5.2f) claimed %5.2f  1s %.2f 2s %.2f  valid %.2f model %.2f least %.1f down %u\n",
                    c.name.c_str(), sensors, wired ? "model" : "-", all.rms(), all.most, all.most_valid, all.claimed(), all.share(all.within_1),
                    all.share(all.within_2), all.share(all.valid), all.share(all.modelled), all.least_true, down);
        std::fflush(stdout);
      }
  }
  fs::remove_all(folder);
}
