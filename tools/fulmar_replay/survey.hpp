// SPDX-License-Identifier: BSD-3-Clause
// Facts about a whole log that are needed before its replay, from one reading that stores no samples.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/log/events.hpp"
#include "core/log/reader.hpp"

namespace fulmar::core {

/// Reports of the host about a component that a replay cannot reproduce. Log times.
struct Reported {
  struct Death {
    std::uint64_t log_ns = 0;
    std::string call, cause;
    bool hung = false;
  };
  std::vector<std::uint64_t> over_budget;
  std::vector<std::pair<std::uint64_t, std::string>> guards;  // with their causes
  std::vector<Death> deaths;
  std::vector<std::pair<std::int64_t, std::uint64_t>> late;  // flight time at which a result was due
};

/// Start of a resumed flight, and its parameters.
struct Resumed {
  std::string phase;
  bool begun = false;  // the flight has begun
  std::vector<CommandNote> params;
  std::set<std::uint64_t> places;  // places of these messages in the log
};

struct Survey {
  /// Throws Error for a file that cannot be read or is no MCAP file.
  explicit Survey(const std::filesystem::path& log);

  McapFile log;  // data of the log except messages
  std::uint64_t messages = 0;
  std::map<std::uint16_t, std::uint64_t> lost;  // samples, by channel
  std::set<std::uint16_t> late;                 // channels with a message that is older than one before it

  struct {
    std::uint64_t count = 0;
    std::int64_t first_ns = 0, last_ns = 0;  // flight time of the first and the last one
    std::string fault;                       // "" or the reason why the ticks cannot be replayed
  } ticks;

  std::string event_fault;                         // "" or the reason why the host's events cannot be read
  std::map<std::string, Reported> reported;        // by component
  std::vector<std::uint64_t> signals;              // ticks at which a signal took effect
  std::optional<std::uint64_t> vehicle_failed_ns;  // log time
  std::string last_words;                          // message of the vehicle then
  std::optional<Event> conclusion;                 // with the verdict
  std::optional<std::uint64_t> ended_ns;           // log time at which the flight was ended while armed
  std::uint64_t begun_at = ~std::uint64_t{0};      // place of the first message after the begin of the flight

  std::optional<Resumed> resumed;

 private:
  struct Reading;
};

}  // namespace fulmar::core
