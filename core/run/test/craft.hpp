// SPDX-License-Identifier: BSD-3-Clause
// Flights on a vehicle that represents hardware (craft.cpp).
#pragma once
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/run/test/lab.hpp"

namespace lab {

inline Graph craft(const std::string& tail, const std::vector<std::pair<std::string, std::string>>& set = {},
                   const std::string& io = "fcu") {
  const fs::path file = folder().path / "craft.yaml";
  std::ofstream(file)
      << "mission: craft\nrate: 400 Hz\nio: " << io << "\nfailsafe: {u_frac: -0.25, for: 0.5 s}\n"
      << "roles:\n"
         "  vehicle: {in: {command: law.command}, out: {status: State, applied: Received, notices?: Note}}\n"
         "  law:     {in: {state: vehicle.status}, out: {command: Command}}\n"
         "components:\n"
         "  craft: {fills: vehicle, use: craft/Craft}\n"
         "  law_a: {fills: law, use: craft/Hoarder, run: tick}\n"
      << tail;
  Overrides o;
  o.set = set;
  return load_mission(file.string(), o);
}

struct Printed {
  std::vector<std::string> lines;
  std::vector<bool> warnings;
  int count(const std::string& part) const {
    return static_cast<int>(std::count_if(lines.begin(), lines.end(),
                                          [&](const auto& s) { return s.find(part) != std::string::npos; }));
  }
};

inline FlightOptions listening(Printed& printed) {
  FlightOptions o;
  o.log = false;
  o.say = [&printed](const std::string& line, bool warning) {
    printed.lines.push_back(line);
    printed.warnings.push_back(warning);
  };
  return o;
}

/// Steps until flight time `t_s`; true when the flight continues.
inline bool fly_until(Flight& flight, double t_s) {
  while (static_cast<double>(flight.now_ns()) < t_s * 1e9 - 1)
    if (!flight.step()) return false;
  return true;
}

/// Waits until no other thread of this program is running.
inline void let_others_sleep() {
  const std::string mine = std::to_string(::gettid());
  for (int n = 0, idle = 0; n < 10'000 && idle < 2; ++n) {
    bool asleep = true;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      if (task.path().filename() == mine) continue;
      std::ifstream in(task.path() / "stat");
      std::string text((std::istreambuf_iterator<char>(in)), {});
      const std::size_t name = text.rfind(") ");  // the name may contain blanks
      asleep = asleep && (name == std::string::npos || text.compare(name + 2, 1, "S") == 0);
    }
    idle = asleep ? idle + 1 : 0;
    const timespec pause{0, 50'000};
    if (!asleep) nanosleep(&pause, nullptr);
  }
}

inline double applied(const Graph& g, const Flight& f) { return value(g, f, "craft", "applied", "u_frac"); }
inline bool obeyed(const Graph& g, const Flight& f) { return value(g, f, "craft", "applied", "present") > 0; }
inline double hoard(const Graph& g, const Flight& f, const std::string& law = "law_a") {
  return value(g, f, law, "hoard_ratio", "");
}

}  // namespace lab
