// SPDX-License-Identifier: BSD-3-Clause
// Sanitizer of this build; gcc and clang define different macros. A sanitizer has its own allocator and
// signal handlers.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FULMAR_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FULMAR_SANITIZED
#endif
#endif

namespace fulmar::core {

/// Factor on the CPU time limit of a test when a sanitizer checks every access.
#ifdef FULMAR_SANITIZED
inline constexpr double sanitizer_slowdown = 10;
#else
inline constexpr double sanitizer_slowdown = 1;
#endif

}  // namespace fulmar::core
