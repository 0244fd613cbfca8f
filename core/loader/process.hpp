// SPDX-License-Identifier: BSD-3-Clause
// Child processes: spawned, not forked, because the host has threads. posix_spawn runs no code of the host
// between the two processes.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace fulmar::core {

/// Open files of a child: descriptors of this process, or -1 for /dev/null.
struct ChildFiles {
  int in = -1, out = -1, error = -1;
  int third = -1;       // its descriptor 3; -1: none
  bool others = false;  // pass on all descriptors that are not closed on exec
};

/// Starts `program`; `words` are its arguments. It gets default signal handlers and its own process group.
/// Then the terminal's interrupt reaches only the host, and the whole group can be killed. Throws Error.
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
  /// Whether the child has ended. When it has, reaps it and kills the rest of its group.
  bool ended() noexcept;
  /// End of the child: a signal, or 0 and an exit code. Valid after `ended` returned true.
  int signal() const noexcept { return signal_; }
  int exit_code() const noexcept { return exit_code_; }
  /// Kills its whole group; does not wait.
  void kill() noexcept;
  /// Waits at most `limit` for its end.
  bool wait(std::chrono::nanoseconds limit) noexcept;

 private:
  pid_t pid_ = -1;
  bool reaped_ = false;
  int signal_ = 0, exit_code_ = 0;
};

}  // namespace fulmar::core
