// SPDX-License-Identifier: BSD-3-Clause
// The options of `fulmar run`.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "core/app/mission_options.hpp"
#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Of one flight.
struct RunOptions {
  std::string mission;
  Overrides overrides;
  double speed = 0;  // times real time; 0: as fast as possible
  std::optional<double> duration_s;
  std::string log_file;
  bool no_log = false, json = false;
  std::optional<std::string> report;  // HTML file that is made of the log; "": beside the log
  bool strict = false;                // a flight in which a guard fired ends with an exit code of its own
  std::string drivers_from;           // log whose driver samples are fed in place of the drivers
  std::optional<std::string> resume;  // log where to go on; "": the newest of the mission
  bool no_resume = false;             // on hardware: begin at the beginning, whatever the newest log says
  std::string live;  // where onlookers connect, in place of the mission's `live:`; "off": nowhere
  int realtime = 0;  // priority of the loop's thread; 0: an ordinary one
  struct Part {      // of several flights
    const char* no_restart = "";  // why a client cannot restart it
    bool keep_inputs = false;     // for the rehearsal of a plugin that changes
    bool brief = false;           // one line for the flight, and its warnings
  } part;
};

/// Several flights.
struct ManyOptions {
  std::string seeds;   // a flight with each of them; "": none
  int repeat = 0;      // flights in one host; 0: one, or with `watch` until interrupted
  bool watch = false;  // a plugin or file that changes is used by the next flight
  std::string build;   // command that watch runs when a source file beside the mission has changed
  bool asked() const { return !seeds.empty() || repeat > 0 || watch || !build.empty(); }
};

class RunArguments {
 public:
  void add(CLI::App* command);
  /// Throws CLI::ValidationError (wrong usage).
  RunOptions options(const CLI::App* command) const;

  ManyOptions many;

 private:
  void add_many(CLI::App* command);
  void add_resume(CLI::App* command);

  MissionOptions mission_;
  RunOptions run_;
  std::string speed_ = "max", resume_log_, report_file_;
};

}  // namespace fulmar::core
