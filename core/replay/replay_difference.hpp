// SPDX-License-Identifier: BSD-3-Clause
// Where a replay differs from its log.
#pragma once
#include "core/replay/replay.hpp"

namespace fulmar::core {

struct TickList;

/// Fills in what differs between two logs up to the flight time `last_ns`: messages, bytes, the first tick, the first field.
void find_differences(const McapFile& was, const TickList& was_ticks, const McapFile& is, const TickList& is_ticks, std::int64_t epoch_ns,
                      ReplayResult& result);

}  // namespace fulmar::core
