// SPDX-License-Identifier: BSD-3-Clause
// What all parts of a flight look at: its mission, what its owner wants, the time, and what came of it so
// far.
#pragma once
#include <cstdint>
#include <limits>

#include "core/graph/graph.hpp"
#include "core/run/state/flight_types.hpp"

namespace fulmar::core {

/// Of a time that has not come.
constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::min();

struct FlightState {
  Graph graph;  // its own: a swap changes it
  FlightOptions options;
  std::int64_t now_ns = 0;
  std::uint64_t index = 0;  // of the tick
  FlightResult result;
  std::optional<Restart> restart{};  // another flight is wanted in this one's place

  bool on_hardware() const noexcept { return graph.io == Io::fcu; }
  /// Nobody waits for the clock on the wall, and nothing is judged by it.
  bool unpaced() const noexcept { return options.circumstances || (options.speed == 0 && !on_hardware()); }
};

}  // namespace fulmar::core
