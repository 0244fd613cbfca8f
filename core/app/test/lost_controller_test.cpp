// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, whose outer law fails in the middle of a turn: the fallback completes the flight with a
// small deviation.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/run/component/allocation.hpp"
#include "core/run/flight.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

struct Position {
  double t_s, north_m, east_m, down_m, roll_rad;
};

Graph mission(const std::string& how) {
  const std::string configs = std::string(FULMAR_SOURCE_DIR) + "/configs/";
  const fs::path file = fs::temp_directory_path() / ("fulmar-lost-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "mission: lost\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\n"
      << "done: \"manage.progress.circuits >= 1\"\ncomponents:\n"
      << "  sim:  {params: {sensors: rosflight, wind_ned: [3.5355, -3.5355, 0], turbulence: light, "
         "start_heading: 135 deg}}\n"
      << "  plan: {params: {plan: " << configs << "plans/hourglass.yaml}}\n"
      << "  bad:  {fills: outer, use: bad_outer, rate: 100 Hz, " << how << "}\n"
      << "phases:\n  cruise: {outer: {use: bad, fallback: slc}}\n";
  setenv("FULMAR_PLUGIN_PATH", FULMAR_TEST_PLUGIN_DIR, 1);
  Graph graph = load_mission(file.string());
  fs::remove(file);
  return graph;
}

struct Flown {
  FlightResult result;
  std::vector<Position> truth;
};

Flown fly(const Graph& graph, double speed) {
  FlightOptions o;
  o.log = false;
  o.speed = speed;
  Flight flight(graph, o);
  const auto vehicle = static_cast<std::size_t>(graph.vehicle);
  const int output = graph.components[vehicle].info().output("truth");
  const Type& type = *graph.components[vehicle].info().outputs[static_cast<std::size_t>(output)].type;
  const auto offset = [&](const char* name) { return resolve_field(type, name).offset; };
  const std::uint32_t at[] = {offset("position_m.north"), offset("position_m.east"),
                              offset("position_m.down"), offset("roll_rad")};
  Flown flown;
  do {
    const std::byte* message = flight.sample({Source::Kind::component, graph.vehicle, output});
    if (!message) continue;
    double x[4];
    for (int i = 0; i < 4; ++i) std::memcpy(&x[i], message + at[i], sizeof(double));
    flown.truth.push_back({1e-9 * static_cast<double>(flight.now_ns()), x[0], x[1], x[2], x[3]});
  } while (flight.step());
  flown.result = flight.finish();
  return flown;
}

/// Largest distance at equal times, while both flew.
double deviation_m(const std::vector<Position>& a, const std::vector<Position>& b) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    REQUIRE(a[i].t_s == b[i].t_s);
    most = std::max(
        most, std::hypot(a[i].north_m - b[i].north_m, a[i].east_m - b[i].east_m, a[i].down_m - b[i].down_m));
  }
  return most;
}

}  // namespace

TEST_CASE("a controller that is lost in the middle of a turn costs less than 5 m") {
  const Flown whole = fly(mission("params: {}"), 0);
  REQUIRE(whole.result.outcome == Outcome::flown);
  const auto turn = std::find_if(whole.truth.begin(), whole.truth.end(),
                                 [](const Position& p) { return p.t_s > 20 && std::abs(p.roll_rad) > 0.4; });
  REQUIRE(turn != whole.truth.end());
  const std::string when = ", at: " + std::to_string(turn->t_s + 0.5) + " s}";
  struct Row {
    const char* fault;
    const char* how;
    const char* reported;
    double speed;
    bool crash;
  };
  const Row rows[] = {
      {"nan", "", "types.value_not_finite(", 0, false},
      {"throws", "", "lost", 0, false},
      {"overrun", "budget: 2 ms, ", "run.time_budget_exceeded", 50, false},
      {"nan", "run: process, ", "types.value_not_finite(", 0, false},
      {"segfault", "run: process, ", "isolate.segmentation_fault", 0, true},
      {"abort", "run: process, ", "isolate.aborted", 0, true},
      {"hang", "run: process, hang: 500 ms, ", "isolate.child_hung(500)", 200, true},
      {"leak", "run: process, ", "run.heap_too_large(", 0, true},
  };
  for (const Row& row : rows) {
    if (row.crash && !counts_allocations())
      continue;  // a sanitized child reports crashes in a different form, and does not count its heap
    CAPTURE(std::string(row.fault));
    CAPTURE(std::string(row.how));
    const Flown flown = fly(mission(std::string(row.how) + "params: {fault: " + row.fault + when), row.speed);
    CHECK(flown.result.outcome == Outcome::flown);
    REQUIRE(flown.result.guards.size() == 1);
    CHECK(flown.result.guards[0].component == "bad");
    CHECK(flown.result.guards[0].action == "slc takes over");
    CHECK(flown.result.guards[0].what.find(row.reported) != std::string::npos);
    const double deviation = deviation_m(whole.truth, flown.truth);
    MESSAGE(std::string(row.fault) << std::string(row.how[0] == 'r' ? ", in a child" : ", in the loop")
                                   << ": at most " << deviation << " m from the flight without a fault");
    CHECK(deviation < 5);
    CHECK(deviation > 0);  // the fallback did take over
  }
}
