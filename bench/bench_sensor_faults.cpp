// SPDX-License-Identifier: BSD-3-Clause
// Each sensor fails for a while during a flight of the shipped autopilot, ten seeds a fault: time until the
// estimator's report, errors meanwhile, and time of recovery. Prints docs/sensor_faults.md and exits 1 when a
// bound of a fault is exceeded.
// bench_sensor_faults [--json] [--seeds N] [--with PLUGIN.so] [NAME]
// bench_sensor_faults --compass [--seeds N] [--first SEED] [--with PLUGIN.so]: a magnetometer mounted wrong,
// by its angle
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/sensor_faults/compass.hpp"

using namespace fulmar::sensor_faults;

namespace {

const char* const heading = R"(# Sensor faults found and survived

Written by `build/bin/bench_sensor_faults > docs/sensor_faults.md`; nothing here is typed.

The shipped autopilot (`estimator_ekf`, `path`, `control_slc`) flies `configs/missions/hourglass.yaml`: the Anaconda at 17 m/s, wind 5 m/s, light turbulence, sensors `ublox`. 85 s after it was
armed, on a straight, one sensor goes bad; after 20 s, if the fault does not say otherwise, it is right again, and the flight goes on for 30 s. In both times there are turns of 50 m. Ten seeds a row; the worst of them.
What the simulated aircraft's own faults do not know is made between it and the estimator (`bench/sensor_faults/tampered.hpp`). `sensor_faults_test` flies some of it in `./check`.

- `told`: from the first spoilt sample, of a limit from 0.1 s at it on, until the port `health` says something of that sensor, or a flag of the estimate falls; by what, in how many of the flights in which the fault showed. Promised within 2 s.
- Errors from the fault's begin to the end of the flight, of what is called valid, and behind a stroke of all, where that is more: attitude, velocity, horizontal position, height, airspeed. Promised below what `bench/sensor_faults/rows.hpp` says.
- `airspeed / std`: the error in deviations that the estimate claims of it, at most.
- `step`: the largest change of the error from one tick to the next, of position and height.
- `right again`: from the fault's end until all flags are up and all errors below 1.5 times the largest of the same seed's flight without fault, or below 4 deg, 1 m/s, 5 m, 3 m, 1.5 m/s. Promised within 10 s.
- `also named`: sensors in order of which `health` said something, in any of the flights.

A receiver that contradicts for 9 s (`gnss_reset_after`) is believed after all: from then on the errors of `gnss_jump` and `gnss_snatch` are the receiver's own, and called valid.
The exit code is 1 when a promise is missed. Where none is given there is a dash, and the reason below the table.

| fault | what | told, s | by | errors: deg | m/s | m | height, m | airspeed, m/s | airspeed / std | step, m | height step, m | right again, s | also named |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
)";

constexpr double reported_within_s = 2, recovered_within_s = 10;

/// The largest values of all seeds.
struct Worst {
  unsigned flown = 0, shown = 0, reported = 0, recovered = 0, down = 0;
  Flown of{};

  void add(const Flown& f) {
    ++flown;
    shown += f.shown;
    down += f.crashed;
    reported += f.reported_s >= 0;
    recovered += f.recovered_s >= 0;
    if (f.reported_s > of.reported_s) {
      of.reported_s = f.reported_s;
      of.reported_by = f.reported_by;
    }
    for (std::size_t i = 0; i < whats; ++i) {
      of.most[i] = std::max(of.most[i], f.most[i]);
      of.max_valid[i] = std::max(of.max_valid[i], f.max_valid[i]);
      of.step[i] = std::max(of.step[i], f.step[i]);
    }
    of.over_std = std::max(of.over_std, f.over_std);
    of.recovered_s = std::max(of.recovered_s, f.recovered_s);
    for (const auto& [name, sensor] : sensors)
      if (f.accused.find(name) != std::string::npos && of.accused.find(name) == std::string::npos)
        of.accused += (of.accused.empty() ? "" : ", ") + std::string(name);
  }
};

std::string number(double x, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

std::string reported(const Row& row, const Worst& w) {
  if (w.reported == 0) return "-";
  const std::string most = number(w.of.reported_s, 1);
  if (!row.unreported.empty() || w.reported < w.shown)
    return most + " in " + std::to_string(w.reported) + " of " + std::to_string(w.shown);
  return w.shown < w.flown ? most + " in all " + std::to_string(w.shown) : most;
}
std::string recovered(const Worst& w) {
  if (w.recovered == w.flown) return number(w.of.recovered_s, 1);
  return w.recovered == 0
             ? "-"
             : "- in " + std::to_string(w.flown - w.recovered) + " of " + std::to_string(w.flown);
}

void print(const Row& row, const Worst& w) {
  std::printf("| `%s` | %s | %s | %s |", row.name.c_str(), row.words.c_str(), reported(row, w).c_str(),
              w.of.reported_by.c_str());
  constexpr std::array<int, whats> digits{1, 1, 1, 1, 1};
  for (std::size_t i = 0; i < whats; ++i) {
    const std::string valid = number(w.of.max_valid[i], digits[i]), all = number(w.of.most[i], digits[i]);
    std::printf(" %s |", valid == all ? valid.c_str() : (valid + " / " + all).c_str());
  }
  std::printf(" %.1f | %.1f | %.1f | %s | %s |\n", w.of.over_std, w.of.step[position], w.of.step[height],
              recovered(w).c_str(), w.of.accused.c_str());
  std::fflush(stdout);
}

nlohmann::json json_of(const Row& row, const Worst& w) {
  const auto or_null = [](bool known, double x) { return known ? nlohmann::json(x) : nlohmann::json(); };
  return {{"fault", row.name},
          {"what", row.words},
          {"flown", w.flown},
          {"shown", w.shown},
          {"told", w.reported},
          {"told_s", or_null(w.reported > 0, w.of.reported_s)},
          {"by", w.of.reported_by},
          {"error_valid", w.of.max_valid},
          {"error", w.of.most},
          {"airspeed_error_over_std", w.of.over_std},
          {"step", w.of.step},
          {"recovered", w.recovered},
          {"recovered_s", or_null(w.recovered == w.flown, w.of.recovered_s)},
          {"also_named", w.of.accused},
          {"untold", row.unreported},
          {"unrecovered", row.unrecovered}};
}

/// Bounds of the row that were exceeded.
unsigned missed(const Row& row, const Worst& w) {
  unsigned n = 0;
  const auto bar = [&](bool kept, const std::string& what) {
    if (kept) return;
    std::fprintf(stderr, "missed: %s: %s\n", row.name.c_str(), what.c_str());
    ++n;
  };
  bar(w.down == 0, std::to_string(w.down) + " flights were not flown");
  if (row.unreported.empty()) {
    bar(w.shown > 0, "it never showed");
    bar(w.reported == w.shown, "told in " + std::to_string(w.reported) + " of " + std::to_string(w.shown));
    bar(w.of.reported_s <= reported_within_s, "told after " + number(w.of.reported_s, 2) + " s");
  }
  if (row.unrecovered.empty()) {
    bar(w.recovered == w.flown,
        "right again in " + std::to_string(w.recovered) + " of " + std::to_string(w.flown));
    bar(w.of.recovered_s <= recovered_within_s, "right again after " + number(w.of.recovered_s, 2) + " s");
  }
  for (std::size_t i = 0; i < whats; ++i)
    bar(w.of.max_valid[i] <= row.most[i],
        "an error of " + number(w.of.max_valid[i], 2) + ", at most " + number(row.most[i], 2));
  for (std::size_t i = 0; i < whats; ++i)
    bar(w.of.step[i] <= row.max_step[i], "a step of " + number(w.of.step[i], 2));
  if (row.name == "nothing") bar(w.reported == 0 && w.of.accused.empty(), "something was said");
  bar(w.of.over_std <= row.max_over_std, "airspeed wrong by " + number(w.of.over_std, 1) + " deviations");
  return n;
}

void print_reasons(const std::string& only) {
  std::printf("\nWhat is not promised:\n\n");
  for (const Row& row : rows()) {
    if (!only.empty() && row.name != only) continue;
    if (!row.unreported.empty())
      std::printf("- `%s` need not be told: %s.\n", row.name.c_str(), row.unreported.c_str());
    if (!row.unrecovered.empty())
      std::printf("- `%s` need not be over within 10 s: %s.\n", row.name.c_str(), row.unrecovered.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  unsigned seeds = 10, first = 1, misses = 0;
  bool json = false, compass = false;
  std::string only, with;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--with" && i + 1 < argc)
      with = argv[++i];
    else if (word == "--first" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      first = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--compass")
      compass = true;
    else if (word == "--json")
      json = true;
    else if (word[0] != '-' && only.empty())
      only = word;
    else {
      std::fprintf(stderr,
                   "usage: bench_sensor_faults [--json | --compass [--first SEED]] [--seeds N] [--with "
                   "PLUGIN.so] [NAME]\n");
      return 2;
    }
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-sensor-faults-" + std::to_string(getpid()));
  try {
    if (!only.empty()) row(only);
    fs::create_directories(folder);
    if (compass) {
      misses = fly_compasses(first, seeds, folder, with);
      fs::remove_all(folder);
      return misses == 0 ? 0 : 1;
    }
    std::vector<Each> usual;
    for (unsigned seed = 1; seed <= seeds; ++seed)
      usual.push_back(fly(row("nothing"), seed, {}, folder, "", with).most);
    if (!json) std::printf("%s", heading);
    nlohmann::json all = nlohmann::json::array();
    for (const Row& r : rows()) {
      if (!only.empty() && r.name != only) continue;
      Worst worst;
      for (unsigned seed = 1; seed <= seeds; ++seed)
        worst.add(fly(r, seed, usual[seed - 1], folder, "", with));
      misses += missed(r, worst);
      if (json)
        all.push_back(json_of(r, worst));
      else
        print(r, worst);
    }
    if (json)
      std::printf("%s\n", all.dump(2).c_str());
    else
      print_reasons(only);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ++misses;
  }
  fs::remove_all(folder);
  return misses == 0 ? 0 : 1;
}
