// SPDX-License-Identifier: BSD-3-Clause
// Counts what a thread takes from the heap, so that the host can tell which component allocates in flight.
#pragma once
#include <cstdint>

namespace fulmar::core {

/// Calls of malloc and its relatives in this thread since it began. 0 for ever in a sanitized build, where the counter is left out.
std::uint64_t thread_allocations() noexcept;

/// Whether this build counts.
bool counts_allocations() noexcept;

}  // namespace fulmar::core
