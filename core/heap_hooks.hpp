// SPDX-License-Identifier: BSD-3-Clause
// Replaces glibc's allocation functions by wrappers that count, then call the originals. Exactly one file of
// a program includes this header. That file defines `note_heap(calls, bytes)` before the include.
#pragma once
#include <malloc.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)
}

namespace {
std::int64_t weight(void* p) { return static_cast<std::int64_t>(malloc_usable_size(p)); }
void* taken(void* p) {
  note_heap(1, weight(p));
  return p;
}
}  // namespace

extern "C" {
void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return taken(__libc_calloc(count, size)); }
void* realloc(void* p, std::size_t size) {
  const std::int64_t before = weight(p);
  void* const moved = __libc_realloc(p, size);
  if (moved || size == 0) note_heap(0, -before);
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
  note_heap(0, -weight(p));
  __libc_free(p);
}
}
