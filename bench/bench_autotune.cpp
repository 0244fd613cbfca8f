// SPDX-License-Identifier: BSD-3-Clause
// Autotune in flight, from gains that are wrong by a factor, on three aircraft: the resulting gains, the
// margins measured in flight and those of the linear model. Prints docs/autotune.md. Exits 1 when a flight
// neither measured 6 dB and 45 deg nor restored its old gains, kept gains whose true margins are below 6 dB
// and 45 deg, took longer than 90 s, or failed. Options: see the usage at the end.
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/autotune/flight.hpp"

using namespace fulmar;
using namespace fulmar::autotune;

namespace {

const std::vector factors{0.3, 0.5, 1.0, 2.0, 3.0};

const char* const heading = R"(# Autotune in flight

Written by `build/bin/bench_autotune > docs/autotune.md`; nothing here is typed.

`configs/missions/autotune.yaml` with each of the shipped airframes: sensors `rosflight`, wind and turbulence as told below the table, `control_slc/Autotune` from the shipped gains times `factor`: all of them, kp,
ki and kd of roll and pitch, and the yaw damper's. [plugins/control_slc](../plugins/control_slc/README.md#autotune) has what it does. Some seeds a row; gains are their medians, margins the least of those that were kept.

- `kept`, `back`, `out`: flights that kept what they found, went back to the gains of before, had no such surface, no time left or were ended before.
- `measured`: in flight, at the surface, from the second excitation. 6 dB and 45 deg are asked for, 8 dB, 55 deg and 80 ms are aimed at.
- `true`: of the linear model of the airframe with the gains that were kept, which the autotune does not know; the loop broken at the same surface, all others closed. Gain: up or down, the less.
- `noise`: relative standard error of 1 + L that the autotune claims, the most of those kept.
- `time`, `roll`, `pitch`, `height`: of the whole tuning, the most of all flights.
- `why not`: of the axes that were not kept, as the report says it, and how many of each.

The exit code is 1 when a flight kept gains without having measured 6 dB and 45 deg, or with true margins below that, changed gains without keeping them, took longer than 90 s or was
not flown to its end.

| aircraft | factor | axis | kept | back | out | kp | ki | kd | measured, dB | deg | true, dB | deg | noise | time, s | roll, deg | pitch, deg | height, m | why not |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
)";

double median(std::vector<double> x) {
  if (x.empty()) return 0;
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

// In the order of AutotuneReason.
constexpr std::array<const char*, 10> reasons{"not begun",      "margins do not hold",
                                              "no gains found", "surface at its limit",
                                              "turbulence",     "no answer",
                                              "ended",          "no surface",
                                              "gain is 0",      "no time"};

struct AxisRow {
  unsigned kept = 0, back = 0, out = 0;
  std::array<unsigned, reasons.size()> why{};
  std::vector<double> kp, ki, kd;
  double measured_db = 1e9, measured_deg = 1e9, true_db = 1e9, true_deg = 1e9, noise = 0;

  void add(const Flown& f, std::size_t i) {
    const AutotuneReport& r = f.report;
    const AutotuneVerdict v = verdict(r, i);
    if (v != AutotuneVerdict::kept) {
      ++(v == AutotuneVerdict::left_out || v == AutotuneVerdict::open ? out : back);
      ++why[static_cast<std::size_t>(reason(r, i))];
      return;
    }
    ++kept;
    kp.push_back(r.kp_ratio[i]);
    ki.push_back(r.ki_ratio[i]);
    kd.push_back(r.kd_ratio[i]);
    measured_db = std::min(measured_db, 20 * std::log10(r.gain_margin_ratio[i]));
    measured_deg = std::min(measured_deg, r.phase_margin_rad[i] / degree);
    true_db = std::min(true_db, f.unstable ? 0 : f.truth[i].min_gain_db());
    true_deg = std::min(true_deg, f.unstable ? 0 : std::min(180.0, f.truth[i].phase_rad / degree));
    noise = std::max(noise, r.noise_ratio[i]);
  }
};

struct Row {
  std::array<AxisRow, 3> axis;
  double time_s = 0, roll = 0, pitch = 0, height = 0;
  unsigned missed = 0;
};

std::string why_not(const AxisRow& a) {
  std::string all;
  for (std::size_t i = 0; i < reasons.size(); ++i)
    if (a.why[i] > 0)
      all += (all.empty() ? "" : ", ") + std::string(reasons[i]) + " " + std::to_string(a.why[i]);
  return all;
}

void print(const Case& c, const Row& row) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisRow& a = row.axis[i];
    std::printf("| %s | %g | %s | %u | %u | %u |", c.of.name, c.factor, axes[i], a.kept, a.back, a.out);
    if (a.kept > 0)
      std::printf(" %.3g | %.2g | %.2g | %.1f | %.0f | %.1f | %.0f | %.2f |", median(a.kp), median(a.ki),
                  median(a.kd), a.measured_db, a.measured_deg, a.true_db, a.true_deg, a.noise);
    else
      std::printf(" | | | | | | | |");
    if (i == 0)
      std::printf(" %.1f | %.1f | %.1f | %.1f |", row.time_s, row.roll, row.pitch, row.height);
    else
      std::printf(" | | | |");
    std::printf(" %s |\n", why_not(a).c_str());
  }
  std::fflush(stdout);
}

nlohmann::json json_of(const Case& c, const Row& row) {
  nlohmann::json j{{"aircraft", c.of.name}, {"factor", c.factor},     {"time_s", row.time_s},
                   {"roll_deg", row.roll},  {"pitch_deg", row.pitch}, {"height_m", row.height},
                   {"missed", row.missed}};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisRow& a = row.axis[i];
    nlohmann::json& x =
        j[axes[i]] = {{"kept", a.kept}, {"back", a.back}, {"out", a.out}, {"why_not", why_not(a)}};
    if (a.kept > 0)
      x.update({{"kp", median(a.kp)},
                {"ki", median(a.ki)},
                {"kd", median(a.kd)},
                {"measured_db", a.measured_db},
                {"measured_deg", a.measured_deg},
                {"true_db", a.true_db},
                {"true_deg", a.true_deg},
                {"noise", a.noise}});
  }
  return j;
}

Row fly_row(Case c, unsigned first, unsigned seeds, const fs::path& folder) {
  Row row;
  for (c.seed = first; c.seed < first + seeds; ++c.seed) {
    const Flown f = fly(c, folder);
    const auto miss = [&](const char* what) {
      std::fprintf(stderr, "missed: %s times %g, seed %u: %s\n", c.of.name, c.factor, c.seed, what);
      ++row.missed;
    };
    if (f.crashed || !f.done) miss("it was not flown to the end");
    if (f.report.time_s > 90) miss("longer than 90 s");
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (!promised(f.report, i)) miss(axes[i]);
      const bool kept = verdict(f.report, i) == AutotuneVerdict::kept;
      if (kept && (f.unstable > 0 || f.truth[i].min_gain_db() < 6 || f.truth[i].phase_rad < 45 * degree))
        miss("kept gains whose margins are not true");
      row.axis[i].add(f, i);
    }
    row.time_s = std::max(row.time_s, f.report.time_s);
    row.roll = std::max(row.roll, f.roll_rad / degree);
    row.pitch = std::max(row.pitch, f.pitch_rad / degree);
    row.height = std::max(row.height, f.height_m);
  }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned seeds = 10, first = 1, missed = 0;
  double wind_mps = 5, one_factor = 0;
  bool json = false;
  std::string only, turbulence = "light";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      seeds = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--turbulence" && i + 1 < argc)
      turbulence = argv[++i];
    else if (word == "--first" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      first = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--wind" && i + 1 < argc && std::isdigit(argv[i + 1][0]))
      wind_mps = std::atof(argv[++i]);
    else if (word == "--factor" && i + 1 < argc && std::atof(argv[i + 1]) > 0)
      one_factor = std::atof(argv[++i]);
    else if (word == "--json")
      json = true;
    else if (word[0] != '-' && only.empty() &&
             std::any_of(aircraft.begin(), aircraft.end(), [&](const Aircraft& a) { return a.name == word; }))
      only = word;
    else {
      std::fprintf(stderr,
                   "usage: bench_autotune [--json] [--first SEED] [--seeds N] [--factor F] [--wind MPS] "
                   "[--turbulence none|light|moderate] [anaconda|aerosonde|x8]\n");
      return 2;
    }
  }
  const fs::path folder = fs::temp_directory_path() / ("fulmar-autotune-" + std::to_string(getpid()));
  try {
    fs::create_directories(folder);
    if (!json) std::printf("%s", heading);
    nlohmann::json all = nlohmann::json::array();
    for (const Aircraft& of : aircraft) {
      if (!only.empty() && only != of.name) continue;
      for (const double factor : one_factor > 0 ? std::vector{one_factor} : factors) {
        Case c{.of = of, .factor = factor, .turbulence = turbulence, .wind_mps = wind_mps};
        const Row row = fly_row(c, first, seeds, folder);
        missed += row.missed;
        if (json)
          all.push_back(json_of(c, row));
        else
          print(c, row);
      }
    }
    if (json)
      std::printf("%s\n", all.dump(2).c_str());
    else
      std::printf("\n%u seeds a row from %u on, wind %g m/s, turbulence `%s`.\n", seeds, first, wind_mps,
                  turbulence.c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_autotune: %s\n", e.what());
    ++missed;
  }
  fs::remove_all(folder);
  return missed == 0 ? 0 : 1;
}
