// SPDX-License-Identifier: BSD-3-Clause
// Stands in front of the C library's functions that change what is everybody's, for plugins and whatever they
// link: the dynamic linker finds those of the program first. What does not come through them is not seen.
#include "core/run/in_flight.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <clocale>
#include <csignal>

#include "core/run/ports.hpp"

namespace fulmar::core {

constinit thread_local const char* refused_call = nullptr;
constinit thread_local bool refuses_calls = false;

std::uint32_t put_right(fulmar_error& problem) noexcept {
  if (!plain_arithmetic()) {
    make_arithmetic_plain();
    put_problem(problem, "%s", changed_arithmetic);
  } else {
    put_problem(problem, "calls %s in flight; what that changes is everybody's", refused_call);
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

/// Whether the call is refused. `changes`: it asks for more than what is set. A process that the component
/// has forked is not the host.
bool refuse(const char* call, bool changes = true) noexcept {
  if (!changes || !refuses_calls || getpid() != program) return false;
  refused_call = call;
  return true;
}

template <class Function>
Function behind(const char* name) noexcept {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace fulmar::core

using fulmar::core::behind;
using fulmar::core::refuse;

extern "C" {

int chdir(const char* path) noexcept {
  if (refuse("chdir")) return errno = EPERM, -1;
  static const auto next = behind<int (*)(const char*)>("chdir");
  return next(path);
}

int fchdir(int folder) noexcept {
  if (refuse("fchdir")) return errno = EPERM, -1;
  static const auto next = behind<int (*)(int)>("fchdir");
  return next(folder);
}

char* setlocale(int category, const char* locale) noexcept {
  if (refuse("setlocale", locale != nullptr)) return nullptr;
  static const auto next = behind<char* (*)(int, const char*)>("setlocale");
  return next(category, locale);
}

locale_t uselocale(locale_t locale) noexcept {
  if (refuse("uselocale", locale != nullptr)) return errno = EPERM, nullptr;
  static const auto next = behind<locale_t (*)(locale_t)>("uselocale");
  return next(locale);
}

int sigprocmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (refuse("sigprocmask", set != nullptr)) return errno = EPERM, -1;
  static const auto next = behind<int (*)(int, const sigset_t*, sigset_t*)>("sigprocmask");
  return next(how, set, old);
}

int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (refuse("pthread_sigmask", set != nullptr)) return EPERM;
  static const auto next = behind<int (*)(int, const sigset_t*, sigset_t*)>("pthread_sigmask");
  return next(how, set, old);
}

int sigaction(int number, const struct sigaction* action, struct sigaction* old) noexcept {
  if (refuse("sigaction", action != nullptr)) return errno = EPERM, -1;
  static const auto next = behind<int (*)(int, const struct sigaction*, struct sigaction*)>("sigaction");
  return next(number, action, old);
}

sighandler_t signal(int number, sighandler_t handler) noexcept {
  if (refuse("signal")) return errno = EPERM, SIG_ERR;
  static const auto next = behind<sighandler_t (*)(int, sighandler_t)>("signal");
  return next(number, handler);
}

int execve(const char* file, char* const words[], char* const environment[]) noexcept {
  if (refuse("execve")) return errno = EPERM, -1;
  static const auto next = behind<int (*)(const char*, char* const[], char* const[])>("execve");
  return next(file, words, environment);
}

int execv(const char* file, char* const words[]) noexcept {
  if (refuse("execv")) return errno = EPERM, -1;
  static const auto next = behind<int (*)(const char*, char* const[])>("execv");
  return next(file, words);
}

int execvp(const char* file, char* const words[]) noexcept {
  if (refuse("execvp")) return errno = EPERM, -1;
  static const auto next = behind<int (*)(const char*, char* const[])>("execvp");
  return next(file, words);
}
}
