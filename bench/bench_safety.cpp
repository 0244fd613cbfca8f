// SPDX-License-Identifier: BSD-3-Clause
// Failures in flight, the actions of the aircraft, and the end of each flight, ten seeds each. Prints the
// table of docs/safety.md, "In flight", and exits 1 when a flight ends otherwise than its row.
// bench_safety [--json] [--flights N] [AIRFRAME [NAME]]
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/safety/flight.hpp"

using namespace fulmar::safety_flights;

namespace {

struct Worst {
  unsigned flown = 0, kept = 0, reported_else = 0;
  std::array<unsigned, 4> ends{};
  double reported_s = -1, sink_mps = 0, home_m = 0, outside_m = -1e9, seconds = 0;
  void add(const Row& row, const Flown& f) {
    ++flown;
    kept += f.kept(row);
    reported_else += f.reported_else;
    ++ends[static_cast<std::size_t>(f.end)];
    reported_s = std::max(reported_s, f.reported_s);
    sink_mps = std::max(sink_mps, f.touch_sink_mps);
    home_m = std::max(home_m, f.home_m);
    outside_m = std::max(outside_m, f.outside_m);
    seconds = std::max(seconds, f.seconds);
  }
};

std::string ends(const Worst& w) {
  std::string text;
  for (const End end : {End::on_ground, End::broken, End::aloft, End::stood}) {
    const unsigned n = w.ends[static_cast<std::size_t>(end)];
    if (n == 0) continue;
    if (!text.empty()) text += ", ";
    text += n == w.flown ? word(end) : std::to_string(n) + " " + word(end);
  }
  return text;
}

void print(const Row& row, const Worst& w) {
  char reported[32] = "before the throttle", inside[32] = "stood", down[64] = "flies on | flies on";
  if (row.end != End::stood) {
    std::snprintf(reported, sizeof reported, row.cause ? "not before the ground" : "nothing to report");
    std::snprintf(inside, sizeof inside, "%.0f", -w.outside_m);
  } else {
    std::snprintf(down, sizeof down, "stood | stood");
  }
  if (w.reported_s >= 0) std::snprintf(reported, sizeof reported, "%.1f", w.reported_s);
  if (row.end == End::on_ground) std::snprintf(down, sizeof down, "%.0f | %.1f", w.seconds, w.sink_mps);
  std::printf("| %s | %s | %s | %s | %s | %.0f | %s | %s |\n", row.airframe.c_str(), row.name.c_str(),
              row.does.c_str(), reported, down, w.home_m, inside, ends(w).c_str());
  std::fflush(stdout);
}

nlohmann::json json_of(const Row& row, const Worst& w) {
  const auto or_null = [](bool known, double x) { return known ? nlohmann::json(x) : nlohmann::json(); };
  return {{"airframe", row.airframe},
          {"failure", row.name},
          {"does", row.does},
          {"flown", w.flown},
          {"as_said", w.kept},
          {"end", ends(w)},
          {"told_s", or_null(w.reported_s >= 0, w.reported_s)},
          {"down_s", w.seconds},
          {"touch_sink_mps", w.sink_mps},
          {"from_home_m", w.home_m},
          {"inside_fence_m", or_null(row.end != End::stood, -w.outside_m)}};
}

int usage() {
  std::fprintf(stderr, "usage: bench_safety [--json] [--flights N] [AIRFRAME [NAME]]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  bool json = false;
  unsigned flights = 10;
  std::vector<std::string> only;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--json")
      json = true;
    else if (argument == "--flights" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      flights = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (argument[0] != '-' && only.size() < 2)
      only.push_back(argument);
    else
      return usage();
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-safety-" + std::to_string(getpid()));
  nlohmann::json rows = nlohmann::json::array();
  unsigned missed = 0;
  try {
    fs::create_directories(folder);
    if (!json)
      std::printf(
          "| aircraft | fails | does | told after, s | down after, s | sink at the touch, m/s | from home, m "
          "| left to the fence, m | ends |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const char* airframe : {"anaconda", "aerosonde", "x8"})
      for (const Row& row : rows_of(airframe)) {
        if ((!only.empty() && row.airframe != only[0]) || (only.size() > 1 && row.name != only[1])) continue;
        Worst w;
        for (unsigned seed = 1; seed <= flights; ++seed) {
          const Flown f = fly(row, seed, folder);
          w.add(row, f);
          if (f.kept(row)) continue;
          ++missed;
          std::fprintf(stderr, "missed: %s, %s, seed %u: %s (%s), told after %.1f s, %s, %.0f m outside\n",
                       airframe, row.name.c_str(), seed, word(f.end), f.outcome.c_str(), f.reported_s,
                       f.in_order ? "phases as said" : "other phases", f.outside_m);
        }
        if (json)
          rows.push_back(json_of(row, w));
        else
          print(row, w);
      }
    if (json) std::printf("%s\n", rows.dump(2).c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++missed;
  }
  fs::remove_all(folder);
  return missed == 0 ? 0 : 1;
}
