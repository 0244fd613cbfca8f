// SPDX-License-Identifier: BSD-3-Clause
// A file in memory, by which this process and a child that it starts hand a text to each other.
#pragma once
#include <string>

namespace fulmar::core {

/// Gone with this object. The child's end is `descriptor`; `contents` is the text that the child has written.
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
