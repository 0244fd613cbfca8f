// SPDX-License-Identifier: BSD-3-Clause
// The range of a live parameter holds what an aircraft survives: those of the estimator, flown at both ends
// on three aircraft. A draw of them here; all of them with --no-skip.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/graph/mission.hpp"
#include "core/run/flight.hpp"
#include "core/types/named.hpp"

namespace live_ranges_test {

using namespace fulmar::core;

namespace {

struct Craft {
  const char *name, *airspeed, *radius;
};
constexpr Craft crafts[] = {
    {"anaconda", "17 m/s", "50 m"}, {"x8", "18 m/s", "60 m"}, {"aerosonde", "25 m/s", "110 m"}};

struct Case {
  Craft craft;
  std::string param, value;
};

class Folder {
 public:
  Folder() : path(std::filesystem::temp_directory_path() / ("fulmar_ranges_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(path);
    const std::string configs = FULMAR_SOURCE_DIR "/configs/";
    for (const Craft& c : crafts)
      std::ofstream(path / (std::string(c.name) + ".yaml"))
          << "extends: " << configs << "missions/hourglass.yaml\nlive: off\nairframe: " << configs
          << "airframes/" << c.name << ".yaml\ncomponents: {plan: {params: {plan.airspeed: " << c.airspeed
          << ", plan.turn_radius: " << c.radius << "}}}\n";
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  Graph mission(const Case& c) const {
    Overrides o;
    if (!c.param.empty()) o.set.emplace_back(c.param, c.value);
    return load_mission((path / (std::string(c.craft.name) + ".yaml")).string(), o);
  }
  std::filesystem::path path;
};

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Both ends of each live number of the estimator.
std::vector<Case> cases(const Folder& folder) {
  std::vector<Case> list;
  const Graph graph = folder.mission({crafts[0], "", ""});
  for (const ParamInfo& p : find_named(graph.components, "ekf")->info().params)
    for (const double end : {p.min, p.max})
      for (const Craft& craft : crafts)
        if (p.live && p.kind == FULMAR_NUMBER) list.push_back({craft, "ekf." + p.name, text_of(end)});
  return list;
}

void survives(const Folder& folder, const Case& c) {
  CAPTURE(c.craft.name);
  CAPTURE(c.param);
  CAPTURE(c.value);
  const Graph graph = folder.mission(c);
  FlightOptions options;
  options.log = false;
  options.duration_s = 120;
  CHECK(Flight(graph, options).run().outcome == Outcome::flown);
}

}  // namespace

TEST_CASE("an aircraft survives both ends of the ranges of the estimator's live parameters: a draw") {
  const Folder folder;
  std::vector<Case> list = cases(folder);
  CHECK(list.size() > 200);
  std::mt19937_64 draw(1);
  for (int i = 0; i < 8; ++i) survives(folder, list[draw() % list.size()]);
}

TEST_CASE("an aircraft survives both ends of the ranges of the estimator's live parameters: all" *
          doctest::skip()) {
  const Folder folder;
  for (const Case& c : cases(folder)) survives(folder, c);
}

}  // namespace live_ranges_test
