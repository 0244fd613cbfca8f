// SPDX-License-Identifier: BSD-3-Clause
// The host counts allocations by standing in front of malloc, which is the business of a program, not of a module inside one.
#include "core/run/allocation.hpp"

namespace fulmar::core {
HeapUse thread_heap() noexcept { return {}; }
bool counts_allocations() noexcept { return false; }
}  // namespace fulmar::core
