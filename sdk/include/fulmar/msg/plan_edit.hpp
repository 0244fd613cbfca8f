// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/msg/plan.hpp"

namespace fulmar {

enum class PlanEditKind : std::uint8_t { append, insert, replace, remove, clear, set_current };

/// Of the plan as a whole.
enum class PlanSetting : std::uint8_t { none, end, turn_radius, airspeed };

inline constexpr std::uint32_t no_waypoint = 0xffffffff;  ///< an index that no plan has

/// One change of the plan. `index` counts from 0; append and clear ignore it. `set_current`: fly to waypoint
/// `index` at once; what is inserted before the waypoint that is flown to is flown in the next circuit unless
/// that follows. A waypoint is named by its index, or, where `waypoint_id` is not 0, by its id: then
/// `index` is not looked at.
struct PlanEdit {
  PlanEditKind kind = PlanEditKind::append;
  std::uint32_t index = 0;
  Waypoint waypoint;
  std::uint32_t id = 0;           ///< the asker's own number, which the result repeats
  std::uint32_t waypoint_id = 0;  ///< insert: before this one; replace, remove, set_current: this one
  std::uint32_t group = 0;        ///< edits of one number take effect together or not at all; 0: alone
  std::uint32_t group_size = 0;   ///< how many edits the group has: it takes effect with the last of them
  PlanSetting setting = PlanSetting::none;  ///< another: the edit sets this, and `kind` is not looked at
  PlanEnd end = PlanEnd::circuit;
  double turn_radius_m = 0;
  double airspeed_mps = 0;
};

template <>
inline constexpr std::string_view appended_from<PlanEdit> = "id";

/// An edit of the plan as a whole; its value is still to be set. To a planner that knows waypoints alone it
/// names one that does not exist, and is refused.
inline PlanEdit edit_of(PlanSetting setting) {
  PlanEdit edit;
  edit.kind = PlanEditKind::remove;
  edit.index = no_waypoint;
  edit.setting = setting;
  return edit;
}

/// What became of an edit. One of a group is accepted before it is in force: all of them are when the last
/// one's result says so, and none ever when one is refused.
struct PlanEditResult {
  std::uint32_t id = 0;     ///< of the edit
  std::uint32_t group = 0;  ///< of the edit
  bool accepted = false;
  bool in_force = false;          ///< it, and the group that it ends
  bool by_request = false;        ///< it came by the request `edit`, not by the queue `edits`
  std::uint32_t waypoint_id = 0;  ///< of the waypoint that was added or named; 0: none
  std::uint32_t revision = 0;     ///< in force: of the first plan that has it
  Text<80> reason;                ///< refused: why
};

}  // namespace fulmar
