// SPDX-License-Identifier: BSD-3-Clause
// The figures of the live view.
#pragma once
#include <cstdint>

namespace fulmar::core {

struct LiveStats {
  std::uint64_t clients = 0;  // connected now
  std::uint64_t sent = 0;     // messages
  std::uint64_t dropped = 0;  // messages that were dropped for a slow client
  std::uint64_t lost = 0;     // samples that this sink lost because it was too slow
  std::uint64_t refused = 0;  // rejected connections, and messages that violate the rules
  std::uint64_t wrong_tokens = 0;
};

}  // namespace fulmar::core
