// SPDX-License-Identifier: BSD-3-Clause
// The message of an exception, also of one without a message or whose `what` throws. A part of glue.hpp.
#pragma once
#include <cxxabi.h>

#include <atomic>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <typeinfo>

#include "fulmar/abi.h"

namespace fulmar::detail {

inline void report(fulmar_error* error, const char* text) noexcept {
  if (!error) return;
  const std::size_t n = strnlen(text, sizeof error->text - 1);
  std::memcpy(error->text, text, n);
  error->text[n] = '\0';
}

/// Jump target of std::terminate in this thread; nullptr: std::terminate ends the program.
inline thread_local std::jmp_buf* way_back = nullptr;
inline std::terminate_handler usual_terminate = nullptr;
inline std::atomic_flag handler_in_use = ATOMIC_FLAG_INIT;

[[noreturn]] inline void come_back() {
  if (way_back) std::longjmp(*way_back, 1);
  if (usual_terminate) usual_terminate();
  std::abort();
}

/// `what` is noexcept: one that throws calls std::terminate, which can only be left by a jump. Returns
/// nullptr without a message.
inline const char* words_of(const std::exception& e) noexcept {
  while (handler_in_use.test_and_set(std::memory_order_acquire)) continue;
  std::jmp_buf here;
  const char* volatile words = nullptr;
  way_back = &here;
  usual_terminate = std::set_terminate(come_back);
  if (setjmp(here) == 0)
    words = e.what();
  else
    abi::__cxa_end_catch();  // of the exception thrown by `what`
  std::set_terminate(usual_terminate);
  way_back = nullptr;
  handler_in_use.clear(std::memory_order_release);
  return words;
}

inline void report_type(fulmar_error* error, [[maybe_unused]] const std::exception& e) noexcept {
#ifdef __cpp_rtti
  const char* const name = typeid(e).name();
  int failed = 0;
  const std::unique_ptr<char, void (*)(void*)> plain(abi::__cxa_demangle(name, nullptr, nullptr, &failed),
                                                     &std::free);
  if (error)
    std::snprintf(error->text, sizeof error->text, "threw a %s without words", plain ? plain.get() : name);
#else
  report(error, "threw an exception without words");
#endif
}

inline void report_exception(fulmar_error* error, const std::exception& e) noexcept {
  const char* const words = words_of(e);
  if (words && *words)
    report(error, words);
  else
    report_type(error, e);
}

}  // namespace fulmar::detail
