// SPDX-License-Identifier: BSD-3-Clause
// `fulmar run`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

struct RunOptions {
  std::string mission;
  Overrides overrides;
  double speed = 0;  // times real time; 0: as fast as possible
  std::optional<double> duration_s;
  std::string log_file;
  bool no_log = false, json = false;
  std::optional<std::string> report;  // HTML file that is made of the log; "": beside the log
  bool strict = false;                // a flight in which a guard fired ends with an exit code of its own
  std::vector<std::uint64_t> seeds;   // a flight with each of them
  int repeat = 0;                     // flights in one host; 0: one, or with `watch` until interrupted
  bool watch = false;                 // a plugin or file that changes is used by the next flight
  std::string build;         // command that watch runs when a source file beside the mission has changed
  std::string drivers_from;  // log whose driver samples are fed in place of the drivers
  std::optional<std::string> resume;  // log where to go on; "": the newest of the mission
  bool no_resume = false;             // on hardware: begin at the beginning, whatever the newest log says
  std::string live;  // where onlookers connect, in place of the mission's `live:`; "off": nowhere
  int realtime = 0;  // priority of the loop's thread; 0: an ordinary one
};

/// "real" -> 1, "max" -> 0, "10" -> 10. Throws CLI::ValidationError (wrong usage).
double parse_speed(const std::string& text);

/// Flies; prints progress, then a table or JSON. Returns the exit code.
int run_command(const RunOptions& options);

}  // namespace fulmar::core
