// SPDX-License-Identifier: BSD-3-Clause
// What a flight cannot find out by itself when it is one that has been flown before: what its devices said,
// and what the clock on the wall did. Commands and signals enter such a flight through the same doors as any
// other.
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
  /// [setup] Puts what was recorded in the place of a vehicle or a driver, tells which results were late, and
  /// frees everybody from the wall clock.
  virtual void stand_in(const Graph& graph, const Component& component, UnitOptions& options) = 0;
  /// [tick] Whether the wall clock stopped the component in this tick.
  virtual bool ran_over(const std::string& component, std::int64_t now_ns) const = 0;
  /// The event with its verdict: name and cause count, the words do not. nullptr: the log ends before.
  virtual const Event* conclusion() const = 0;
};

}  // namespace fulmar::core
