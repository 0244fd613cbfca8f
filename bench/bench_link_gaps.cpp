// SPDX-License-Identifier: BSD-3-Clause
// The shipped autopilot through a software flight controller in virtual time, ten seeds each: the link falls
// silent in a turn, the receiver loses its fix in cruise. Prints the tables of docs/link_gaps.md and exits 1
// when one of their bars is missed. bench_link_gaps [--seeds N] [gaps | fixes]
#include <cstdio>
#include <cstdlib>

#include "core/app/test/virtual_controller.hpp"

using namespace fulmar::core;
using namespace fulmar::core::through_controller;
namespace fs = std::filesystem;

namespace {

struct Campaign {
  unsigned seeds = 10;
  fs::path folder;
  FlightOptions options;
  int missed = 0;

  void bar(bool kept, const std::string& what) {
    if (kept) return;
    std::fprintf(stderr, "missed: %s\n", what.c_str());
    ++missed;
  }
};

double worst(double a, double b) { return std::max(a, b); }

std::string seconds(double least, double most) {
  if (most < 0) return "never";
  char text[64];
  std::snprintf(text, sizeof text, "%.2f to %.2f", least, most);
  return least < 0 ? "not always" : text;
}

void gaps_row(Campaign& c, double height_m, bool gnss, double length_s) {
  double blind = 0, lost = 0, lowest = 1e9, back_least = 1e9, back_most = -1, returned = -1;
  unsigned told = 0;
  for (unsigned seed = 1; seed <= c.seeds; ++seed) {
    const Gap gap{length_s, gnss, height_m, seed};
    const AfterGap a = fly(gap, c.folder, c.options);
    const std::string fault = missed(gap, a);
    c.bar(fault.empty(), std::to_string(height_m) + " m, gap of " + std::to_string(length_s) + " s " +
                             (gnss ? "with" : "without") + " GNSS, seed " + std::to_string(seed) + ": " +
                             fault);
    blind += a.blind, lost = worst(lost, a.lost_m);
    lowest = std::min(lowest, a.lowest_m);
    back_least = std::min(back_least, a.back_s), back_most = worst(back_most, a.back_s);
    returned = worst(returned, a.returned_s);
    told += a.told_blind;
  }
  const bool his = !gnss && length_s > 2;
  char row[256];
  std::snprintf(row, sizeof row, "| %g | %s | %g | %s | %.0f | %.1f | %.1f | %u | %s |", height_m,
                gnss ? "yes" : "no", length_s, seconds(back_least, back_most).c_str(), blind, lost, lowest,
                told, his ? seconds(0, returned).c_str() + 8 : "");
  std::printf("%s\n", row);
  std::fflush(stdout);
}

void gaps(Campaign& c) {
  std::printf(
      "| height, m | GNSS | gap, s | Fulmar commands again after, s | commands without a valid attitude | "
      "lost, "
      "m | lowest, m | told | fix to command, s |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const double height_m : {70.0, 30.0})
    for (const bool gnss : {true, false})
      for (const double length_s : {0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0}) gaps_row(c, height_m, gnss, length_s);
}

void fixes_row(Campaign& c, double length_s) {
  std::vector<double> off;
  AfterOutage w;
  double circle_least = 1e9, turned = 1e9, told_lost = -1, told_back = -1, resumed = -1;
  for (unsigned seed = 1; seed <= c.seeds; ++seed) {
    const Outage outage{length_s, seed};
    const AfterOutage a = fly(outage, c.folder, c.options);
    const std::string fault = missed(outage, a);
    c.bar(fault.empty(),
          "no fix for " + std::to_string(length_s) + " s, seed " + std::to_string(seed) + ": " + fault);
    off.push_back(a.plan_m);
    w.reckoned_m = worst(w.reckoned_m, a.reckoned_m), w.std_m = worst(w.std_m, a.std_m);
    w.circle_s = worst(w.circle_s, a.circle_s), circle_least = std::min(circle_least, a.circle_s);
    turned = std::min(turned, a.turned_deg);
    told_lost = worst(told_lost, a.told_lost_s), told_back = worst(told_back, a.told_back_s);
    resumed = worst(resumed, a.resumed_s);
  }
  std::sort(off.begin(), off.end());
  const double ninth = off[(off.size() * 9 + 9) / 10 - 1];
  char row[256];
  std::snprintf(row, sizeof row, "| %g | %.0f | %.0f | %.0f | %.0f | %s | %s | %.2f | %.2f | %.0f |",
                length_s, ninth, off.back(), w.reckoned_m, w.std_m, seconds(circle_least, w.circle_s).c_str(),
                w.circle_s < 0 ? "" : std::to_string(std::lround(turned)).c_str(), told_lost, told_back,
                resumed);
  std::printf("%s\n", row);
  std::fflush(stdout);
  c.bar(ninth <= 150, "no fix for " + std::to_string(length_s) + " s: nine seeds of ten within 150 m");
}

void fixes(Campaign& c) {
  std::printf(
      "| no fix for, s | nine of ten within, m | worst, m | reckoned wrong by, m | said deviation, m | "
      "circle "
      "after, s | turned by, deg | loss told after, s | return told after, s | on the plan after, s |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double length_s : {10.0, 20.0, 30.0, 60.0, 100.0, 120.0, 150.0, 180.0}) fixes_row(c, length_s);
}

}  // namespace

int main(int argc, char** argv) {
  Campaign c;
  c.options.log = false;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      c.seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "gaps" || word == "fixes")
      only = word;
    else
      return std::fprintf(stderr, "usage: bench_link_gaps [--seeds N] [gaps | fixes]\n"), 2;
  }
  c.folder = fs::temp_directory_path() / ("fulmar-link-gaps-" + std::to_string(getpid()));
  try {
    fs::create_directories(c.folder);
    if (only != "fixes") gaps(c);
    if (only.empty()) std::printf("\n");
    if (only != "gaps") fixes(c);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++c.missed;
  }
  fs::remove_all(c.folder);
  return c.missed == 0 ? 0 : 1;
}
