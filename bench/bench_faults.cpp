// SPDX-License-Identifier: BSD-3-Clause
// Each part of the simulated aircraft fails in every way, ten seeds each, while the shipped autopilot flies
// the hourglass. Prints docs/faults.md and exits 1 when a failure that must be survived is not.
// bench_faults [--json] [--seeds N] [WHAT [HOW]]
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/app/test/fault_campaign.hpp"

using namespace fulmar::core;
using namespace fulmar::core::failures;

namespace {

const char* const heading = R"(# What fails, and what the autopilot makes of it

Written by `build/bin/bench_faults > docs/faults.md`; nothing here is typed.

The shipped autopilot (`estimator_ekf`, `path`, `control_slc`) flies one circuit of `configs/missions/hourglass.yaml`: the Anaconda at 17 m/s, 70 m high, wind 5 m/s, light turbulence,
sensors `rosflight`. 10 s after the first waypoint, on a straight, one thing of the simulated aircraft fails for good, with the sizes that [its parameters](../plugins/sim_aero/README.md#faults) have by default.
The phase in which it fails sets the parameter. Ten seeds a row. The exit code is 1 when a row that ends in `must fly` has a flight that was not flown; `faults_test` flies some of it in `./check`.

`flown`: the circuit was completed; `aloft`: still in the air after 270 s, without; `down`: on the ground, softly or not. The rest is the worst of the seeds, from the failure to
the end: `off the plan`, the true position from the nearest point of the plan; `lowest`, the true height; `height wrong`, `position wrong`: the estimate from the truth; `down after`: the
soonest. `told`: flights in which the host or a component said something of it; `admitted`: in which the estimate called its attitude, position, velocity, height or airspeed invalid;
`guards`: how often one fired. A row with much in `wrong` and nothing in `told` and `admitted` is a fault that is followed in silence.

| what | how | flown | aloft | down | off the plan, m | lowest, m | height wrong, m | position wrong, m | down after, s | told | admitted | guards | |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
)";

/// Failures that the autopilot must survive with any seed.
bool must_fly(const Failure& f) {
  static const std::vector<std::string> targets = {"nothing", "mag", "baro", "rudder", "radio", "icing"};
  static const std::vector<std::pair<std::string, std::string>> list = {
      {"gyro", "noisy"},          {"accel", "noisy"},         {"gnss_position", "wrong"},
      {"gnss_position", "slow"},  {"gnss_position", "noisy"}, {"gnss_position", "jumping"},
      {"gnss_position", "stuck"}, {"pitot", "stuck"},         {"gnss_velocity", "noisy"},
      {"pitot", "off"},           {"pitot", "wrong"},         {"pitot", "slow"},
      {"pitot", "noisy"},         {"pitot", "jumping"},       {"aileron", "slow"},
      {"elevator", "slow"}};
  if (std::find(targets.begin(), targets.end(), f.what) != targets.end()) return true;
  return std::find(list.begin(), list.end(), std::pair(f.what, f.how)) != list.end();
}

struct Row {
  unsigned flown = 0, aloft = 0, down = 0, reported = 0, admitted = 0;
  std::size_t guards = 0;
  After worst;

  void add(const After& a) {
    flown += a.flown;
    down += a.down;
    aloft += !a.flown && !a.down;
    reported += a.reported;
    admitted += a.admitted;
    guards += a.guards;
    worst.plan_m = std::max(worst.plan_m, a.plan_m);
    worst.lowest_m = std::min(worst.lowest_m, a.lowest_m);
    worst.height_error_m = std::max(worst.height_error_m, a.height_error_m);
    worst.position_error_m = std::max(worst.position_error_m, a.position_error_m);
    if (a.down && (worst.down_s < 0 || a.down_s < worst.down_s)) worst.down_s = a.down_s;
  }
};

void print(const Failure& f, const Row& r) {
  char down[32] = "";
  if (r.down > 0) std::snprintf(down, sizeof down, "%.1f", r.worst.down_s);
  std::printf("| %s | %s | %u | %u | %u | %.0f | %.0f | %.0f | %.0f | %s | %u | %u | %zu | %s |\n",
              f.what.c_str(), f.how.c_str(), r.flown, r.aloft, r.down, r.worst.plan_m, r.worst.lowest_m,
              r.worst.height_error_m, r.worst.position_error_m, down, r.reported, r.admitted, r.guards,
              must_fly(f) ? "must fly" : "");
  std::fflush(stdout);
}

nlohmann::json json_of(const Failure& f, const Row& r) {
  nlohmann::json down_s;
  if (r.down > 0) down_s = r.worst.down_s;
  return {{"what", f.what},
          {"how", f.how},
          {"flown", r.flown},
          {"aloft", r.aloft},
          {"down", r.down},
          {"off_plan_m", r.worst.plan_m},
          {"lowest_m", r.worst.lowest_m},
          {"height_error_m", r.worst.height_error_m},
          {"position_error_m", r.worst.position_error_m},
          {"down_s", down_s},
          {"told", r.reported},
          {"admitted", r.admitted},
          {"guards", r.guards},
          {"must_fly", must_fly(f)}};
}

struct Campaign {
  bool json = false;
  unsigned seeds = 10;
  std::vector<std::string> only;
  fs::path folder;
  nlohmann::json rows = nlohmann::json::array();
  int missed = 0;

  bool wanted(const Failure& f) const {
    return (only.empty() || f.what == only[0]) && (only.size() < 2 || f.how == only[1]);
  }
  void fly_all() {
    FlightOptions options;
    options.log = false;
    for (const Failure& f : all_failures()) {
      if (!wanted(f)) continue;
      Row row;
      for (unsigned seed = 1; seed <= seeds; ++seed) row.add(fly(f, seed, folder, options));
      if (must_fly(f) && row.flown < seeds) {
        std::fprintf(stderr, "missed: %s %s: %u of %u flown\n", f.what.c_str(), f.how.c_str(), row.flown,
                     seeds);
        ++missed;
      }
      if (json)
        rows.push_back(json_of(f, row));
      else
        print(f, row);
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  Campaign c;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      c.seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--json")
      c.json = true;
    else if (word[0] != '-' && c.only.size() < 2)
      c.only.push_back(word);
    else {
      std::fprintf(stderr, "usage: bench_faults [--json] [--seeds N] [WHAT [HOW]]\n");
      return 2;
    }
  }
  c.folder = fs::temp_directory_path() / ("fulmar-faults-" + std::to_string(getpid()));
  try {
    fs::create_directories(c.folder);
    if (!c.json) std::printf("%s", heading);
    c.fly_all();
    if (c.json) std::printf("%s\n", c.rows.dump(2).c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++c.missed;
  }
  fs::remove_all(c.folder);
  return c.missed == 0 ? 0 : 1;
}
