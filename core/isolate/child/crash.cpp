// SPDX-License-Identifier: BSD-3-Clause
#include "core/isolate/child/crash.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include <csignal>

namespace fulmar::core {
namespace {

ControlBlock* shared = nullptr;
std::uintptr_t stack_top = 0;

// A fault where the main stack would have grown to, had its limit allowed it. A large frame may step over its
// end by far.
bool below_stack(std::uintptr_t address) {
  constexpr std::uintptr_t step = 1u << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= stack_top - step) return false;
  return address < stack_top && address >= stack_top - limit.rlim_cur - step;
}

// Async-signal-safe: atomics and system calls alone. The signal, default again, strikes a second time and
// ends the process.
void last_act(int signal, siginfo_t* about, void*) {
  if (signal == SIGSEGV && about->si_code > 0 &&
      below_stack(reinterpret_cast<std::uintptr_t>(about->si_addr)))
    shared->stack_overflow.store(1);
  shared->signal.store(static_cast<std::uint32_t>(signal));
  futex_wake(shared->answer);
  ::raise(signal);
}

}  // namespace

void tell_crashes(ControlBlock& control) {
  shared = &control;
  stack_top = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  constexpr std::size_t size = 64 * 1024;
  void* room = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return;
  stack_t stack{};
  stack.ss_sp = room;
  stack.ss_size = size;
  ::sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_sigaction = &last_act;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::sigaction(signal, &action, nullptr);
}

}  // namespace fulmar::core
