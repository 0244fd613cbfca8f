// SPDX-License-Identifier: BSD-3-Clause
// The shipped autopilot through a software flight controller in virtual time, ten seeds each: a gap of the
// link in a turn, loss of the fix in cruise. Prints docs/link_gaps.md and exits 1 when one of its bars is
// missed.
// bench_link_gaps [--seeds N] [gaps | fixes]
#include <cstdio>
#include <cstdlib>

#include "core/app/test/virtual_controller.hpp"

using namespace fulmar::core;
using namespace fulmar::core::through_controller;
namespace fs = std::filesystem;

namespace {

const char* const heading = R"(# Link gaps and lost fixes

Written by `build/bin/bench_link_gaps > docs/link_gaps.md`; nothing here is typed. It exits 1 when a bar is missed.

The shipped autopilot (`estimator_ekf`, `path`, `control_slc`) flies the hourglass with the Anaconda at 17 m/s, wind 5 m/s, light turbulence, through the code of
`fcu_serial` on the software flight controller of the tests, in virtual time. Ten seeds a row; columns show the worst of them where they do not say otherwise.
`fcu_gaps_test` flies some of it in `./check`.
)";

const char* const about_gaps = R"(
## The link falls silent in a turn

Nothing comes through, either way. `GNSS` no: for 60 s from the gap's begin the receiver has no fix. The controller gives the aircraft to its pilot 0.1 s after the last command; he holds the wings level
with 60 % throttle whenever he has it. `lost`: height below the lower of the plan and of what was taken over, while Fulmar commands; `lowest`: whoever flies; `told`: flights in
which it was said that no command is sent. Bars: no command without a valid attitude; at most 15 m lost; the outputs are the pilot's sticks whenever he has the aircraft; after
more than 2 s without GNSS it stays his until the fix is back, and both are told; otherwise Fulmar commands again within 1 s.

)";

const char* const about_fixes = R"(
## The receiver loses its fix in cruise

For as long as the first column says, it has no fix (odd seeds) or says nothing (even ones). `off the plan`: the true position from the nearest point of the
plan, at the end of the outage, 100 s after its begin, or where it begins to circle; `reckoned wrong`: the estimate from the true position, then; `said deviation`:
what the estimator makes of that; `turned by`: the true course in the circle, at least; `on the plan`: within 10 m, after the return. Bars: nine of ten within 150 m of the plan; loss and return told
within 1 s; a circle after 120 s, or before at a stated deviation of 50 m; back on the plan.

)";

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

std::string decimals(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}
std::string seconds(double least, double most) {
  if (most < 0) return "never";
  return least < 0 ? "not always" : decimals(least) + " to " + decimals(most);
}

void gaps_row(Campaign& c, double height_m, bool gnss, double length_s) {
  double blind = 0, lost = 0, lowest = 1e9, back_least = 1e9, back_most = -1, returned = -1;
  unsigned reported = 0;
  for (unsigned seed = 1; seed <= c.seeds; ++seed) {
    const Gap gap{length_s, gnss, height_m, seed};
    const AfterGap a = fly(gap, c.folder, c.options);
    const std::string fault = missed(gap, a);
    c.bar(fault.empty(), std::to_string(height_m) + " m, gap of " + std::to_string(length_s) + " s " +
                             (gnss ? "with" : "without") + " GNSS, seed " + std::to_string(seed) + ": " +
                             fault);
    blind += a.blind;
    lost = worst(lost, a.lost_m);
    lowest = std::min(lowest, a.lowest_m);
    back_least = std::min(back_least, a.back_s);
    back_most = worst(back_most, a.back_s);
    returned = worst(returned, a.returned_s);
    reported += a.reported_blind;
  }
  const bool his = !gnss && length_s > 2;
  char row[256];
  std::snprintf(row, sizeof row, "| %g | %s | %g | %s | %.0f | %.1f | %.1f | %u | %s |", height_m,
                gnss ? "yes" : "no", length_s, seconds(back_least, back_most).c_str(), blind, lost, lowest,
                reported, his ? decimals(returned).c_str() : "");
  std::printf("%s\n", row);
  std::fflush(stdout);
}

void gaps(Campaign& c) {
  std::printf(
      "| height, m | GNSS | gap, s | commands again after, s | commands without a valid attitude | lost, m | "
      "lowest, m | told | commands after the fix, s |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const double height_m : {70.0, 30.0})
    for (const bool gnss : {true, false})
      for (const double length_s : {0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0}) gaps_row(c, height_m, gnss, length_s);
}

void fixes_row(Campaign& c, double length_s) {
  std::vector<double> off, reckoned;
  AfterOutage w;
  double circle_least = 1e9, turned = 1e9, reported_lost = -1, reported_back = -1, resumed = -1;
  for (unsigned seed = 1; seed <= c.seeds; ++seed) {
    const Outage outage{length_s, seed};
    const AfterOutage a = fly(outage, c.folder, c.options);
    const std::string fault = missed(outage, a);
    c.bar(fault.empty(),
          "no fix for " + std::to_string(length_s) + " s, seed " + std::to_string(seed) + ": " + fault);
    off.push_back(a.plan_m);
    reckoned.push_back(a.reckoned_m);
    w.std_m = worst(w.std_m, a.std_m);
    w.circle_s = worst(w.circle_s, a.circle_s);
    circle_least = std::min(circle_least, a.circle_s);
    turned = std::min(turned, a.turned_deg);
    reported_lost = worst(reported_lost, a.reported_lost_s);
    reported_back = worst(reported_back, a.reported_back_s);
    resumed = worst(resumed, a.resumed_s);
  }
  std::sort(off.begin(), off.end());
  std::sort(reckoned.begin(), reckoned.end());
  const std::size_t nine = (off.size() * 9 + 9) / 10 - 1;
  char row[256];
  std::snprintf(row, sizeof row, "| %g | %.0f | %.0f | %.0f | %.0f | %.0f | %s | %s | %.2f | %.2f | %.0f |",
                length_s, off[nine], off.back(), reckoned[nine], reckoned.back(), w.std_m,
                seconds(circle_least, w.circle_s).c_str(),
                w.circle_s < 0 ? "" : std::to_string(std::lround(turned)).c_str(), reported_lost,
                reported_back, resumed);
  std::printf("%s\n", row);
  std::fflush(stdout);
  c.bar(off[nine] <= 150, "no fix for " + std::to_string(length_s) + " s: nine seeds of ten within 150 m");
}

void fixes(Campaign& c) {
  std::printf(
      "| no fix for, s | off the plan: nine of ten, m | worst, m | reckoned wrong: nine of ten, m | worst, m "
      "| "
      "said deviation, m | circle after, s | turned by, deg | loss told after, s | return told after, s | "
      "on the plan after, s |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double length_s : {10.0, 20.0, 30.0, 60.0, 100.0, 120.0, 150.0, 180.0}) fixes_row(c, length_s);
}

}  // namespace

int main(int argc, char** argv) {
  ::setenv("FULMAR_MESSAGES", "codes", 1);  // reported_s() of virtual_controller.hpp compares codes
  Campaign c;
  c.options.log = false;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      c.seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "gaps" || word == "fixes")
      only = word;
    else {
      std::fprintf(stderr, "usage: bench_link_gaps [--seeds N] [gaps | fixes]\n");
      return 2;
    }
  }
  c.folder = fs::temp_directory_path() / ("fulmar-link-gaps-" + std::to_string(getpid()));
  try {
    fs::create_directories(c.folder);
    std::printf("%s", heading);
    if (only != "fixes") {
      std::printf("%s", about_gaps);
      gaps(c);
    }
    if (only != "gaps") {
      std::printf("%s", about_fixes);
      fixes(c);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++c.missed;
  }
  fs::remove_all(c.folder);
  return c.missed == 0 ? 0 : 1;
}
