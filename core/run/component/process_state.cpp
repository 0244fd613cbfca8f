// SPDX-License-Identifier: BSD-3-Clause
// Replaces functions of the C library that change state of the whole process, for plugins and their
// libraries: the dynamic linker finds those of the program first. Direct system calls are not detected.
#include "core/run/component/process_state.hpp"

#include <dlfcn.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/loader/messages.hpp"
#include "core/original.hpp"
#include "core/run/component/problem.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {

constinit thread_local const char* refused_call = nullptr;
constinit thread_local bool refuses_calls = false;
constinit thread_local bool refuses_processes = false;

namespace {

constexpr const char* shared = "what that changes is everybody's";
thread_local const char* refused_since = shared;

}  // namespace

void end_forked_copy() noexcept {
  const char* const component = in_step.load(std::memory_order_relaxed);
  std::array<char, 256> text;
  run_messages::host_forked.write(text.data(), text.size(), component ? component : "a component");
  for (const char* const word : {"fulmar: ", static_cast<const char*>(text.data()), "\n"})
    if (write(STDERR_FILENO, word, std::strlen(word)) < 0) break;
  end_copy();
}

std::uint32_t put_right(fulmar_error& problem) noexcept {
  if (!plain_arithmetic()) {
    make_arithmetic_plain();
    put_problem(problem, loader_messages::float_mode_changed);
  } else {
    put_problem(problem, run_messages::call_refused, refused_call, refused_since);
  }
  refused_call = nullptr;
  return FULMAR_FAILED;
}

void pass_on_signals() noexcept {
  sigset_t pending, one;
  if (sigpending(&pending) != 0 || sigisemptyset(&pending)) return;
  const timespec at_once{};
  for (int signal = 1; signal < NSIG; ++signal) {
    if (sigismember(&pending, signal) != 1) continue;
    sigemptyset(&one);
    sigaddset(&one, signal);
    if (sigtimedwait(&one, nullptr, &at_once) == signal) kill(getpid(), signal);
  }
}

namespace {

const pid_t program = getpid();

/// Whether the call is rejected. `changes`: it asks for more than the present state. A process that the
/// component has forked is not the host.
bool refuse(const char* call, bool changes = true, const char* since = shared) noexcept {
  if (!changes || !refuses_calls || getpid() != program) return false;
  refused_call = call;
  refused_since = since;
  return true;
}

bool refuse_process(const char* call) noexcept {
  return refuses_processes && refuse(call, true, run_messages::loop_would_wait.c_str());
}

bool refuse_fork(const char* call) noexcept { return refuse(call, true, copy_would_fly); }

template <class Function>
Function behind(const char* name) noexcept {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace fulmar::core

using fulmar::core::refuse_fork;
#include "core/fork_hooks.hpp"

using fulmar::core::behind;
using fulmar::core::refuse;
using fulmar::core::refuse_process;

extern "C" {

int sigprocmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (refuse("sigprocmask", set != nullptr)) {
    errno = EPERM;
    return -1;
  }
  static const auto next = behind<int (*)(int, const sigset_t*, sigset_t*)>("sigprocmask");
  return next(how, set, old);
}

int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (refuse("pthread_sigmask", set != nullptr)) return EPERM;
  static const auto next = behind<int (*)(int, const sigset_t*, sigset_t*)>("pthread_sigmask");
  return next(how, set, old);
}

int sigaction(int number, const struct sigaction* action, struct sigaction* old) noexcept {
  if (refuse("sigaction", action != nullptr)) {
    errno = EPERM;
    return -1;
  }
  static const auto next = behind<int (*)(int, const struct sigaction*, struct sigaction*)>("sigaction");
  return next(number, action, old);
}

sighandler_t signal(int number, sighandler_t handler) noexcept {
  if (refuse("signal")) {
    errno = EPERM;
    return SIG_ERR;
  }
  static const auto next = behind<sighandler_t (*)(int, sighandler_t)>("signal");
  return next(number, handler);
}

int posix_spawn(pid_t* process, const char* file, const posix_spawn_file_actions_t* actions,
                const posix_spawnattr_t* attributes, char* const words[], char* const environment[]) {
  if (refuse_process("posix_spawn")) return EPERM;
  static const auto next = behind<decltype(&posix_spawn)>("posix_spawn");
  return next(process, file, actions, attributes, words, environment);
}

int posix_spawnp(pid_t* process, const char* file, const posix_spawn_file_actions_t* actions,
                 const posix_spawnattr_t* attributes, char* const words[], char* const environment[]) {
  if (refuse_process("posix_spawnp")) return EPERM;
  static const auto next = behind<decltype(&posix_spawnp)>("posix_spawnp");
  return next(process, file, actions, attributes, words, environment);
}
}
