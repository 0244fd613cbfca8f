// SPDX-License-Identifier: BSD-3-Clause
// The memory that the child of an isolated component shares with the host.
#pragma once
#include <cstddef>

namespace fulmar::core {

/// Anonymous memory with a descriptor that a child inherits. It grows and never shrinks: a child cannot take
/// pages from under the host.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t size);  // throws Error
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  std::byte* data() const noexcept { return data_; }
  int descriptor() const noexcept { return descriptor_; }

  /// More of it, from `at` on (whole pages), for as long as this lives.
  class Window {
   public:
    Window(SharedMemory& memory, std::size_t at, std::size_t size);  // throws Error
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    std::byte* data() const noexcept { return data_; }

   private:
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
  };

 private:
  int descriptor_ = -1;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0, whole_ = 0;
};

}  // namespace fulmar::core
