// SPDX-License-Identifier: BSD-3-Clause
// Threads besides the loop's, of the host or of a component. The main thread handles signals, and a write
// beyond the size limit of a file returns an error. A crash signal stays with the thread that caused it, and
// is reported.
#pragma once
#include <pthread.h>
#include <sys/mman.h>

#include <csignal>
#include <thread>
#include <utility>

namespace fulmar {

/// Crash signals of a thread. If they were blocked, they would end the process without a report.
inline constexpr int crash_signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};

/// While it exists, this thread receives no other signal. The same holds for the whole life of threads
/// created meanwhile.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    sigfillset(&all);
    for (const int crash : crash_signals) sigdelset(&all, crash);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

/// While it exists, a crash of this thread is handled on a separate stack, since the thread's stack may be
/// full.
class CrashStack {
 public:
  CrashStack() {
    void* const room = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return;
    stack_.ss_sp = room;
    stack_.ss_size = size;
    sigaltstack(&stack_, &before_);
  }
  ~CrashStack() {
    if (!stack_.ss_sp) return;
    sigaltstack(&before_, nullptr);  // a sanitizer has its own
    munmap(stack_.ss_sp, size);
  }
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  static constexpr std::size_t size = 64 * 1024;
  stack_t stack_{}, before_{};
};

/// A thread that receives only crash signals, which are reported. `name` has at most 15 characters, the limit
/// of Linux.
template <class Work>
std::thread quiet_thread(const char* name, Work work) {
  const NoSignals none;
  std::thread thread([work = std::move(work)]() mutable {
    const CrashStack stack;
    work();
  });
  pthread_setname_np(thread.native_handle(), name);
  return thread;
}

}  // namespace fulmar
