// SPDX-License-Identifier: BSD-3-Clause
// Contents of a log, and the share of each topic in its size.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/log/reader.hpp"

namespace fulmar::core {

struct LogInfo {
  struct Topic {
    std::string topic, type;
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;  // of the messages without compression, with their headers
    // its share of the file: compressed alone, scaled so that all topics together fill the file; with its
    // index
    double stored_bytes = 0;
    std::int64_t first_ns = 0, last_ns = 0;  // flight time
  };
  struct Event {
    std::int64_t time_ns = 0;
    std::string kind, component, text, severity;  // severity "" in logs without severities
  };
  struct Phase {
    std::string name;
    std::int64_t begin_ns = 0, end_ns = 0;
    std::string because;  // condition that caused it
  };
  struct Verdict {
    std::string words, severity;
  };
  McapFile file;  // without messages
  std::uint64_t bytes = 0, messages = 0;
  std::int64_t begin_ns = 0, end_ns = 0;  // flight time of the first and the last message
  std::vector<Topic> topics;              // in order of name
  std::vector<Event> events;              // of /fulmar/event
  std::vector<Phase> phases;
  Verdict verdict;  // of the flight; "" for a log that is cut off before its end

  double minutes() const { return static_cast<double>(end_ns - begin_ns) / 60e9; }
  /// Value from the metadata; "" for none.
  std::string value(const std::string& metadata, const std::string& key) const;
};

/// Throws Error for a file that is no log.
LogInfo read_info(const std::filesystem::path& log);

}  // namespace fulmar::core
