// SPDX-License-Identifier: BSD-3-Clause
// State that a component must not change in flight: the floating-point mode and the signal mask of the
// thread, and the signal handlers. The host shares all of it.
#pragma once
#include <cstdint>

#include "core/loader/float_mode.hpp"
#include "core/run/component/running_code.hpp"
#include "fulmar/abi.h"

namespace fulmar::core {

/// The call that was rejected for the component in this thread, as in "sigaction"; nullptr: none.
extern constinit thread_local const char* refused_call;
/// True while a component flies in this thread: such calls are rejected.
extern constinit thread_local bool refuses_calls;
/// The same for calls that start a process: the loop would wait for its start.
extern constinit thread_local bool refuses_processes;

/// Sends blocked signals that this thread has raised on to the whole process.
void pass_on_signals() noexcept;

/// Checks and restores the state after a call. Returns the status of the call; `problem` names the change.
std::uint32_t put_right(fulmar_error& problem) noexcept;
inline std::uint32_t judge(std::uint32_t status, fulmar_error& problem) noexcept {
  if (refused_call == nullptr && plain_arithmetic()) [[likely]]
    return status;
  return put_right(problem);
}

enum class Thread : unsigned char { loop, own };

/// The component's code runs in this thread, in flight, during the lifetime of the object. In a separate
/// thread a component may take longer, and a signal that it raises is handled when the call has returned.
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
