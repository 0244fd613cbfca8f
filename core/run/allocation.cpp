// SPDX-License-Identifier: BSD-3-Clause
// Stands in front of glibc's allocator. Only calls that take memory are counted; glibc's own functions do the work.
#include "core/run/allocation.hpp"

#include <cerrno>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FULMAR_SANITIZED
#endif
#endif
#ifndef FULMAR_SANITIZED
#define FULMAR_COUNTS
#endif
#endif

namespace {
thread_local std::uint64_t taken = 0;
}

namespace fulmar::core {
std::uint64_t thread_allocations() noexcept { return taken; }
#ifdef FULMAR_COUNTS
bool counts_allocations() noexcept { return true; }
#else
bool counts_allocations() noexcept { return false; }
#endif
}  // namespace fulmar::core

#ifdef FULMAR_COUNTS
extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
  ++taken;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++taken;
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) {
  ++taken;
  return __libc_realloc(p, size);
}
void* memalign(std::size_t align, std::size_t size) {
  ++taken;
  return __libc_memalign(align, size);
}
void* aligned_alloc(std::size_t align, std::size_t size) {
  ++taken;
  return __libc_memalign(align, size);
}
int posix_memalign(void** out, std::size_t align, std::size_t size) {
  ++taken;
  void* p = __libc_memalign(align, size);
  if (!p) return ENOMEM;
  *out = p;
  return 0;
}
}
#endif
