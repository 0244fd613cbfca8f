// SPDX-License-Identifier: BSD-3-Clause
// Whether files have changed: plugins and files of a mission, and the sources that a build makes plugins of.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

/// The state of some files. A file that is written again with the same bytes counts as changed; what comes of
/// it is the same.
class FileStamps {
 public:
  explicit FileStamps(std::vector<std::filesystem::path> files) : files_(std::move(files)), stamps_(read()) {}
  /// Files that differ from the last call, or from the beginning. A file that is being written is waited for.
  std::vector<std::filesystem::path> changed();
  /// A file that was there and is not any more, or "".
  std::filesystem::path missing() const;

 private:
  using Stamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;  // its time and its bytes
  std::map<std::filesystem::path, Stamp> read() const;
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace fulmar::core
