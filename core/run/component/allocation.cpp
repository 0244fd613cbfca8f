// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/allocation.hpp"

#include "core/sanitized.hpp"

constinit thread_local fulmar::core::HeapUse fulmar::core::heap_use;

#ifndef FULMAR_SANITIZED
bool fulmar::core::counts_allocations() noexcept { return true; }
static void note_heap(std::uint64_t calls, std::int64_t bytes) {
  fulmar::core::heap_use.calls += calls;
  fulmar::core::heap_use.bytes += bytes;
}
#include "core/heap_hooks.hpp"
#else
bool fulmar::core::counts_allocations() noexcept { return false; }
#endif
