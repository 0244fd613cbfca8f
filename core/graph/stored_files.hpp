// SPDX-License-Identifier: BSD-3-Clause
// Files of a mission from a log, in place of those on the disk: names without folders, in the order of
// reading.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/source_file.hpp"

namespace fulmar::core {

class StoredFiles {
 public:
  /// Name -> text, as in Graph::attachments.
  explicit StoredFiles(std::vector<std::pair<std::string, std::string>> files) : files_(std::move(files)) {}
  /// As read_source. A mission always reads its files in the same order: of two files with one name, the
  /// first belongs to the path that is read first. One thread.
  FilePtr read(const std::filesystem::path& path, const std::string& name) const;
  /// The mission file.
  const std::string& first() const { return files_.front().first; }

 private:
  std::vector<std::pair<std::string, std::string>> files_;
  mutable std::map<std::filesystem::path, std::size_t> known_;
};

}  // namespace fulmar::core
