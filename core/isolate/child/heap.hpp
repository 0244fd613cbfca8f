// SPDX-License-Identifier: BSD-3-Clause
// What the child's heap is asked for: the host learns which component allocates in flight, and which leaks.
#pragma once
#include <cstdint>

namespace fulmar::core {

/// [setup] Begins to count where that takes a beginning.
void count_heap() noexcept;

/// Calls of malloc and its relatives in this thread so far.
std::uint64_t heap_calls() noexcept;

/// Bytes that all threads hold now.
std::int64_t heap_bytes() noexcept;

}  // namespace fulmar::core
