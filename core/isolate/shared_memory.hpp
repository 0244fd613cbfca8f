// SPDX-License-Identifier: BSD-3-Clause
// Memory that the host shares with the child of an isolated component.
#pragma once
#include <cstddef>
#include <memory>

namespace fulmar::core {

struct Unmap {
  std::size_t size = 0;
  void operator()(std::byte* data) const noexcept;
};
using Mapping = std::unique_ptr<std::byte, Unmap>;

/// Anonymous memory with a descriptor that a child inherits. It grows and never shrinks: a child cannot
/// remove pages that the host uses.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t size);  // throws Error
  ~SharedMemory();

  std::byte* data() const noexcept { return data_.get(); }
  int descriptor() const noexcept { return descriptor_; }
  /// Maps more of it, from `at` on (whole pages). Throws Error.
  Mapping window(std::size_t at, std::size_t size);

 private:
  SharedMemory() = default;
  int descriptor_ = -1;
  Mapping data_;
  std::size_t whole_ = 0;
};

}  // namespace fulmar::core
