// SPDX-License-Identifier: BSD-3-Clause
// Threads beside the loop's. No signal is theirs: those are for the main thread, and one for a file at its
// size limit comes back as an error of write.
#pragma once
#include <pthread.h>

#include <csignal>
#include <thread>
#include <utility>

namespace fulmar::core {

/// Those with which code crashes its own thread.
enum class Faults : bool { blocked, taken };

/// While it lives this thread takes no signal, and neither do those that it creates meanwhile, in all their
/// life.
class NoSignals {
 public:
  explicit NoSignals(Faults faults = Faults::blocked) {
    sigset_t all;
    sigfillset(&all);
    if (faults == Faults::taken)
      for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigdelset(&all, fault);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

/// A thread that takes no signal, but those of faults when it runs a component's code, whose crash is told.
/// `name` has at most 15 characters: that is what Linux shows of it.
template <class Work>
std::thread quiet_thread(const char* name, Work work, Faults faults = Faults::blocked) {
  const NoSignals none(faults);
  std::thread thread(std::move(work));
  pthread_setname_np(thread.native_handle(), name);
  return thread;
}

}  // namespace fulmar::core
