// SPDX-License-Identifier: BSD-3-Clause
// Counts a thread's heap use, so that the host can report components that allocate in flight, and those that
// leak.
#pragma once
#include <cstdint>

namespace fulmar::core {

struct HeapUse {
  std::uint64_t calls = 0;  // of malloc and its relatives in this thread
  std::int64_t bytes = 0;   // allocated minus freed by this thread
};

/// Of the calling thread. Always zero in a sanitized build, which has no counter.
extern constinit thread_local HeapUse heap_use;
inline HeapUse thread_heap() noexcept { return heap_use; }
inline std::uint64_t thread_allocations() noexcept { return thread_heap().calls; }

/// Whether this build counts.
bool counts_allocations() noexcept;

}  // namespace fulmar::core
