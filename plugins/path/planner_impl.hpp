// SPDX-License-Identifier: BSD-3-Clause
// Edits of the plan: one by one, or in groups that are made in a copy of the plan and replace it together.
#pragma once
#include <algorithm>

#include "fulmar/fitted.hpp"
#include "planner.hpp"

namespace fulmar::path {

/// Empty on success, else the reason; the plan is then unchanged.
inline Planner::Reason Planner::take(const Tick& tick, const PlanEdit& edit, bool by_request, Outputs& out) {
  PlanEditResult result;
  result.id = edit.id;
  result.group = edit.group;
  result.by_request = by_request;
  Reason reason;
  if (edit.group == 0) {
    reason = apply(plan_, edit, true, result.waypoint_id);
    result.in_force = !reason;
  } else {
    if (edit.group != group_.number || by_request != group_.by_request)
      begin_group(tick, edit, by_request, out);
    reason = take_into_group(edit, result);
  }
  if (result.in_force) {
    changed_ = true;
    ++changes_;
    result.revision = plan_.revision + 1;
  }
  result.accepted = !reason;
  if (reason) result.reason = *reason;
  report(tick, result, out);
  return reason;
}

inline void Planner::begin_group(const Tick& tick, const PlanEdit& edit, bool by_request, Outputs& out) {
  drop_group(tick, path_messages::group_incomplete.c_str(), out);
  group_.number = edit.group;
  group_.size = edit.group_size;
  group_.taken = 0;
  group_.changes = changes_;
  group_.refused = false;
  group_.by_request = by_request;
  group_.plan = plan_;
}

/// An open group that can no longer take effect: reported once, for its last edit.
inline void Planner::drop_group(const Tick& tick, const char* reason, Outputs& out) {
  if (group_.number == 0 || group_.refused) return;
  group_.refused = true;
  PlanEditResult result;
  result.id = group_.last_id;
  result.group = group_.number;
  result.by_request = group_.by_request;
  result.reason = reason;
  report(tick, result, out);
}

inline Planner::Reason Planner::take_into_group(const PlanEdit& edit, PlanEditResult& result) {
  Reason reason;
  group_.last_id = edit.id;
  ++group_.taken;
  if (group_.refused) {
    reason = path_messages::group_refused.c_str();
  } else if (edit.group_size == 0) {
    reason = path_messages::group_size_missing.c_str();
  } else if (edit.group_size != group_.size) {
    reason = path_messages::group_sizes_differ.c_str();
  } else {
    reason = apply(group_.plan, edit, false, result.waypoint_id);
  }
  const bool last = group_.taken >= group_.size;
  if (!reason && last) reason = commit();
  result.in_force = !reason && last;
  group_.refused = reason.has_value();
  if (last) group_.number = 0;
  return reason;
}

inline Planner::Reason Planner::commit() {
  if (group_.changes != changes_) return path_messages::group_outdated.c_str();
  if (const Reason fault = fault_of_spacing(group_.plan)) return fault;
  const std::uint32_t revision = plan_.revision;
  plan_ = group_.plan;
  plan_.revision = revision;
  return {};
}

inline Text<96> Planner::words_of(const PlanEditResult& result) const {
  const std::string_view reason = result.reason.view();
  if (unreported_ == 0)
    return result.id == 0 ? fitted<96>(path_messages::edit_without_id_refused, reason)
                          : fitted<96>(path_messages::edit_refused, result.id, reason);
  return result.id == 0 ? fitted<96>(path_messages::edit_without_id_refused_again, reason, unreported_)
                        : fitted<96>(path_messages::edit_refused_again, result.id, reason, unreported_);
}

/// Reports to the sender and, for a rejection, as a notice. Each reason is reported; a repeated one once a
/// second, with the number of repetitions.
inline void Planner::report(const Tick& tick, const PlanEditResult& result, Outputs& out) {
  out.results.push(result, tick.now_ns);
  if (result.accepted) return;
  ++refused_;
  if (result.reason == reported_reason_ && tick.now_ns - reported_ns_ < 1'000'000'000) {
    ++unreported_;
    return;
  }
  Notice notice;
  notice.severity = Severity::warning;
  notice.text = words_of(result);
  out.notices.push(notice, tick.now_ns);
  reported_reason_ = result.reason;
  reported_ns_ = tick.now_ns;
  unreported_ = 0;
}

/// Empty on success, else the reason; the plan is then unchanged. `alone`: the resulting plan takes effect at
/// once, else its group is checked as a whole.
inline Planner::Reason Planner::apply(Plan& plan, PlanEdit edit, bool alone, std::uint32_t& waypoint_id) {
  if (edit.setting != PlanSetting::none) return set(plan, edit);
  auto& list = plan.waypoints;
  const std::uint32_t n = list.count;
  const bool adds = edit.kind == PlanEditKind::append || edit.kind == PlanEditKind::insert;
  const bool at_existing = edit.kind == PlanEditKind::replace || edit.kind == PlanEditKind::remove ||
                           edit.kind == PlanEditKind::set_current;
  if (edit.kind > PlanEditKind::set_current) return path_messages::edit_kind_unknown.c_str();
  if (edit.waypoint_id != 0 && (at_existing || edit.kind == PlanEditKind::insert)) {
    for (edit.index = 0; edit.index < n && list[edit.index].id != edit.waypoint_id;) ++edit.index;
    if (edit.index == n) return path_messages::waypoint_id_unknown.to<Text<80>>(edit.waypoint_id);
  }
  const std::uint32_t i = edit.index;
  if (adds && list.full()) return path_messages::plan_full.c_str();
  if (at_existing && n == 0) return path_messages::plan_without_waypoints.c_str();
  if (at_existing && i >= n) return path_messages::waypoint_index_unknown.to<Text<80>>(i, n - 1);
  if (edit.kind == PlanEditKind::insert && i > n) return path_messages::index_beyond_end.to<Text<80>>(i, n);

  Waypoint w = edit.waypoint;
  if (edit.kind == PlanEditKind::append) edit.index = n;
  if (adds || edit.kind == PlanEditKind::replace) {
    if (w.frame == WaypointFrame::geodetic) w.position_m = {};
    resolve(w);
    if (const Reason fault = fault_of(w)) return fault;
    const std::uint32_t at = edit.index, next = adds ? at : at + 1;
    const Reason fault =
        fault_of_neighbours(w, at > 0 ? &list[at - 1] : nullptr, next < n ? &list[next] : nullptr);
    if (alone && fault) return fault;
  }
  w.id = adds ? next_id_++ : at_existing ? list[i].id : 0;
  waypoint_id = w.id;
  put(plan, edit, w);
  return {};
}

/// Changes settings of the plan as a whole.
inline Planner::Reason Planner::set(Plan& plan, const PlanEdit& edit) const {
  switch (edit.setting) {
    case PlanSetting::end:
      if (edit.end > PlanEnd::orbit) return path_messages::end_unknown.c_str();
      plan.end = edit.end;
      return {};
    case PlanSetting::turn_radius:
      if (!detail::radius_in_range(edit.turn_radius_m))
        return path_messages::turn_radius_out_of_range.to<Text<80>>(edit.turn_radius_m);
      plan.turn_radius_m = edit.turn_radius_m;
      return {};
    case PlanSetting::airspeed:
      if (!detail::airspeed_in_range(edit.airspeed_mps))
        return path_messages::airspeed_out_of_range.to<Text<80>>(edit.airspeed_mps);
      plan.airspeed_mps = edit.airspeed_mps;
      return {};
    default: return path_messages::setting_unknown.c_str();
  }
}

/// Applies a valid edit at its index.
inline void Planner::put(Plan& plan, const PlanEdit& edit, const Waypoint& w) const {
  auto& list = plan.waypoints;
  const std::uint32_t at = edit.index, n = list.count;
  switch (edit.kind) {
    case PlanEditKind::append:
    case PlanEditKind::insert:
      for (std::uint32_t k = n; k > at; --k) list[k] = list[k - 1];
      list[at] = w;
      ++list.count;
      if (at <= plan.jump_item && at < n) ++plan.jump_item;
      break;
    case PlanEditKind::replace: list[at] = w; break;
    case PlanEditKind::remove:
      for (std::uint32_t k = at; k + 1 < n; ++k) list[k] = list[k + 1];
      --list.count;
      if (at < plan.jump_item) --plan.jump_item;
      break;
    case PlanEditKind::clear:
      list.clear();
      ++plan.jumps;
      plan.jump_item = 0;
      break;
    case PlanEditKind::set_current:
      ++plan.jumps;
      plan.jump_item = at;
      break;
  }
}

inline Planner::Reason Planner::fault_of(const Waypoint& w) const {
  if (w.frame > WaypointFrame::geodetic) return path_messages::waypoint_frame_unknown.c_str();
  const bool geodetic = w.frame == WaypointFrame::geodetic;
  if (geodetic) {
    if (!std::isfinite(w.latitude_deg) || !std::isfinite(w.longitude_deg) || !std::isfinite(w.altitude_m))
      return path_messages::coordinate_not_finite.c_str();
    if (std::abs(w.latitude_deg) > 90)
      return path_messages::latitude_out_of_range.to<Text<80>>(w.latitude_deg);
    if (std::abs(w.longitude_deg) > 360)
      return path_messages::longitude_out_of_range.to<Text<80>>(w.longitude_deg);
  }
  const Vec3<Ned>& p = w.position_m;
  if (!std::isfinite(p.north) || !std::isfinite(p.east) || !std::isfinite(p.down))
    return path_messages::coordinate_not_finite.c_str();
  if (std::hypot(p.north, p.east) > farthest_m || std::abs(p.down) > farthest_m)
    return path_messages::origin_too_far.c_str();
  const bool placed = !geodetic || origin_known_;
  if (placed && -p.down < lowest_m_)
    return path_messages::waypoint_low.to<Text<80>>(Fixed{0 - p.down, 1}, lowest_m_);
  if (const Reason fault = placed ? fence_.fault_of(p) : Reason{}) return fault;
  if (!std::isfinite(w.course_rad)) return path_messages::course_not_finite.c_str();
  if (!(w.airspeed_mps >= 0 && w.airspeed_mps < 1000))
    return path_messages::airspeed_not_valid.to<Text<80>>(w.airspeed_mps);
  return {};
}

inline bool Planner::close(const Waypoint& a, const Waypoint& b) const {
  if (!origin_known_ && (a.frame != WaypointFrame::local || b.frame != WaypointFrame::local)) return false;
  return std::hypot(a.position_m.north - b.position_m.north, a.position_m.east - b.position_m.east) <
         closest_m;
}

inline Planner::Reason Planner::fault_of_neighbours(const Waypoint& w, const Waypoint* before,
                                                    const Waypoint* after) const {
  if (before && close(w, *before)) return path_messages::waypoint_before_close.c_str();
  if (after && close(w, *after)) return path_messages::waypoint_after_close.c_str();
  return {};
}

/// Checks the resulting plan of a group: in between waypoints may be anywhere.
inline Planner::Reason Planner::fault_of_spacing(const Plan& plan) const {
  for (std::uint32_t i = 1; i < plan.waypoints.count; ++i)
    if (close(plan.waypoints[i - 1], plan.waypoints[i]))
      return path_messages::waypoints_close.to<Text<80>>(i - 1, i);
  return {};
}

inline void Planner::resolve(Waypoint& w) const {
  if (w.frame == WaypointFrame::geodetic && origin_known_ && std::abs(w.latitude_deg) <= 90 &&
      std::isfinite(w.longitude_deg)) {
    w.position_m = from_eigen<Ned>(frame_.to_ned(w.latitude_deg, w.longitude_deg, w.altitude_m));
  }
}

/// Geodetic waypoints had no height above the origin until now. A plan with one that is too low is not
/// published.
inline void Planner::report_unflyable(const Tick& tick, Outputs& out) {
  for (std::uint32_t i = 0; i < plan_.waypoints.count; ++i) {
    const Reason fault = fault_of(plan_.waypoints[i]);
    if (!fault) continue;
    Notice notice;
    notice.severity = Severity::error;
    std::array<char, 96> words{};
    path_messages::waypoint_not_valid.write(words.data(), words.size(), i + 1, fault->view());
    fit_words(words.data(), notice.text.bytes.data(), notice.text.bytes.size());
    out.notices.push(notice, tick.now_ns);
    return;
  }
}

inline bool Planner::resolved() const {
  for (const Waypoint& w : plan_.waypoints) {
    if (w.frame == WaypointFrame::geodetic && (!origin_known_ || fault_of(w))) return false;
  }
  return true;
}

inline void Planner::know_origin(double lat_deg, double lon_deg, double alt_m) {
  frame_ = LocalFrame(lat_deg, lon_deg, alt_m);
  origin_known_ = true;
  for (Waypoint& w : plan_.waypoints) resolve(w);
  for (Waypoint& w : group_.plan.waypoints) resolve(w);
}

}  // namespace fulmar::path
