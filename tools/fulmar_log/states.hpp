// SPDX-License-Identifier: BSD-3-Clause
// States of the aircraft in a log: estimates and truth (VehicleState), fixes (Gnss) and the errors that
// filters report (FilterCheck). Fields are found by name, so that logs of other layouts can be read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/loader/table.hpp"
#include "core/log/reader.hpp"
#include "fulmar/message.hpp"
#include "fulmar/schema.hpp"

namespace fulmar::states {

/// The topics of a log with states, each kind in order of name.
struct StateLog {
  struct Topic {
    std::string name;  // "/nav/state"
    std::uint64_t messages = 0;
    std::uint64_t first_ns = 0, last_ns = 0;  // log time
    double period_ns() const {
      return messages > 1 ? static_cast<double>(last_ns - first_ns) / static_cast<double>(messages - 1) : 0;
    }
    /// True when its samples are farther apart than those of the other topic.
    bool sparser_than(const Topic& other) const { return period_ns() > 1.01 * other.period_ns(); }
  };
  std::filesystem::path file;
  std::vector<Topic> estimates, truths, fixes, checks;
  std::map<std::string, std::string> types;  // of all topics: "/plan/plan" -> "Plan"
  std::uint64_t epoch_ns = 0;
  std::string fault;  // "" or the reason why the log is cut off

  const Topic* find(const std::string& topic) const;  // among estimates and truths
  /// Names of estimates and truths.
  std::vector<std::string> states() const;
};

/// Reads the log once. Throws core::Error for a file that is no log.
StateLog look_for_states(const std::filesystem::path& log);

/// Reads messages of a topic field by field, as far as the definition in the log matches the present one.
class NamedFields {
 public:
  /// Throws core::Error that names the topic when a field of that name has another type in the log.
  NamedFields(const core::McapFile& log, std::uint16_t channel, const core::TypePtr& ours);
  /// Sets the fields of the log; missing ones stay unchanged. Throws core::Error.
  void read(std::span<const std::byte> bytes, std::byte* message) const;

 private:
  std::string topic_;
  core::TypePtr theirs_;
  core::CopyPlan plan_;
  mutable std::vector<std::byte> room_;
};

template <class Message>
class MessageReader {
 public:
  /// `lacking`: values of the fields that the log does not have.
  MessageReader(const core::McapFile& log, std::uint16_t channel, const Message& lacking = {})
      : lacking_(lacking), fields_(log, channel, core::copy_type(describe<Message>())) {}
  Message read(std::span<const std::byte> bytes) const {
    Message message = lacking_;
    fields_.read(bytes, reinterpret_cast<std::byte*>(&message));
    return message;
  }

 private:
  Message lacking_;
  NamedFields fields_;
};

}  // namespace fulmar::states
