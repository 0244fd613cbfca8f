// SPDX-License-Identifier: BSD-3-Clause
// Runs a test of input from outside in a child process that has a gigabyte and five seconds.
#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>

#include "core/sanitized.hpp"

namespace fulmar::core::test {

/// Number of altered inputs of each kind.
#ifdef FULMAR_SANITIZED  // a sanitized build is ten times as slow
constexpr int mutants = 50, few_mutants = 10;
#else
constexpr int mutants = 500, few_mutants = 50;
#endif
/// Number of inputs where 500 take more than ten seconds of CPU time: fewer, without FULMAR_LONG.
inline int costly_mutants() { return std::getenv("FULMAR_LONG") != nullptr ? 500 : few_mutants; }

/// Whether `work` returns within the limits, without a crash and without an exception.
template <class Work>
bool within_limits(const Work& work) {
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
#ifndef FULMAR_SANITIZED  // a sanitizer reserves terabytes, and is slow
    constexpr rlim_t gigabyte = 1u << 30, seconds = 5;
    const rlimit memory{gigabyte, gigabyte}, cpu{seconds, seconds};
    ::setrlimit(RLIMIT_AS, &memory);
    ::setrlimit(RLIMIT_CPU, &cpu);
#endif
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    try {
      work();
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace fulmar::core::test
