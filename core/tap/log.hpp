// SPDX-License-Identifier: BSD-3-Clause
// The flight log: MCAP, profile ros2. The loop copies raw messages into a ring; a thread of its own encodes, compresses and writes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/loader/type.hpp"

namespace fulmar::core {

struct LogChannel {
  std::string topic;  // "/nav/state"
  TypePtr type;
};

struct LogResult {
  std::filesystem::path file;  // ends in ".part" when it could not be finished
  std::string sha256;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;  // messages lost because the ring was full or the disk refused them
  std::string error;          // "" or what the disk said
};

class Log {
 public:
  struct Options {
    std::filesystem::path file;  // written as file + ".part", renamed when closed; never overwrites
    std::int64_t epoch_ns = 0;   // added to flight time
    bool wait = true;            // unpaced simulation: the loop waits for the log; else a full ring drops, counted
    std::size_t ring_bytes = 4u << 20;
    int zstd_level = -5;  // below 0: faster. -5 costs 0.6 of level 1 for 6 % more bytes; 0: not compressed
  };
  /// Throws Error when the file is there already or cannot be written.
  Log(const Options& options, const std::vector<LogChannel>& channels);
  ~Log();  // closes
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// [setup] Attachments and metadata of the file. What comes before the first message stands before it in the file, so that an interrupted
  /// flight has it too; what comes later stands at the end. Nothing that differs between equal runs.
  void attach(const std::string& name, const std::string& media_type, const std::string& content);
  void metadata(const std::string& name, const std::vector<std::pair<std::string, std::string>>& pairs);

  /// [tick] One message of channels[channel], `data` a struct of its type, valid at and logged at flight times. No allocation, no lock.
  void write(std::size_t channel, std::int64_t log_ns, std::int64_t valid_ns, const std::byte* data) noexcept;

  /// [tick] How long `write` has waited for room since this was last asked.
  std::int64_t take_wait_ns() noexcept;
  /// [tick] Messages lost so far because the ring was full.
  std::uint64_t dropped() const noexcept;
  /// [tick] The disk has failed: no more messages are stored. close() says why.
  bool failed() const noexcept;

  /// Flushes, closes, renames. Call once.
  LogResult close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
