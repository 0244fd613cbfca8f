// SPDX-License-Identifier: BSD-3-Clause
// fulmar-child NAME COPY SCRIPT PATH FILE INDEX SEED: runs one component for a host over the memory at
// descriptor 3. Started by the host.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "core/isolate/child/heap.hpp"
#include "core/isolate/child/session.hpp"
#include "core/loader/crash_signal.hpp"

using namespace fulmar::core;

namespace {

// ---- crash: reports the signal to the host and wakes it

ControlBlock* shared = nullptr;
std::uintptr_t stack_top = 0;
pid_t own_process = 0;

// Whether the fault is just below the main stack, beyond its limit. A large frame may skip far past the end.
bool below_stack(std::uintptr_t address) {
  constexpr std::uintptr_t step = 1u << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= stack_top - step) return false;
  return address < stack_top && address >= stack_top - limit.rlim_cur - step;
}

// Async-signal-safe: atomics and system calls alone. The signal has its default action again, is raised a
// second time and ends the process.
void last_act(int signal, siginfo_t* about, void*) {
  if (::getpid() != own_process) {  // forked by the component
    ::raise(signal);
    return;
  }
  if (signal == SIGSEGV && about->si_code > 0 &&
      below_stack(reinterpret_cast<std::uintptr_t>(about->si_addr)))
    shared->stack_overflow.store(1);
  shared->signal.store(static_cast<std::uint32_t>(signal));
  futex_wake(shared->answer);
  ::raise(signal);
}

// Handles crash signals on a separate stack, for the calling thread.
void report_crashes(ControlBlock& control) {
  shared = &control;
  own_process = ::getpid();
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

// ---- start

void close_others() {
#ifdef SYS_close_range
  if (::syscall(SYS_close_range, shared_descriptor + 1, ~0u, 0) == 0) return;
#endif
  for (int descriptor = shared_descriptor + 1; descriptor < 1024; ++descriptor) ::close(descriptor);
}

// The child ends with the host, writes no core file unless the user requests one, and inherits only the
// shared memory.
void prepare() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  close_others();
  ::fcntl(shared_descriptor, F_SETFD, FD_CLOEXEC);
  if (std::getenv("FULMAR_CORE") == nullptr) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
  }
  rlimit stack{};
  // without a limit a runaway recursion would take all memory before it is detected
  constexpr rlim_t enough = 64u << 20;
  if (::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur == RLIM_INFINITY) {
    stack.rlim_cur = enough;
    ::setrlimit(RLIMIT_STACK, &stack);
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
}

}  // namespace

int main(int argc, char** argv) {
  struct stat about {};
  if (argc != 8 || ::fstat(shared_descriptor, &about) != 0) {
    std::fputs("usage: fulmar-child NAME COPY SCRIPT PATH FILE INDEX SEED (run by the host)\n", stderr);
    return 2;
  }
  prepare();
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size < sizeof(ControlBlock)) return 2;
  void* memory =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, shared_descriptor, 0);
  if (memory == MAP_FAILED) return 2;
  ::madvise(memory, size, MADV_DONTFORK);  // a forked copy must not write an answer into it
  auto& control = *static_cast<ControlBlock*>(memory);
  if (::getppid() != control.set_up.host_pid) return 1;  // the host died before PR_SET_PDEATHSIG took effect
  report_crashes(control);
  count_heap();
  const Order order{argv[2],
                    argv[3],
                    argv[4],
                    argv[5],
                    std::strtoull(argv[6], nullptr, 10),
                    std::strtoull(argv[7], nullptr, 10)};
  const int code = serve(static_cast<std::byte*>(memory), size, order);
  ::_exit(code);  // without the plugin's exit handlers, which could delay the end
}
