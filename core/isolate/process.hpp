// SPDX-License-Identifier: BSD-3-Clause
// The child of an isolated component, and the memory that it shares with the host.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

/// A child process. Ended and reaped with this object at the latest.
class Process {
 public:
  /// Spawns fulmar-child with `words` as its arguments; `memory` becomes its only descriptor besides the
  /// standard three. Throws Error.
  Process(const std::vector<std::string>& words, const SharedMemory& memory);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const noexcept { return pid_; }
  /// Whether it has ended; it is reaped then, and whoever is left of its group is killed.
  bool ended() noexcept;
  /// How it ended: a signal, or 0 and an exit code. After `ended` said so.
  int signal() const noexcept { return signal_; }
  int exit_code() const noexcept { return exit_code_; }
  /// Kills its whole group; does not wait.
  void kill() noexcept;
  /// Waits at most `limit_ns` for its end.
  bool wait(std::int64_t limit_ns) noexcept;

 private:
  pid_t pid_ = -1;
  bool reaped_ = false;
  int signal_ = 0, exit_code_ = 0;
};

}  // namespace fulmar::core
