// SPDX-License-Identifier: BSD-3-Clause
// A file in memory through which this process and its child exchange a text.
#pragma once
#include <string>

namespace fulmar::core {

/// Removed with this object. `descriptor` is the child's end; `contents` is the text that the child has
/// written.
class MemoryFile {
 public:
  /// Throws Error when there is no memory for the text.
  explicit MemoryFile(const std::string& text = "");
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int descriptor() const noexcept { return file_; }
  std::string contents() const;

 private:
  int file_ = -1;
};

}  // namespace fulmar::core
