// SPDX-License-Identifier: BSD-3-Clause
// An aircraft survives the whole range of each live parameter: those of estimator, laws and guidance, flown
// at both ends on three aircraft. A random sample of them here; all of them with --no-skip.
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
  std::string outer = "slc";  ///< the active law
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
    if (c.outer != "slc") o.roles.emplace_back("outer", c.outer);
    return load_mission((path / (std::string(c.craft.name) + ".yaml")).string(), o);
  }
  std::filesystem::path path;
};

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Both ends of each live number of the component, with this law.
void add(std::vector<Case>& list, const Folder& folder, const std::string& component,
         const std::string& outer) {
  const Graph graph = folder.mission({crafts[0], "", "", outer});
  for (const ParamInfo& p : find_named(graph.components, component)->info().params)
    for (const double end : {p.min, p.max})
      for (const Craft& craft : crafts)
        if (p.live && p.kind == FULMAR_NUMBER)
          list.push_back({craft, component + "." + p.name, text_of(end), outer});
}
std::vector<Case> of_estimator(const Folder& folder) {
  std::vector<Case> list;
  add(list, folder, "ekf", "slc");
  return list;
}
std::vector<Case> of_laws(const Folder& folder) {
  std::vector<Case> list;
  for (const char* component : {"slc", "attitude", "follow", "manage"}) add(list, folder, component, "slc");
  add(list, folder, "tecs", "tecs");
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

void survives_some(const Folder& folder, const std::vector<Case>& list, int count) {
  std::mt19937_64 draw(1);
  for (int i = 0; i < count; ++i) survives(folder, list[draw() % list.size()]);
}

}  // namespace

TEST_CASE("an aircraft survives both ends of the ranges of the live parameters: a random sample") {
  const Folder folder;
  const std::vector<Case> estimator = of_estimator(folder), laws = of_laws(folder);
  CHECK(estimator.size() > 200);
  CHECK(laws.size() > 200);
  survives_some(folder, estimator, 6);
  survives_some(folder, laws, 6);
}

TEST_CASE("an aircraft survives both ends of the ranges of the live parameters: all" * doctest::skip()) {
  const Folder folder;
  for (const std::vector<Case>& list : {of_estimator(folder), of_laws(folder)})
    for (const Case& c : list) survives(folder, c);
}

}  // namespace live_ranges_test
