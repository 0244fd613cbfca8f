// SPDX-License-Identifier: BSD-3-Clause
// Replaces the fork functions of the C library for plugins and their libraries. Exactly one file of a program
// includes this header. That file defines `refuse_fork(call)` before the include.
#pragma once
#include <dlfcn.h>
#include <pty.h>
#include <unistd.h>

#include <cerrno>

extern "C" {

pid_t fork() noexcept {
  if (refuse_fork("fork")) {
    errno = EPERM;
    return -1;
  }
  static const auto next = reinterpret_cast<pid_t (*)()>(dlsym(RTLD_NEXT, "fork"));
  return next();
}

/// POSIX allows vfork to behave as fork. A wrapper of the real vfork would return twice.
pid_t vfork() noexcept {
  if (refuse_fork("vfork")) {
    errno = EPERM;
    return -1;
  }
  return fork();
}

#if __GLIBC_PREREQ(2, 34)
pid_t _Fork() noexcept {  // NOLINT(bugprone-reserved-identifier): POSIX's name
  if (refuse_fork("_Fork")) {
    errno = EPERM;
    return -1;
  }
  static const auto next = reinterpret_cast<pid_t (*)()>(dlsym(RTLD_NEXT, "_Fork"));
  return next();
}
#endif

int forkpty(int* master, char* name, const termios* settings, const winsize* window) noexcept {
  if (refuse_fork("forkpty")) {
    errno = EPERM;
    return -1;
  }
  static const auto next = reinterpret_cast<decltype(&forkpty)>(dlsym(RTLD_NEXT, "forkpty"));
  return next(master, name, settings, window);
}

int daemon(int stay, int keep) noexcept {
  if (refuse_fork("daemon")) {
    errno = EPERM;
    return -1;
  }
  static const auto next = reinterpret_cast<decltype(&daemon)>(dlsym(RTLD_NEXT, "daemon"));
  return next(stay, keep);
}
}
