// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/msg/plan.hpp"

namespace fulmar {

enum class PlanEditKind : std::uint8_t { append, insert, replace, remove, clear, set_current };

/// Setting of the plan as a whole.
enum class PlanSetting : std::uint8_t { none, end, turn_radius, airspeed };

inline constexpr std::uint32_t no_waypoint = 0xffffffff;  ///< an index that no plan has

/// One change of the plan. `index` counts from 0; append and clear ignore it. `set_current`: fly to waypoint
/// `index` at once. A waypoint inserted before the active one is flown in the next circuit, unless a
/// `set_current` follows. A waypoint is identified by its index or, if `waypoint_id` is not 0, by its id;
/// then `index` is ignored.
struct PlanEdit {
  PlanEditKind kind = PlanEditKind::append;  ///< kind of the edit
  std::uint32_t index = 0;                   ///< index of the waypoint
  Waypoint waypoint;                         ///< waypoint to append, insert or replace
  std::uint32_t id = 0;                      ///< number of the sender, repeated in the result
  std::uint32_t waypoint_id = 0;             ///< id of the waypoint; insert: before this one; replace,
                                             ///< remove, set_current: this one
  std::uint32_t group = 0;                   ///< number of a group of edits that take effect together or not
                                             ///< at all; 0: alone
  std::uint32_t group_size = 0;              ///< number of edits in the group, which takes effect with the
                                             ///< last of them
  PlanSetting setting = PlanSetting::none;   ///< setting to change; other than none: `kind` is ignored
  PlanEnd end = PlanEnd::circuit;            ///< new value of the setting `end`
  double turn_radius_m = 0;                  ///< new value of the setting `turn_radius`
  double airspeed_mps = 0;                   ///< new value of the setting `airspeed`
};

template <>
inline constexpr std::string_view appended_from<PlanEdit> = "id";

/// An edit of the plan as a whole, without its value. A planner that knows only waypoint edits rejects it:
/// its index does not exist.
inline PlanEdit edit_of(PlanSetting setting) {
  PlanEdit edit;
  edit.kind = PlanEditKind::remove;
  edit.index = no_waypoint;
  edit.setting = setting;
  return edit;
}

/// Result of an edit. An edit of a group is accepted before it is in force. The result of the last edit
/// states whether all are in force; if one is rejected, none is.
struct PlanEditResult {
  std::uint32_t id = 0;           ///< id of the edit
  std::uint32_t group = 0;        ///< group of the edit
  bool accepted = false;          ///< true if the edit is accepted
  bool in_force = false;          ///< true if the edit, and the group that it ends, is in force
  bool by_request = false;        ///< source of the edit: true for the request `edit`, false for the queue
                                  ///< `edits`
  std::uint32_t waypoint_id = 0;  ///< id of the waypoint that was added or named; 0: none
  std::uint32_t revision = 0;     ///< revision of the first plan with the edit, if in force
  Text<80> reason;                ///< reason of a rejection
};

}  // namespace fulmar
