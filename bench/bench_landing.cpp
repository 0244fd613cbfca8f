// SPDX-License-Identifier: BSD-3-Clause
// Flies from runway to runway, each flight in another wind and with another aircraft than that of the laws.
// Prints docs/landing.md and exits 1 when a bar is missed.
// bench_landing [--flights N] [--first SEED] [--jobs N] [--wind MPS] [--off DEG] [--set COMP.PARAM=VALUE]...
// [--log FILE] [--each] [--json]; --log flies only the seed of --first. --hard [--height M] also draws
// aircraft, centre of gravity, motor, slope, sensors, moderate turbulence, and an error of the runway's
// height of up to M metres.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/landing/flight.hpp"
#include "sdk/test/flight/airframe_file.hpp"

using namespace fulmar::landing_bench;

namespace {

// The bars.
constexpr double min_over_stall = 1.1, max_sink_mps = 1.5, max_cross_m = 5;
constexpr double share_sink = 0.99, share_cross = 0.95;

struct Options {
  int flights = 1000, jobs = 1;
  std::uint64_t first = 1;
  double wind_mps = 12, off_deg = 30, height_off_m = 6;
  bool each = false, json = false, hard = false;
  std::string log;
  std::vector<std::pair<std::string, std::string>> set;
};

Dispersion dispersion_of(const Options& o, std::uint64_t seed) {
  return o.hard ? hard_dispersion(seed, o.height_off_m) : dispersion(seed, o.wind_mps, o.off_deg * deg);
}

/// Runs in `jobs` processes, since plugins are loaded once per process. Results by seed.
std::vector<Landed> fly_all(const Options& o) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::vector<pid_t> children;
  for (int job = 0; job < o.jobs; ++job) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      close(ends[0]);
      for (int i = job; i < o.flights; i += o.jobs) {
        Landed l;
        l.seed = o.first + static_cast<std::uint64_t>(i);
        try {
          const Dispersion d = dispersion_of(o, l.seed);
          l = fly(d, fulmar::test::airframe_file(d.aircraft), o.set, o.log);
        } catch (const std::exception& e) {
          std::fprintf(stderr, "seed %llu: %s\n", static_cast<unsigned long long>(l.seed), e.what());
        }
        if (write(ends[1], &l, sizeof l) != static_cast<ssize_t>(sizeof l)) _exit(1);
      }
      _exit(0);
    }
    children.push_back(child);
  }
  close(ends[1]);
  std::vector<Landed> all;
  for (Landed l; read(ends[0], &l, sizeof l) == static_cast<ssize_t>(sizeof l);) all.push_back(l);
  close(ends[0]);
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  std::sort(all.begin(), all.end(), [](const Landed& a, const Landed& b) { return a.seed < b.seed; });
  return all;
}

/// Nearest rank among the flights with a touch-down (1: the largest).
template <class Value>
double quantile(const std::vector<Landed>& all, double q, Value value) {
  std::vector<double> sorted;
  for (const Landed& l : all)
    if (l.touched) sorted.push_back(value(l));
  if (sorted.empty()) return 0;
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(q * static_cast<double>(sorted.size()) - 1e-9);
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

template <class Is>
int count(const std::vector<Landed>& all, Is is) {
  return static_cast<int>(std::count_if(all.begin(), all.end(), is));
}

struct Statistics {
  explicit Statistics(const std::vector<Landed>& all) : flights(static_cast<int>(all.size())) {
    flown = count(all, [](const Landed& l) { return l.flown; });
    crashed = count(all, [](const Landed& l) { return l.crashed; });
    went_around = count(all, [](const Landed& l) { return l.go_arounds > 0; });
    short_of_it = count(all, [](const Landed& l) { return l.touched && l.along_m < 0; });
    for (const Landed& l : all) over_stall = std::min(over_stall, l.min_over_stall);
    const double n = std::max(flights, 1);
    soft = count(all, [](const Landed& l) { return l.touched && l.sink_mps < max_sink_mps; }) / n;
    near = count(all, [](const Landed& l) { return l.touched && l.beside_receiver_m() < max_cross_m; }) / n;
    sink_50 = quantile(all, 0.5, [](const Landed& l) { return l.sink_mps; });
    sink_99 = quantile(all, 0.99, [](const Landed& l) { return l.sink_mps; });
    sink_most = quantile(all, 1, [](const Landed& l) { return l.sink_mps; });
    cross_95 = quantile(all, 0.95, [](const Landed& l) { return l.beside_receiver_m(); });
    cross_true_95 = quantile(all, 0.95, [](const Landed& l) { return std::abs(l.cross_m); });
    yaw_50 = quantile(all, 0.5, [](const Landed& l) { return std::abs(l.yaw_off_rad) / deg; });
    bank_50 = quantile(all, 0.5, [](const Landed& l) { return std::abs(l.roll_rad) / deg; });
    bank_95 = quantile(all, 0.95, [](const Landed& l) { return std::abs(l.roll_rad) / deg; });
    bank_most = quantile(all, 1, [](const Landed& l) { return std::abs(l.roll_rad) / deg; });
    along_50 = quantile(all, 0.5, [](const Landed& l) { return l.along_m; });
    yaw_95 = quantile(all, 0.95, [](const Landed& l) { return std::abs(l.yaw_off_rad) / deg; });
    yaw_most = quantile(all, 1, [](const Landed& l) { return std::abs(l.yaw_off_rad) / deg; });
    along_5 = quantile(all, 0.05, [](const Landed& l) { return l.along_m; });
    along_95 = quantile(all, 0.95, [](const Landed& l) { return l.along_m; });
    recognised_95 = quantile(all, 0.95, [](const Landed& l) { return l.recognised_s; });
    recognised_most = quantile(all, 1, [](const Landed& l) { return l.recognised_s; });
    early_most = quantile(all, 1, [](const Landed& l) { return l.early_m; });
    nose_down_most = quantile(all, 1, [](const Landed& l) { return l.nose_down_s; });
    roll_out_most = quantile(all, 1, [](const Landed& l) { return l.roll_out_m; });
    roll_out_95 = quantile(all, 0.95, [](const Landed& l) { return l.roll_out_m; });
  }
  bool kept() const {
    return flights > 0 && flown == flights && crashed == 0 && over_stall >= min_over_stall &&
           soft >= share_sink && near >= share_cross;
  }
  int flights, flown = 0, crashed = 0, went_around = 0, short_of_it = 0;
  double over_stall = 1e9, soft = 0, near = 0, sink_50 = 0, sink_99 = 0, sink_most = 0, cross_95 = 0,
         cross_true_95 = 0, yaw_50 = 0, yaw_95 = 0, yaw_most = 0, bank_50 = 0, bank_95 = 0, bank_most = 0,
         along_5 = 0, along_50 = 0, along_95 = 0, roll_out_95 = 0, roll_out_most = 0, recognised_95 = 0,
         recognised_most = 0, early_most = 0, nose_down_most = 0;
};

std::string words(const Dispersion& d) {
  char text[200];
  std::snprintf(text, sizeof text, "%.1f m/s from %+.0f deg, mass %+.0f %%, delay %.0f ms, %s%s", d.wind_mps,
                d.wind_off_rad / deg, 100 * (d.mass_ratio - 1), 1e3 * d.delay_s,
                d.ublox ? "ublox" : "rosflight", d.slow_servos ? ", slow servos" : "");
  return text;
}
std::string hard_words(const Dispersion& d) {
  char text[200];
  std::snprintf(text, sizeof text, "%s, %s, CG %+.0f %%, motor %.0f %%, slope %+.1f deg, height %+.1f m%s",
                d.aircraft.c_str(), d.sensors.c_str(), 100 * d.cg_share, 100 * d.engine_share,
                d.slope_rad / deg, d.height_off_m, d.moderate ? ", moderate" : "");
  return text;
}
std::string derivatives(const Dispersion& d) {
  std::string text;
  for (const auto& [name, ratio] : d.derivatives) {
    char one[40];
    std::snprintf(one, sizeof one, "%s%s %+.0f %%", text.empty() ? "" : ", ", name, 100 * (ratio - 1));
    if (std::abs(ratio - 1) > 0.15) text += one;
  }
  return text;
}

template <class Value>
void print_worst(const Options& o, std::vector<Landed> all, const char* what, const char* format,
                 Value value) {
  std::stable_sort(all.begin(), all.end(),
                   [&](const Landed& a, const Landed& b) { return value(a) > value(b); });
  for (std::size_t i = 0; i < std::min<std::size_t>(3, all.size()); ++i) {
    const Landed& l = all[i];
    const Dispersion d = dispersion_of(o, l.seed);
    std::printf("| %s | ", what);
    std::printf(format, std::abs(value(l)));
    std::printf(" | %llu | %s | %s |\n", static_cast<unsigned long long>(l.seed), words(d).c_str(),
                derivatives(d).c_str());
  }
}

void print(const Options& o, const std::vector<Landed>& all, const Statistics& s) {
  std::printf(
      "# Landings, flown\n\n"
      "Written by `build/bin/bench_landing > docs/landing.md`; nothing here is typed.\n\n"
      "The Anaconda takes off, climbs to 50 m and lands (`bench/landing/mission.yaml`), each time in another "
      "wind and as another aircraft. Of the seed follow, evenly: wind up to %.0f m/s within %.0f deg of the "
      "runway's heading, light turbulence; mass +-10 %%, inertia with it; 18 derivatives +-20 %%, each for "
      "itself; receiver, barometer, compass and pitot tube up to 100 ms late; `rosflight` or `ublox`; every "
      "second flight servos that take twice the time. The laws know the nominal aircraft. The truth "
      "judges.\n\n"
      "| flights | flown | crashed | went around | airspeed over stall, least | touched before the threshold "
      "|\n|---|---|---|---|---|---|\n| %d | %d | %d | %d | %.2f | %d |\n\n",
      o.wind_mps, o.off_deg, s.flights, s.flown, s.crashed, s.went_around, s.over_stall, s.short_of_it);
  std::printf(
      "| at touch-down | | | |\n|---|---|---|---|\n"
      "| sink, m/s | median %.2f | 99 %% %.2f | worst %.2f |\n"
      "| off the centre line, m | 95 %% beside the receiver %.1f | 95 %% in truth %.1f | while rolling, 95 "
      "%% "
      "%.1f |\n"
      "| nose off the runway, deg | median %.1f | 95 %% %.1f | worst %.1f |\n"
      "| bank, deg | median %.1f | 95 %% %.1f | worst %.1f |\n"
      "| behind the threshold, m | 5 %% %.0f | median %.0f | 95 %% %.0f |\n\n",
      s.sink_50, s.sink_99, s.sink_most, s.cross_95, s.cross_true_95, s.roll_out_95, s.yaw_50, s.yaw_95,
      s.yaw_most, s.bank_50, s.bank_95, s.bank_most, s.along_5, s.along_50, s.along_95);
  std::printf(
      "Bars: all flown, none crashed; from lift-off to the flare the mean of a second of true airspeed at "
      "least %.1f times the flight's own stall (`max_lift`, fulmar/flight/model/steady_flight.hpp); sink at "
      "touch-down below %.1f m/s in %.0f %% (%.1f %%); within %.0f m of the centre line beside the "
      "receiver's "
      "own error in %.0f %% (%.1f %%).\n\n"
      "The worst, with what was more than 15 %% off:\n\n| of | | seed | | derivatives "
      "|\n|---|---|---|---|---|\n",
      min_over_stall, max_sink_mps, 100 * share_sink, 100 * s.soft, max_cross_m, 100 * share_cross,
      100 * s.near);
  print_worst(o, all, "airspeed over stall", "%.2f", [](const Landed& l) { return -l.min_over_stall; });
  print_worst(o, all, "sink", "%.2f m/s", [](const Landed& l) { return l.sink_mps; });
  print_worst(o, all, "centre line", "%.1f m", [](const Landed& l) { return l.beside_receiver_m(); });
  print_worst(o, all, "nose", "%.1f deg", [](const Landed& l) { return std::abs(l.yaw_off_rad) / deg; });
}

nlohmann::json json_of(const Statistics& s) {
  return {{"flights", s.flights},
          {"flown", s.flown},
          {"crashed", s.crashed},
          {"went_around", s.went_around},
          {"touched_before_threshold", s.short_of_it},
          {"airspeed_over_stall_least", s.over_stall},
          {"share_soft", s.soft},
          {"share_near", s.near},
          {"sink_median_mps", s.sink_50},
          {"sink_99_mps", s.sink_99},
          {"cross_beside_receiver_95_m", s.cross_95},
          {"cross_95_m", s.cross_true_95},
          {"yaw_off_95_deg", s.yaw_95},
          {"bank_95_deg", s.bank_95},
          {"bank_max_deg", s.bank_most},
          {"yaw_off_max_deg", s.yaw_most},
          {"along_5_m", s.along_5},
          {"along_95_m", s.along_95},
          {"roll_out_cross_95_m", s.roll_out_95},
          {"roll_out_cross_max_m", s.roll_out_most},
          {"touch_down_recognised_95_s", s.recognised_95},
          {"touch_down_recognised_max_s", s.recognised_most},
          {"touch_down_early_max_m", s.early_most},
          {"elevator_down_max_s", s.nose_down_most},
          {"sink_max_mps", s.sink_most},
          {"kept", s.kept()}};
}

void print_each(const Options& o, const std::vector<Landed>& all) {
  for (const Landed& l : all)
    std::fprintf(stderr,
                 "seed %llu%s%s: over stall %.2f, sink %.2f m/s, off %.1f m (receiver %.1f), along %.0f m, "
                 "nose %.1f deg, bank %.1f deg, %u around, recognised %.2f s, early %.1f m, elevator %.1f "
                 "deg, roll-out "
                 "%.1f m, stop %.0f m; %s%s%s\n",
                 static_cast<unsigned long long>(l.seed), l.flown ? "" : " NOT FLOWN",
                 l.crashed ? " CRASHED" : "", l.min_over_stall, l.sink_mps, l.cross_m, l.receiver_m,
                 l.along_m, l.yaw_off_rad / deg, l.roll_rad / deg, l.go_arounds, l.recognised_s, l.early_m,
                 l.nose_down_s, l.roll_out_m, l.stopped_m, words(dispersion_of(o, l.seed)).c_str(),
                 o.hard ? "; " : "", o.hard ? hard_words(dispersion_of(o, l.seed)).c_str() : "");
}

Options options_of(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--json")
      o.json = true;
    else if (word == "--hard")
      o.hard = true;
    else if (word == "--height" && more)
      o.height_off_m = std::atof(argv[++i]);
    else if (word == "--each")
      o.each = true;
    else if (word == "--flights" && more && std::atoi(argv[i + 1]) > 0)
      o.flights = std::atoi(argv[++i]);
    else if (word == "--jobs" && more && std::atoi(argv[i + 1]) > 0)
      o.jobs = std::atoi(argv[++i]);
    else if (word == "--first" && more)
      o.first = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--log" && more) {
      o.log = argv[++i];
      o.flights = 1;
    } else if (word == "--wind" && more)
      o.wind_mps = std::atof(argv[++i]);
    else if (word == "--off" && more)
      o.off_deg = std::atof(argv[++i]);
    else if (word == "--set" && more && std::string(argv[i + 1]).find('=') != std::string::npos) {
      const std::string one = argv[++i];
      o.set.emplace_back(one.substr(0, one.find('=')), one.substr(one.find('=') + 1));
    } else
      throw std::invalid_argument(
          "usage: bench_landing [--hard] [--height M] [--flights N] [--first SEED] [--jobs N] [--wind MPS] "
          "[--off DEG] [--set "
          "COMP.PARAM=VALUE]... [--log FILE] [--each] [--json]");
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options o = options_of(argc, argv);
    const std::vector<Landed> all = fly_all(o);
    const Statistics s(all);
    if (o.each) print_each(o, all);
    if (o.json)
      std::printf("%s\n", json_of(s).dump(2).c_str());
    else
      print(o, all, s);
    return s.kept() && s.flights == o.flights ? 0 : 1;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
