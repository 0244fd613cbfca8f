// SPDX-License-Identifier: BSD-3-Clause
// Counts the child's heap use: the host reports components that allocate in flight, and those that leak.
#pragma once
#include <cstdint>

namespace fulmar::core {

/// [setup] Starts to count, where the platform needs a start.
void count_heap() noexcept;

/// Calls of malloc and its relatives in this thread so far.
std::uint64_t heap_calls() noexcept;

/// Bytes that all threads hold now.
std::int64_t heap_bytes() noexcept;

}  // namespace fulmar::core
