// SPDX-License-Identifier: BSD-3-Clause
// What a log holds, and what of it costs how much.
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
    std::uint64_t bytes = 0;  // of the messages as they are, with their heads
    double stored_bytes = 0;  // its part of the file: compressed alone, and scaled so that all topics
                              // together fill the file; its index
    std::int64_t first_ns = 0, last_ns = 0;  // flight time
  };
  struct Event {
    std::int64_t time_ns = 0;
    std::string kind, component, text, severity;  // the last one "" in logs that say none
  };
  struct Phase {
    std::string name;
    std::int64_t begin_ns = 0, end_ns = 0;
    std::string because;  // the condition that led to it
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
  Verdict verdict;  // of the flight; "" when the log ends before it

  double minutes() const { return static_cast<double>(end_ns - begin_ns) / 60e9; }
  /// Of the metadata; "" when there is none.
  std::string value(const std::string& metadata, const std::string& key) const;
};

/// Throws Error for what is no log.
LogInfo read_info(const std::filesystem::path& log);

}  // namespace fulmar::core
