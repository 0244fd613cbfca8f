// SPDX-License-Identifier: BSD-3-Clause
// What a component must leave as it is while it flies: the floating-point mode and the signal mask of the
// thread, and what signals do. The host shares all of that.
#pragma once
#include <cstdint>

#include "core/loader/float_mode.hpp"
#include "core/run/component/running_code.hpp"
#include "fulmar/abi.h"

namespace fulmar::core {

/// The call that was refused to the component whose code runs in this thread, as in "sigaction"; nullptr:
/// none.
extern constinit thread_local const char* refused_call;
/// Such calls are refused now: a component flies in this thread.
extern constinit thread_local bool refuses_calls;
/// And those that start a process: the loop would wait until it runs.
extern constinit thread_local bool refuses_processes;

/// Signals that this thread has sent to itself and does not take are passed on to the whole process.
void pass_on_signals() noexcept;

/// The status of a call after a look at what it has left behind, which is put right; `problem` says what.
std::uint32_t put_right(fulmar_error& problem) noexcept;
inline std::uint32_t judge(std::uint32_t status, fulmar_error& problem) noexcept {
  if (refused_call == nullptr && plain_arithmetic()) [[likely]]
    return status;
  return put_right(problem);
}

enum class Thread : unsigned char { loop, own };

/// As long as it lives, the component's code runs in this thread, in flight. In a thread of its own a
/// component may take its time, and a signal that it raises there is heard when the call has returned.
class InFlight {
 public:
  InFlight(const std::string& component, const char* call, Thread thread = Thread::loop) noexcept
      : inside_(component, call), thread_(thread) {
    refuses_calls = true;
    refuses_processes = thread == Thread::loop;
  }
  ~InFlight() {
    refuses_calls = false;
    refuses_processes = false;
    if (thread_ == Thread::own) pass_on_signals();
  }
  InFlight(const InFlight&) = delete;
  InFlight& operator=(const InFlight&) = delete;

 private:
  Inside inside_;
  const Thread thread_;
};

}  // namespace fulmar::core
