// SPDX-License-Identifier: BSD-3-Clause
#include "core/isolate/child/fork.hpp"

constinit thread_local const char* fulmar::core::refused_fork = nullptr;
constinit thread_local bool fulmar::core::refuses_forks = false;

static bool refuse_fork(const char* call) noexcept {
  if (!fulmar::core::refuses_forks) return false;
  fulmar::core::refused_fork = call;
  return true;
}
#include "core/fork_hooks.hpp"
