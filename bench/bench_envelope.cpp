// SPDX-License-Identifier: BSD-3-Clause
// Flies at the least airspeed, each flight with another aircraft than that of the laws, in turbulence and
// gusts. Prints docs/envelope.md and exits 1 when a bar is missed.
// bench_envelope [--flights N] [--first SEED] [--jobs N] [--set COMP.PARAM=VALUE]... [--each] [--json]
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/envelope/flight.hpp"
#include "sdk/test/flight/airframe_file.hpp"

using namespace fulmar::envelope_bench;

namespace {

// The bars: ground contacts of 1000 flights, and the longest time beyond the stall.
constexpr int max_on_ground = 2;
constexpr double max_stalled_s = 2;

struct Options {
  int flights = 1000, jobs = 1;
  std::uint64_t first = 1001;
  bool each = false, json = false;
  std::vector<std::pair<std::string, std::string>> set;
};

Flown fly(const Options& o, std::uint64_t seed) {
  const Dispersion d = dispersion(seed);
  const fulmar::Airframe file = fulmar::test::airframe_file(d.kind->airframe);
  fulmar::core::Overrides over = overrides(d, file);
  for (const auto& one : o.set) over.set.push_back(one);
  const std::string mission = std::string(FULMAR_SOURCE_DIR "/bench/envelope/") + d.kind->airframe + ".yaml";
  return Watched(fulmar::core::load_mission(mission, over), d, file.wing.stall_alpha_rad).fly();
}

/// Runs in `jobs` processes, since plugins are loaded once per process. Results by seed.
std::vector<Flown> fly_all(const Options& o) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::vector<pid_t> children;
  for (int job = 0; job < o.jobs; ++job) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      close(ends[0]);
      for (int i = job; i < o.flights; i += o.jobs) {
        Flown f;
        f.seed = o.first + static_cast<std::uint64_t>(i);
        try {
          f = fly(o, f.seed);
        } catch (const std::exception& e) {
          std::fprintf(stderr, "seed %llu: %s\n", static_cast<unsigned long long>(f.seed), e.what());
        }
        if (write(ends[1], &f, sizeof f) != static_cast<ssize_t>(sizeof f)) _exit(1);
      }
      _exit(0);
    }
    children.push_back(child);
  }
  close(ends[1]);
  std::vector<Flown> all;
  for (Flown f; read(ends[0], &f, sizeof f) == static_cast<ssize_t>(sizeof f);) all.push_back(f);
  close(ends[0]);
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  std::sort(all.begin(), all.end(), [](const Flown& a, const Flown& b) { return a.seed < b.seed; });
  return all;
}

/// Statistics of the flights of one aircraft, or of one law.
struct Sum {
  int flights = 0, ended = 0, crashed = 0, stalled_long = 0, reported = 0, lost_height = 0;
  double stalled_s = 0, lowest_m = 1e9;
  void add(const Flown& f) {
    ++flights;
    ended += f.ended;
    crashed += f.crashed;
    stalled_long += f.stalled_s > max_stalled_s;
    reported += f.reported;
    lost_height += f.lost_height;
    stalled_s = std::max(stalled_s, f.stalled_s);
    lowest_m = std::min(lowest_m, f.lowest_m);
  }
};

nlohmann::json json_of(const Sum& s) {
  return {{"flights", s.flights},
          {"ended", s.ended},
          {"on_ground", s.crashed},
          {"stalled_longer_than_2_s", s.stalled_long},
          {"stalled_longest_s", s.stalled_s},
          {"lowest_m", s.lowest_m},
          {"stalls_reported", s.reported},
          {"height_lost_reported", s.lost_height}};
}

void row(const std::string& name, const Sum& s) {
  std::printf("| %s | %d | %d | %d | %d | %.2f | %.0f | %d | %d |\n", name.c_str(), s.flights, s.ended,
              s.crashed, s.stalled_long, s.stalled_s, s.lowest_m, s.reported, s.lost_height);
}

std::string words(const Dispersion& d) {
  char text[200];
  std::snprintf(text, sizeof text,
                "%s, %s, mass %.2f, engine %.2f, CG %+.2f, %s, wind %.1f m/s, gust %.0f/%.0f/%.0f",
                d.kind->name, d.law, d.mass_ratio, d.engine_share, d.cg_aft_ratio, d.turbulence, d.wind_mps,
                d.gust_mps[0], d.gust_mps[1], d.gust_mps[2]);
  return text;
}

void print(const Options& o, const std::vector<Flown>& all, const std::map<std::string, Sum>& sums) {
  std::printf(
      "# At the edge of the envelope, flown\n\n"
      "Written by `build/bin/bench_envelope > docs/envelope.md`; nothing here is typed.\n\n"
      "The hourglass at the airframe's least airspeed, 300 s, 70 m high. Of the seed follow: aircraft, law, "
      "turbulence from none to severe; evenly mass +-15 %%, engine down to 75 %% of its voltage, centre of "
      "gravity from 10 %% of the chord ahead to 20 %% behind (2 %% of static margin are left), wind up to 5 "
      "m/s; in every second flight gusts of 16 m/s every 20 s along one axis of the body. The laws have the "
      "nominal aircraft. The truth judges. Seeds %llu to %llu.\n\n"
      "| | flights | flown to the end | on the ground | alpha beyond the stall for more than 2 s | longest, "
      "s "
      "| lowest, m | stalls reported | height lost, reported |\n|---|---|---|---|---|---|---|---|---|\n",
      static_cast<unsigned long long>(o.first),
      static_cast<unsigned long long>(o.first + static_cast<std::uint64_t>(o.flights) - 1));
  for (const auto& [name, sum] : sums) row(name, sum);
  std::printf("\nOn the ground, or too long beyond the stall:\n\n");
  for (const Flown& f : all)
    if (o.each || f.crashed || f.stalled_s > max_stalled_s || !f.ended)
      std::printf(
          "- seed %llu: %s; %s%.0f s, beyond the stall %.2f s at %.0f s, lowest %.0f m, %d reported, height "
          "error %.1f m\n",
          static_cast<unsigned long long>(f.seed), words(dispersion(f.seed)).c_str(),
          f.crashed ? "on the ground at " : "", f.crash_s, f.stalled_s, f.stalled_at_s, f.lowest_m,
          f.reported, f.calm_m);
}

Options options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--json")
      o.json = true;
    else if (word == "--each")
      o.each = true;
    else if (word == "--flights" && more)
      o.flights = std::atoi(argv[++i]);
    else if (word == "--jobs" && more)
      o.jobs = std::max(1, std::atoi(argv[++i]));
    else if (word == "--first" && more)
      o.first = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--set" && more && std::strchr(argv[i + 1], '=') != nullptr) {
      const std::string one = argv[++i];
      o.set.emplace_back(one.substr(0, one.find('=')), one.substr(one.find('=') + 1));
    } else {
      throw std::invalid_argument(
          "usage: bench_envelope [--flights N] [--first SEED] [--jobs N] [--set COMP.PARAM=VALUE]... "
          "[--each] "
          "[--json]");
    }
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = options(argc, argv);
  const std::vector<Flown> all = fly_all(o);
  std::map<std::string, Sum> sums;
  for (const Flown& f : all) {
    const Dispersion d = dispersion(f.seed);
    for (const std::string& of : {std::string("all"), std::string(d.kind->name), std::string(d.law)})
      sums[of].add(f);
  }
  const Sum& sum = sums["all"];
  if (o.json) {
    nlohmann::json out = nlohmann::json::object();
    for (const auto& [name, one] : sums) out[name] = json_of(one);
    std::printf("%s\n", out.dump(2).c_str());
  } else {
    print(o, all, sums);
  }
  const bool met = sum.crashed * 1000 <= max_on_ground * std::max(sum.flights, 1000) &&
                   sum.stalled_long == 0 && sum.ended == sum.flights && sum.flights == o.flights;
  return met ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
