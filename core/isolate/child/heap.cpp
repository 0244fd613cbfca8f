// SPDX-License-Identifier: BSD-3-Clause
// Stands in front of glibc's allocator, as in the host, and weighs as well. Under a sanitizer its own
// counters serve.
#include "core/isolate/child/heap.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>

#include "core/sanitized.hpp"

namespace {
thread_local std::uint64_t calls = 0;
}

#ifdef FULMAR_SANITIZED

extern "C" {  // of sanitizer/allocator_interface.h, which not every gcc brings
std::size_t __sanitizer_get_current_allocated_bytes();  // NOLINT
int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t),
                                              void (*)(const volatile void*));  // NOLINT
}

namespace fulmar::core {
void count_heap() noexcept {
  __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { ++calls; },
                                            [](const volatile void*) {});
}
std::uint64_t heap_calls() noexcept { return calls; }
std::int64_t heap_bytes() noexcept {
  return static_cast<std::int64_t>(__sanitizer_get_current_allocated_bytes());
}
}  // namespace fulmar::core

#elif defined(__GLIBC__)

#include <malloc.h>

namespace {

std::atomic<std::int64_t> bytes{0};

std::int64_t weight(void* p) { return static_cast<std::int64_t>(malloc_usable_size(p)); }

void* taken(void* p) {
  ++calls;
  if (p) bytes.fetch_add(weight(p), std::memory_order_relaxed);
  return p;
}

}  // namespace

namespace fulmar::core {
void count_heap() noexcept {}
std::uint64_t heap_calls() noexcept { return calls; }
std::int64_t heap_bytes() noexcept { return bytes.load(std::memory_order_relaxed); }
}  // namespace fulmar::core

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return taken(__libc_calloc(count, size)); }
void* realloc(void* p, std::size_t size) {
  const std::int64_t before = p ? weight(p) : 0;
  void* q = __libc_realloc(p, size);
  if (q || size == 0) bytes.fetch_sub(before, std::memory_order_relaxed);
  return taken(q);
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
  if (p) bytes.fetch_sub(weight(p), std::memory_order_relaxed);
  __libc_free(p);
}
}

#else

namespace fulmar::core {
void count_heap() noexcept {}
std::uint64_t heap_calls() noexcept { return 0; }
std::int64_t heap_bytes() noexcept { return 0; }
}  // namespace fulmar::core

#endif
