// SPDX-License-Identifier: BSD-3-Clause
// The component whose code a thread runs, for the report of a crash or a hang. The handler of a signal that a
// component raises runs in the component's own thread, so the value is per thread.
#pragma once
#include <atomic>
#include <string>

#include "core/original.hpp"

namespace fulmar::core {

/// Name of the component whose code runs in this thread, or nullptr.
inline constinit thread_local std::atomic<const char*> in_step{nullptr};
inline constinit thread_local std::atomic<const char*> in_call{"step"};  // name of the function

/// Ends a copy of the program that a component has forked and that returns from its call.
[[noreturn]] void end_forked_copy() noexcept;

/// The component's code runs in this thread during the lifetime of the object. The name must live as long. A
/// copy of the process that the code has forked ends here.
struct Inside {
  Inside(const std::string& component, const char* call) noexcept {
    in_call.store(call, std::memory_order_relaxed);
    in_step.store(component.c_str(), std::memory_order_relaxed);
    original_mark.set();
  }
  ~Inside() {
    if (!original_mark.is_set()) [[unlikely]]
      end_forked_copy();
    in_step.store(nullptr, std::memory_order_relaxed);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
};

}  // namespace fulmar::core
