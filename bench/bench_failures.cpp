// SPDX-License-Identifier: BSD-3-Clause
// Random shipped missions with a random failure each: checks that a flight that does not complete its mission
// reports it, and that its reason names the failure. Prints the table of docs/safety.md, "By chance", and
// exits 1 when a flight is silent.
// bench_failures [--seeds FROM-TO] [--flights]
#include <cstdio>
#include <cstring>
#include <map>

#include "bench/failures/flight.hpp"

using namespace fulmar::failing_flights;

namespace {

struct Row {
  std::array<unsigned, 4> classes{};
  std::string silent{};
  void add(const Flown& f, unsigned seed) {
    ++classes[static_cast<std::size_t>(f.of)];
    if (f.of == Class::silent) silent += (silent.empty() ? "" : ", ") + std::to_string(seed);
  }
};

void print(const std::string& name, const Row& r) {
  const auto& c = r.classes;
  std::printf("| %s | %u | %u | %u | %u | %u | %s |\n", name.c_str(), c[0] + c[1] + c[2] + c[3], c[0], c[1],
              c[2], c[3], r.silent.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  unsigned from = 1, to = 300;
  bool flights = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--flights") == 0)
      flights = true;
    else if (std::strcmp(argv[i], "--seeds") == 0 && i + 1 < argc &&
             std::sscanf(argv[i + 1], "%u-%u", &from, &to) == 2)
      ++i;
    else {
      std::fprintf(stderr, "usage: bench_failures [--seeds FROM-TO] [--flights]\n");
      return 2;
    }
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-failures-" + std::to_string(getpid()));
  std::map<std::string, Row> rows;
  Row all;
  int code = 0;
  try {
    fs::create_directories(folder);
    for (unsigned seed = from; seed <= to; ++seed) {
      const Drawn d = draw(seed);
      const Flown f = fly(d, seed, folder);
      rows[d.group].add(f, seed);
      all.add(f, seed);
      if (flights || f.of >= Class::other)
        std::fprintf(stderr, "%u, %s, %s at %.0f s for %.0f s: %s: %s; %s; %s\n", seed, d.mission.c_str(),
                     d.failure.c_str(), d.at_s, d.lasts_s, word(f.of), f.missed.c_str(), f.reason.c_str(),
                     f.verdict.c_str());
      for (const std::string& line : f.lines)
        if (flights) std::fprintf(stderr, "    %s\n", line.c_str());
    }
    std::printf(
        "| fails | flights | mission done | reason named | another reason | silent | seeds |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const auto& [name, row] : rows) print(name, row);
    print("all", all);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    code = 1;
  }
  fs::remove_all(folder);
  return code != 0 || all.classes[3] > 0 ? 1 : 0;
}
