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

/// Options of one flight.
struct RunOptions {
  std::string mission;
  Overrides overrides;
  double speed = 0;  // times real time; 0: as fast as possible
  std::optional<double> duration_s;
  std::string log_file;
  bool no_log = false, json = false;
  std::optional<std::string> report;  // HTML file that is made from the log; "": beside the log
  bool strict = false;                // a flight in which a guard stopped a component has its own exit code
  std::string drivers_from;           // log whose driver samples are fed in place of the drivers
  std::optional<std::string> resume;  // log from which the flight resumes; "": the newest of the mission
  bool no_resume = false;             // on hardware: begin at the first phase even when the newest log would
                                      // resume
  std::string live;                   // address for clients, in place of the mission's `live:`; "off": none
  int realtime = 0;                   // priority of the loop's thread; 0: ordinary scheduling
  struct Part {                       // for one of several flights
    const char* no_restart = "";      // why a client cannot restart it
    bool keep_inputs = false;         // keep inputs for the rehearsal of a changed plugin
    bool brief = false;               // one line for the flight, and its warnings
  } part;
};

/// Options of several flights.
struct ManyOptions {
  std::string seeds;   // one flight for each seed; "": none
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
