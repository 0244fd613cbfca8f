// SPDX-License-Identifier: BSD-3-Clause
// Readable and executable memory of this process, from /proc/self/maps: the host rejects the tables of a
// damaged plugin before a pointer can crash it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fulmar::core {

class Memory {
 public:
  /// Reads the current mappings. On a system without /proc every pointer but null counts as readable.
  Memory();
  bool readable(const void* at, std::size_t size) const { return covered(readable_, at, size); }
  bool executable(const void* at) const { return covered(executable_, at, 1); }

  /// The NUL-terminated text at `at`. Throws Error naming `what` when it is null, outside the memory or
  /// longer than 4095 bytes.
  std::string text(const char* at, const std::string& what) const;

 private:
  struct Range {
    std::uintptr_t begin, end;
  };
  bool covered(const std::vector<Range>& ranges, const void* at, std::size_t size) const;
  std::size_t readable_bytes(const void* at) const;

  std::vector<Range> readable_, executable_;  // ascending; neighbours joined
  bool known_ = false;
};

}  // namespace fulmar::core
