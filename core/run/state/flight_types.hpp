// SPDX-License-Identifier: BSD-3-Clause
// The options of a flight and its result.
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run/component/stats.hpp"
#include "core/run/state/ending.hpp"
#include "core/run/state/resume.hpp"
#include "core/tap/log.hpp"
#include "links/dds/stats.hpp"
#include "links/live/stats.hpp"

namespace fulmar::core {

struct FlightOptions {
  double speed = 0;                  // times real time; 0: as fast as the machine allows
  std::optional<double> duration_s;  // flight time from 0; then the flight counts as flown
  bool log = true;
  std::filesystem::path log_file;      // must not exist
  bool log_held = false;               // this process has reserved its name, see OutFile::hold
  std::optional<Resume> resume;        // state to resume from, in place of the first phase
  bool keep_inputs = false;            // of every component's last steps, for the rehearsal of a swap
  std::filesystem::path drivers_from;  // log whose samples are fed in place of the drivers
  std::shared_ptr<class Circumstances> circumstances;  // of a replayed flight
  std::atomic<int>* interrupt = nullptr;  // not 0: requests the end of the flight; set back to 0 when it is
                                          // rejected
  std::function<void(const class Flight&)> progress;  // called about every 200 ms of wall time, between ticks
  std::function<void(const std::string&, bool warning)>
      say;  // one line for the user, as it happens: phases, guards
  /// Reason why the flight cannot end for another flight of its mission; "": it can, and its owner starts
  /// that one when the result requests it.
  std::string no_restart = "who began this flight begins no other";
};

/// The flight has ended for another flight of its mission.
struct Restart {
  std::optional<std::uint64_t> seed;  // none: as before
};

struct PhaseVisit {
  std::string name;
  std::int64_t from_ns = 0, to_ns = 0;
  std::string because;  // the condition of the transition; "": the first phase, or a command
};

/// A guard that fired: the fault of the component, and the action of the host.
struct GuardEvent {
  std::int64_t at_ns = 0;
  std::string component, what, action;
};

/// Component of a role, with start and end time.
struct Tenure {
  std::string role, component;
  std::int64_t from_ns = 0, to_ns = 0;
};

/// By the wall clock.
struct WallClock {
  double took_s = 0;        // first to last tick
  double behind_max_s = 0;  // largest delay of a paced flight
};

struct FlightResult {
  Outcome outcome = Outcome::failed;
  std::string reason;
  std::string idle;  // the role without an active component, of an aircraft that never left the ground; "":
                     // it has begun
  std::int64_t first_ns = 0, last_ns = 0;  // flight time of the first and last tick
  std::uint64_t ticks = 0;
  WallClock wall;
  std::vector<PhaseVisit> phases;
  std::vector<GuardEvent> guards;
  std::vector<Tenure> tenures;
  std::vector<ComponentStats> components;
  LogResult log;
  std::optional<LiveStats> live;  // of a flight with a live view
  std::optional<DdsStats> dds;
  std::uint64_t loop_allocations = 0;  // of the whole loop, after its first tick and before its last
};

}  // namespace fulmar::core
