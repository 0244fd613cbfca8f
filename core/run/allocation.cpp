// SPDX-License-Identifier: BSD-3-Clause
// Stands in front of glibc's allocator; glibc's own functions do the work.
#include "core/run/allocation.hpp"

#include <malloc.h>

#include <cerrno>
#include <cstddef>

#include "core/sanitized.hpp"

#if defined(__GLIBC__) && !defined(FULMAR_SANITIZED)
#define FULMAR_COUNTS
#endif

namespace fulmar::core {
constinit thread_local HeapUse heap_use;
#ifdef FULMAR_COUNTS
bool counts_allocations() noexcept { return true; }
#else
bool counts_allocations() noexcept { return false; }
#endif
}  // namespace fulmar::core

#ifdef FULMAR_COUNTS
using fulmar::core::heap_use;

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)
}

namespace {
void* taken(void* p) {
  ++heap_use.calls;
  heap_use.bytes += static_cast<std::int64_t>(malloc_usable_size(p));
  return p;
}
}  // namespace

extern "C" {
void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return taken(__libc_calloc(count, size)); }
void* realloc(void* p, std::size_t size) {
  const auto before = static_cast<std::int64_t>(malloc_usable_size(p));
  void* const moved = __libc_realloc(p, size);
  if (moved || size == 0) heap_use.bytes -= before;
  return taken(moved);
}
void* memalign(std::size_t align, std::size_t size) { return taken(__libc_memalign(align, size)); }
void* aligned_alloc(std::size_t align, std::size_t size) { return taken(__libc_memalign(align, size)); }
int posix_memalign(void** out, std::size_t align, std::size_t size) {
  void* p = taken(__libc_memalign(align, size));
  if (!p) return ENOMEM;
  *out = p;
  return 0;
}
void free(void* p) {
  heap_use.bytes -= static_cast<std::int64_t>(malloc_usable_size(p));
  __libc_free(p);
}
}
#endif
