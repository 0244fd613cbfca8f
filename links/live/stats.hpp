// SPDX-License-Identifier: BSD-3-Clause
// The figures of the live view.
#pragma once
#include <cstdint>

namespace fulmar::core {

struct LiveStats {
  std::uint64_t clients = 0;  // now
  std::uint64_t sent = 0;     // messages
  std::uint64_t dropped = 0;  // messages that a slow client did not get
  std::uint64_t lost = 0;     // samples that this sink was too slow for
  std::uint64_t refused = 0;  // connections and messages that were against the rules
  std::uint64_t wrong_tokens = 0;
};

}  // namespace fulmar::core
