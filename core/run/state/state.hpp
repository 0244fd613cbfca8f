// SPDX-License-Identifier: BSD-3-Clause
// State that all parts of a flight share: its mission, its options, the time, and the result so far.
#pragma once
#include <cstdint>
#include <limits>

#include "core/graph/graph.hpp"
#include "core/run/state/flight_types.hpp"

namespace fulmar::core {

/// A time that is not set.
constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::min();

struct FlightState {
  Graph graph;  // a copy, because a swap changes it
  FlightOptions options;
  std::int64_t now_ns = 0;
  std::uint64_t index = 0;  // of the tick
  FlightResult result;
  std::optional<Restart> restart{};  // another flight is requested in its place

  bool on_hardware() const noexcept { return graph.io == Io::fcu; }
  /// No wait for the wall clock, and no limit by it.
  bool unpaced() const noexcept { return options.circumstances || (options.speed == 0 && !on_hardware()); }
};

}  // namespace fulmar::core
