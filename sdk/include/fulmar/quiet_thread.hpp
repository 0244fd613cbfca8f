// SPDX-License-Identifier: BSD-3-Clause
// Threads beside the loop's, of the host or of a component. Signals are for the main thread, and one for a
// file at its size limit comes back as an error of write; but what crashes a thread is its own, and is told
// from it.
#pragma once
#include <pthread.h>
#include <sys/mman.h>

#include <csignal>
#include <thread>
#include <utility>

namespace fulmar {

/// Those with which code crashes its own thread: blocked, they would end the process without a word.
inline constexpr int crash_signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};

/// While it lives this thread takes no other signal, and neither do those that it creates meanwhile, in all
/// their life.
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

/// While it lives, a crash of this thread is handled on a stack of its own: the thread's may be at its end.
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
    sigaltstack(&before_, nullptr);  // a sanitizer has one of its own
    munmap(stack_.ss_sp, size);
  }
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  static constexpr std::size_t size = 64 * 1024;
  stack_t stack_{}, before_{};
};

/// A thread that takes no signal but those of a crash, which is told.
/// `name` has at most 15 characters: that is what Linux shows of it.
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
