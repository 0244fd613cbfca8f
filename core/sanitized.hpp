// SPDX-License-Identifier: BSD-3-Clause
// Which sanitizer this is built with; gcc and clang say it in ways of their own. A sanitizer has an allocator
// and signal handlers of its own.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FULMAR_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FULMAR_SANITIZED
#endif
#endif

namespace fulmar::core {

/// How much more time of the CPU a test is given where every access is looked at.
#ifdef FULMAR_SANITIZED
inline constexpr double sanitizer_slowdown = 10;
#else
inline constexpr double sanitizer_slowdown = 1;
#endif

}  // namespace fulmar::core
