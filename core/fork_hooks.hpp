// SPDX-License-Identifier: BSD-3-Clause
// Stands in front of the C library's functions that fork, for plugins and whatever they link: for the one
// file of a program that says which of them are refused. That file defines `refuse_fork(call)` before it
// includes this.
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

/// A caller of vfork may not tell it from fork (POSIX), and a function that returns twice cannot stand in
/// front of it.
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
