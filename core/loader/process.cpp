// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/error.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {

pid_t spawn(const std::string& program, std::vector<std::string> words, const ChildFiles& files) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto place = [&](int from, int to) {
    if (from < 0)
      posix_spawn_file_actions_addopen(&actions, to, "/dev/null", to == STDIN_FILENO ? O_RDONLY : O_WRONLY,
                                       0);
    else if (from != to || ::fcntl(from, F_GETFD) >= 0)  // same number: keeps the descriptor open over the
                                                         // exec
      posix_spawn_file_actions_adddup2(&actions, from, to);
  };
  if (files.third >= 0) place(files.third, 3);  // first: it may be one of 0, 1 and 2
  place(files.out, STDOUT_FILENO);
  place(files.error, STDERR_FILENO);
  place(files.in, STDIN_FILENO);
#if __GLIBC_PREREQ(2, 34)
  // the child must not inherit serial ports and sockets
  if (!files.others) posix_spawn_file_actions_addclosefrom_np(&actions, files.third >= 0 ? 4 : 3);
#endif
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  words.insert(words.begin(), program);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = -1;
  const int fault = ::posix_spawn(&pid, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) throw Error(loader_messages::program_not_started(program, std::strerror(fault)));
  return pid;
}

Process::~Process() {
  if (ended()) return;
  kill();
  siginfo_t how{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED) != 0 && errno == EINTR) continue;
}

bool Process::ended() noexcept {
  if (reaped_) return true;
  siginfo_t how{};
  if (::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOHANG | WNOWAIT) == 0) {
    if (how.si_pid == 0) return false;
    ::kill(-pid_, SIGKILL);  // while the zombie still reserves the number of the group
    ::waitid(P_PID, static_cast<id_t>(pid_), &how, WEXITED | WNOHANG);
    (how.si_code == CLD_EXITED ? exit_code_ : signal_) = how.si_status;
  } else if (errno == EINTR) {
    return false;
  }
  reaped_ = true;
  return true;
}

void Process::kill() noexcept {
  if (reaped_) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);  // the child may have left its group
}

bool Process::wait(std::chrono::nanoseconds limit) noexcept {
  constexpr std::chrono::microseconds first{20}, longest{1000};
  const auto end = std::chrono::steady_clock::now() + limit;
  for (auto pause = first; !ended(); pause = std::min(2 * pause, longest)) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace fulmar::core
