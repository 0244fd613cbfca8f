// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/msg/plan.hpp"

namespace fulmar {

enum class PlanEditKind : std::uint8_t { append, insert, replace, remove, clear, set_current };

/// One change of the plan. `index` counts from 0; append and clear ignore it. `set_current`: fly to waypoint
/// `index` at once.
struct PlanEdit {
  PlanEditKind kind = PlanEditKind::append;
  std::uint32_t index = 0;
  Waypoint waypoint;
};

}  // namespace fulmar
