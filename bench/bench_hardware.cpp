// SPDX-License-Identifier: BSD-3-Clause
// Flies missions through the software flight controller, which has no contact switch: nominal flights, wrong
// heights, failures of sensors and radios, pilots who take over. Each log is replayed. Exits 1 when a bar is
// missed.
//   bench_hardware [--seeds N] [--first SEED] [--only WORDS] [--no-replay] [--lines] [--json]
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/hardware/flight.hpp"

using namespace fulmar::hardware_bench;

namespace {

struct Settings {
  int seeds = 20;
  std::uint64_t first = 1;
  std::string only;                                 ///< part of "MISSION, CASE"
  bool json = false, replay = true, lines = false;  ///< lines: prints the reports of a failed flight
};

bool read(int argc, char** argv, Settings& s) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--json")
      s.json = true;
    else if (word == "--no-replay")
      s.replay = false;
    else if (word == "--lines")
      s.lines = true;
    else if (word == "--seeds" && i + 1 < argc)
      s.seeds = std::atoi(argv[++i]);
    else if (word == "--first" && i + 1 < argc)
      s.first = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--only" && i + 1 < argc)
      s.only = argv[++i];
    else
      return false;
  }
  return true;
}

/// Quantile of sorted values.
double share_of(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

/// The flights of one case.
struct Row {
  Case what;
  std::vector<Landing> flights;

  template <class Counted>
  long count(Counted counted) const {
    return std::count_if(flights.begin(), flights.end(), counted);
  }
  std::vector<double> delays() const {
    std::vector<double> all;
    for (const Landing& l : flights)
      if (std::abs(l.recognised_s) < 1e8) all.push_back(std::abs(l.recognised_s));
    std::sort(all.begin(), all.end());
    return all;
  }
  long good() const {
    return count([&](const Landing& l) { return verdict(what, l).empty(); });
  }
  long crashed() const {
    return count([](const Landing& l) { return l.crashed; });
  }
  long again() const {
    return count([](const Landing& l) { return l.again || l.throttle_after > 0; });
  }
  long equal() const {
    return count([](const Landing& l) { return l.replayed_equal; });
  }
  nlohmann::json json() const {
    nlohmann::json list = nlohmann::json::array();
    for (const Landing& l : flights) {
      const bool known = std::abs(l.recognised_s) < 1e8;
      list.push_back({{"seed", l.seed},
                      {"verdict", verdict(what, l)},
                      {"phases", l.phases},
                      {"reason", l.reason},
                      {"touch_down_recognised_s", known ? nlohmann::json(l.recognised_s) : nlohmann::json()},
                      {"throttle_after_frac", l.throttle_after}});
    }
    return {{"mission", what.mission}, {"case", what.name}, {"flights", list}};
  }
};

void print_heading(const Settings& s) {
  std::printf(
      R"(# Missions through the flight controller

Written by `build/bin/bench_hardware --seeds 10 --first 201 --no-replay > docs/hardware_flights.md`; nothing here is typed. It exits 1 when a bar is missed. `--seeds`, `--first` and `--only` choose
flights, `--lines` prints what a flight said that missed its case, `--no-replay` leaves out the replays.

The Anaconda, wind 5 m/s, light turbulence, sensors `rosflight`, through the code of `fcu_serial` on the software flight controller of the tests, in virtual time. The
controller publishes no ground contact, no thrust and no crash, as a real one. `safe` is a rectangle on top of `safe.yaml`. Missions that end in the air are landed by the
pilot. Seeds %llu to %llu. `as asked`: it landed whole; nothing opened the throttle afterwards; phases and lines are those of the case; the touch-down was recognised within
%.1f s, early or late. Bars: all as asked, and within %.1f s in 95 %%. `hardware_landing_test` flies some of it in `./check`; `maiden_flight_test` flies the steps of
[hardware.md](hardware.md#maiden-flight).

| mission | case | flights | as asked | crashed | motor or take-off unasked | touch-down after, 95 %%, s | most, s | logs replayed equal |
|---|---|---|---|---|---|---|---|---|
)",
      static_cast<unsigned long long>(s.first),
      static_cast<unsigned long long>(s.first) + static_cast<unsigned long long>(s.seeds) - 1,
      recognised_most_s, recognised_95_s);
}

void print(const Row& row, bool replayed) {
  const std::vector<double> delays = row.delays();
  std::printf("| %s | %s | %zu | %ld | %ld | %ld | %.2f | %.2f | %s |\n", row.what.mission.c_str(),
              row.what.name.c_str(), row.flights.size(), row.good(), row.crashed(), row.again(),
              share_of(delays, 0.95), share_of(delays, 1),
              replayed ? std::to_string(row.equal()).c_str() : "not flown again");
  std::fflush(stdout);
}

std::vector<double> delays_of(const std::vector<Row>& rows, const std::string& mission = "") {
  std::vector<double> all;
  for (const Row& row : rows) {
    if (!mission.empty() && row.what.mission != mission) continue;
    const std::vector<double> more = row.delays();
    all.insert(all.end(), more.begin(), more.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void print_touch_downs(const std::vector<Row>& rows) {
  std::printf("\n| mission | touch-downs | recognised after, 95 %%, s | most, s |\n|---|---|---|---|\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& mission = rows[i].what.mission;
    const auto same = [&](const Row& row) { return row.what.mission == mission; };
    if (std::any_of(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(i), same)) continue;
    const std::vector<double> delays = delays_of(rows, mission);
    std::printf("| %s | %zu | %.2f | %.2f |\n", mission.c_str(), delays.size(), share_of(delays, 0.95),
                share_of(delays, 1));
  }
}

/// Prints each flight that does not meet its case.
void print_others(const std::vector<Row>& rows, bool lines) {
  for (const Row& row : rows)
    for (const Landing& l : row.flights) {
      const std::string why = verdict(row.what, l);
      if (why.empty()) continue;
      std::printf("- %s, %s, seed %llu: %s (%s)\n", row.what.mission.c_str(), row.what.name.c_str(),
                  static_cast<unsigned long long>(l.seed), why.c_str(), l.flown().c_str());
      for (const auto& [t_s, line] : l.said)
        if (lines) std::printf("  %8.2f s  %s\n", t_s, line.c_str());
    }
}

std::vector<Row> fly_all(const Settings& s, const std::filesystem::path& folder) {
  std::vector<Row> rows;
  for (const Case& c : all_cases()) {
    if ((c.mission + ", " + c.name).find(s.only) == std::string::npos) continue;
    Row row{c, {}};
    for (int i = 0; i < s.seeds; ++i)
      row.flights.push_back(fly(c, s.first + static_cast<std::uint64_t>(i), folder, s.replay));
    if (!s.json) print(row, s.replay);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  if (!read(argc, argv, s)) {
    std::fprintf(stderr,
                 "usage: bench_hardware [--seeds N] [--first SEED] [--only WORDS] [--no-replay] "
                 "[--lines] [--json]\n");
    return 2;
  }
  const auto folder =
      std::filesystem::temp_directory_path() / ("fulmar-bench-hardware-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  setenv("FULMAR_STORE", (folder / "store").c_str(), 1);
  if (!s.json) print_heading(s);
  const std::vector<Row> rows = fly_all(s, folder);
  std::filesystem::remove_all(folder);
  bool kept = true;
  for (const Row& row : rows) kept = kept && row.good() == static_cast<long>(row.flights.size());
  const std::vector<double> delays = delays_of(rows);
  const double p95 = share_of(delays, 0.95), most = share_of(delays, 1);
  kept = kept && p95 <= recognised_95_s && most <= recognised_most_s;
  if (s.json) {
    nlohmann::json out{{"rows", nlohmann::json::array()},
                       {"touch_down_recognised_95_s", p95},
                       {"touch_down_recognised_max_s", most},
                       {"kept", kept}};
    for (const Row& row : rows) out["rows"].push_back(row.json());
    std::printf("%s\n", out.dump(2).c_str());
    return kept ? 0 : 1;
  }
  print_touch_downs(rows);
  std::printf("\nFlights that were not as asked:\n\n");
  print_others(rows, s.lines);
  return kept ? 0 : 1;
}
