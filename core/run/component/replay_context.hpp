// SPDX-License-Identifier: BSD-3-Clause
// Inputs of a replayed flight that it cannot compute: the data of its devices, and effects of the wall clock.
// Commands and signals enter it like any other flight.
#pragma once
#include <cstdint>
#include <string>

#include "core/graph/graph.hpp"
#include "core/log/events.hpp"
#include "core/run/component/unit.hpp"

namespace fulmar::core {

class Circumstances {
 public:
  virtual ~Circumstances() = default;
  /// [setup] Replaces a vehicle or a driver by recorded samples, lists the late results, and disables all
  /// wall-clock limits.
  virtual void stand_in(const Graph& graph, const Component& component, UnitOptions& options) = 0;
  /// [tick] Whether the component exceeded its wall-clock budget in this tick.
  virtual bool ran_over(const std::string& component, std::int64_t now_ns) const = 0;
  /// The event with its verdict: name and cause count, the words do not. nullptr: the log ends before it.
  virtual const Event* conclusion() const = 0;
};

}  // namespace fulmar::core
