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
