// SPDX-License-Identifier: BSD-3-Clause
// For one file of a program in which plugins may crash: with a sanitizer, too, a crash then ends the process
// by its signal, which the host reports.
#pragma once

#include "core/sanitized.hpp"

#ifdef FULMAR_SANITIZED
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_abort=0:handle_sigfpe=0:handle_sigill=0:detect_leaks=0:"
         "use_sigaltstack=0";
}
extern "C" const char* __tsan_default_options();
extern "C" const char* __tsan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_abort=0:handle_sigfpe=0:handle_sigill=0:use_sigaltstack=0";
}
#endif
