// SPDX-License-Identifier: BSD-3-Clause
// Differences between the messages of two logs. Both are read once, in parallel; messages of a topic are
// compared at equal log times, with their content and time of validity.
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/log/reader.hpp"

namespace fulmar::core {

struct MessageDiff {
  struct First {
    std::string topic, field;  // field "" when a message is only in one, or cannot be decoded
    std::int64_t time_ns = 0;  // flight time
    std::string a,
        b;  // values; "absent" for a missing message; for "valid at" times since 1970 in ns
  };
  struct Tick {
    std::uint64_t index = 0;
    std::int64_t time_ns = 0;
  };
  struct Topic {
    std::uint64_t equal = 0, different = 0;  // pairs of messages at equal times
    std::uint64_t only_a = 0, only_b = 0;
  };
  std::optional<First> first;  // none for /fulmar/ticks, whose hashes are not informative
  /// The first tick whose hash in /fulmar/ticks differs: a component published another value, recorded or
  /// not.
  std::optional<Tick> first_tick;
  std::map<std::string, Topic> topics;      // in both
  std::vector<std::string> only_a, only_b;  // topics
  std::string fault_a, fault_b;             // "" or the reason why a log is cut off
  std::uint64_t messages = 0;               // of the first log; these three without the ticks
  std::uint64_t differing_messages = 0, differing_bytes = 0;

  McapFile log_a, log_b;  // data of the logs except messages

  bool messages_equal() const;
};

struct DiffOptions {
  std::uint64_t last_ns =
      std::numeric_limits<std::uint64_t>::max();  // log time: later messages are not compared
  bool whole_topics = false;  // a topic in only one log may hold the first difference, too
};

/// Throws Error for a file that is no log.
MessageDiff diff_messages(const std::filesystem::path& a, const std::filesystem::path& b,
                          const DiffOptions& options = {});

}  // namespace fulmar::core
