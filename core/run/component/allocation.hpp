// SPDX-License-Identifier: BSD-3-Clause
// Counts what a thread takes from the heap, so that the host can tell which component allocates in flight,
// and which keeps what it takes.
#pragma once
#include <cstdint>

namespace fulmar::core {

struct HeapUse {
  std::uint64_t calls = 0;  // of malloc and its relatives in this thread since it began
  std::int64_t bytes = 0;   // taken less given back by this thread
};

/// Of the calling thread. All zero for ever in a sanitized build, where the counter is left out.
extern constinit thread_local HeapUse heap_use;
inline HeapUse thread_heap() noexcept { return heap_use; }
inline std::uint64_t thread_allocations() noexcept { return thread_heap().calls; }

/// Whether this build counts.
bool counts_allocations() noexcept;

}  // namespace fulmar::core
