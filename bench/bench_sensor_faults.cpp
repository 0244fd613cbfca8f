// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/sensor_faults/flight.hpp"

using namespace fulmar::sensor_faults;

int main(int argc, char** argv) {
  unsigned seeds = 10;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc) seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else only = word;
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-sensor-faults-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::vector<Each> usual;
  for (unsigned seed = 1; seed <= seeds; ++seed) usual.push_back(fly(row("nothing"), seed, {}, folder).most);
  for (const Row& r : rows()) {
    if (!only.empty() && r.name != only) continue;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Flown f = fly(r, seed, usual[seed - 1], folder);
      std::printf("%-18s told %5.2f %-22s err %6.1f %6.2f %6.1f %6.1f %6.2f  valid %6.1f %6.2f %6.1f %6.1f %6.2f  step %5.2f %5.2f %5.2f %5.2f %5.2f rec %5.2f std %5.1f %s [%s]\n", r.name.c_str(), f.told_s, f.told_by.c_str(), f.most[0],f.most[1],f.most[2],f.most[3],f.most[4],f.most_valid[0],f.most_valid[1],f.most_valid[2],f.most_valid[3],f.most_valid[4],f.step[0],f.step[1],f.step[2],f.step[3],f.step[4], f.recovered_s, f.over_std, f.crashed?"CRASHED":"", f.accused.c_str());
      std::fflush(stdout);
    }
  }
  fs::remove_all(folder);
}
