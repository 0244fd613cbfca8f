// SPDX-License-Identifier: BSD-3-Clause
// Child processes: spawned, never forked, as the host has threads. posix_spawn runs nothing of the host's
// between the two processes.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace fulmar::core {

/// What a child finds open: descriptors of this process, or -1 for /dev/null.
struct ChildFiles {
  int in = -1, out = -1, error = -1;
  int third = -1;       // its descriptor 3; -1: none
  bool others = false;  // it also gets what is not closed on exec
};

/// Starts `program`; `words` are its arguments. Its signals are as they are by default, and it leads a group
/// of its own: the terminal's interrupt is the host's alone, and who is left of it can be stopped with it.
/// Throws Error.
pid_t spawn(const std::string& program, std::vector<std::string> words, const ChildFiles& files);

/// A child process. Ended and reaped with this object at the latest.
class Process {
 public:
  Process(const std::string& program, std::vector<std::string> words, const ChildFiles& files)
      : pid_(spawn(program, std::move(words), files)) {}
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
  /// Waits at most so long for its end.
  bool wait(std::chrono::nanoseconds limit) noexcept;

 private:
  pid_t pid_ = -1;
  bool reaped_ = false;
  int signal_ = 0, exit_code_ = 0;
};

}  // namespace fulmar::core
