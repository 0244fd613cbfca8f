// SPDX-License-Identifier: BSD-3-Clause
// Under a sanitizer, the sanitizer's counters are used.
#include "core/isolate/child/heap.hpp"

#include <atomic>
#include <cstddef>

#include "core/sanitized.hpp"

static thread_local std::uint64_t calls = 0;
std::uint64_t fulmar::core::heap_calls() noexcept { return calls; }

#ifdef FULMAR_SANITIZED

extern "C" {  // from sanitizer/allocator_interface.h, which some releases of gcc lack
std::size_t __sanitizer_get_current_allocated_bytes();  // NOLINT
int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t),
                                              void (*)(const volatile void*));  // NOLINT
}

void fulmar::core::count_heap() noexcept {
  __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { ++calls; },
                                            [](const volatile void*) {});
}
std::int64_t fulmar::core::heap_bytes() noexcept {
  return static_cast<std::int64_t>(__sanitizer_get_current_allocated_bytes());
}

#else

static std::atomic<std::int64_t> bytes{0};
void fulmar::core::count_heap() noexcept {}
std::int64_t fulmar::core::heap_bytes() noexcept { return bytes.load(std::memory_order_relaxed); }

static void note_heap(std::uint64_t more_calls, std::int64_t more_bytes) {
  calls += more_calls;
  bytes.fetch_add(more_bytes, std::memory_order_relaxed);
}
#include "core/heap_hooks.hpp"

#endif
