// SPDX-License-Identifier: BSD-3-Clause
// The flight log: MCAP, profile ros2. A sink of the tap: its own thread encodes, compresses and writes the
// marked samples.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

class Tap;

struct LogResult {
  std::filesystem::path file;  // ends in ".part" when it could not be completed; empty: it is missing
  std::string sha256;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;  // messages lost because the disk was too slow or refused them
  std::string error;          // "" or the fault of the disk
};

class Log {
 public:
  struct Options {
    std::filesystem::path file;  // written as file + ".part", renamed when closed; never overwrites
    bool held = false;           // this process has reserved the name, see OutFile::hold
    std::int64_t epoch_ns = 0;   // added to flight time
    bool wait = true;  // unpaced simulation: the loop waits for the log; else samples beyond its capacity are
                       // lost and counted
    std::vector<bool> channels = {};  // channels of the tap that the file has; empty: all
    int zstd_level = 1;  // below 0: faster. -5 costs 0.6 of level 1 for 12 % more bytes; 0: not compressed
  };
  /// Throws Error when the file exists or cannot be written.
  Log(const Options& options, Tap& tap);
  ~Log();  // closes
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// [setup] Attachments and metadata of the file. Those added before the first message precede it in the
  /// file, so that an interrupted flight has them too; later ones stand at the end. Add nothing that differs
  /// between equal runs.
  void attach(const std::string& name, const std::string& media_type, const std::string& content);
  void metadata(const std::string& name, const std::vector<std::pair<std::string, std::string>>& pairs);

  /// [tick] Whether the disk has failed: no more messages are stored.
  bool failed() const noexcept;
  /// The reason, after a failure.
  const std::string& error() const noexcept;

  /// Flushes, closes, renames. Call once.
  LogResult close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
