// SPDX-License-Identifier: BSD-3-Clause
// Detects changed files: plugins and files of a mission, and the sources of a plugin's build.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

/// Times and sizes of some files. A file that is rewritten with the same bytes counts as changed, without
/// harm.
class FileStamps {
 public:
  explicit FileStamps(std::vector<std::filesystem::path> files) : files_(std::move(files)), stamps_(read()) {}
  /// Files that differ from the last call, or from construction. Waits until a file is completely written.
  std::vector<std::filesystem::path> changed();
  /// A file that existed at construction and is missing now, or "".
  std::filesystem::path missing() const;

 private:
  using Stamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;  // modification time, bytes
  std::map<std::filesystem::path, Stamp> read() const;
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace fulmar::core
