// SPDX-License-Identifier: BSD-3-Clause
// Searches around a place in a growing square, then restores the plan. Pattern SS of the International
// Aeronautical and Maritime Search and Rescue Manual, volume II, 5.3: legs of 1, 1, 2, 2, 3, 3 ... track
// spacings, each turned by 90 deg from the one before.
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <fulmar/msg/notice.hpp>
#include <fulmar/msg/plan_edit.hpp>
#include <fulmar/msg/progress.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct ExpandingSquare {
  static constexpr const char* doc = "Expanding-square search, inserted into the plan and removed again.";
  static constexpr std::size_t max_corners = 24;
  struct Inputs {
    In<VehicleState> state;
    In<Progress> progress;
    In<Plan> plan;
    Queue<PlanEditResult> results;  // results of all edits, also of other components
  };
  struct Outputs {
    OutQueue<PlanEdit, max_corners + 1> edits;
    OutQueue<Notice, 2> notices;
    Probe corners_ratio;  // number of corners reached in the search
  };
  struct Params {
    Count after{2, 1, 1000, "number of waypoints before the search"};
    Param spacing{120, "m", 5, 5000, "distance between two tracks"};
    Param first_leg{0, "rad", -3.15, 3.15, "course of the first leg"};
    Count corners{9, 1, max_corners, "number of corners of the square"};
    Flag left{false, "switch for turns to the left at the corners"};
  };

  /// Corner `k`, from 0, relative to the start of the search.
  static Vec3<Ned> corner(std::int64_t k, const Params& p) {
    Vec3<Ned> at;
    for (std::int64_t leg = 0; leg <= k; ++leg) {
      const double length_m = p.spacing * static_cast<double>(1 + leg / 2);
      const double chi =
          p.first_leg + (p.left ? -1 : 1) * std::numbers::pi / 2 * static_cast<double>(leg % 4);
      at = at + length_m * Vec3<Ned>{std::cos(chi), std::sin(chi), 0};
    }
    return at;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    for (const auto& sample : in.results) hear(tick, sample.value, out);
    if (phase_ == Phase::waiting && in.progress->reached >= p.after && in.plan->waypoints.count > 0 &&
        in.progress->item < in.plan->waypoints.count && in.state->position_valid)
      begin(tick, in, p, out);
    if (phase_ == Phase::searching && in.progress->plan_revision >= revision_) search(tick, in, out);
    out.corners_ratio = static_cast<double>(corners_);
    return phase_ == Phase::refused ? Status::degraded : Status::ok;
  }

 private:
  enum class Phase : std::uint8_t { waiting, asked, searching, tidying, done, refused };
  static constexpr std::uint32_t begin_group = 1, end_group = 2;
  static constexpr std::uint32_t first_id = 1000;  // range of our edit ids; other components count from 1

  /// Inserts all corners before the active waypoint, and makes the first one active: all edits are applied,
  /// or none.
  void begin(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    count_ = static_cast<std::uint32_t>(p.corners.value);
    const Waypoint& next = in.plan->waypoints[in.progress->item];
    PlanEdit edit;
    edit.group = begin_group;
    edit.group_size = count_ + 1;
    edit.kind = PlanEditKind::insert;
    edit.waypoint_id = next.id;  // an index may change before this edit arrives
    edit.waypoint.position_m = in.state->position_m;
    edit.waypoint.position_m.down = next.position_m.down;
    const Vec3<Ned> datum = edit.waypoint.position_m;
    for (std::uint32_t k = 0; k < count_; ++k) {
      edit.id = first_id + k;
      edit.waypoint.position_m = datum + corner(k, p);
      out.edits.push(edit, tick.now_ns);
    }
    edit.id = first_id + count_;
    edit.kind = PlanEditKind::set_current;
    edit.waypoint_id = 0;
    edit.index = in.progress->item;  // index of the first corner after the insertion
    out.edits.push(edit, tick.now_ns);
    phase_ = Phase::asked;
  }

  void hear(const Tick& tick, const PlanEditResult& result, Outputs& out) {
    if (result.id < first_id || result.id > first_id + max_corners) return;  // of another component
    if (!result.accepted && (phase_ == Phase::asked || phase_ == Phase::tidying)) {
      report(tick, phase_ == Phase::asked ? "search refused" : "the search stays in the plan", result.reason,
             out);
      phase_ = Phase::refused;
      return;
    }
    if (phase_ == Phase::asked && result.id < first_id + count_)
      ids_[result.id - first_id] = result.waypoint_id;
    if (!result.in_force) return;
    revision_ = result.revision;
    if (phase_ == Phase::asked) phase_ = Phase::searching;
    if (phase_ == Phase::tidying) phase_ = Phase::done;
  }

  /// Counts the corners passed: all before the active waypoint. At the end, removes them.
  void search(const Tick& tick, const Inputs& in, Outputs& out) {
    const Plan& plan = *in.plan;
    if (in.progress->item >= plan.waypoints.count) return;
    const std::uint32_t to = plan.waypoints[in.progress->item].id;
    corners_ = count_;
    for (std::uint32_t k = 0; k < count_; ++k)
      if (ids_[k] == to) corners_ = k;
    if (corners_ < count_) return;
    PlanEdit edit;
    edit.group = end_group;
    edit.group_size = count_;
    edit.kind = PlanEditKind::remove;
    for (std::uint32_t k = 0; k < count_; ++k) {
      edit.id = first_id + k;
      edit.waypoint_id = ids_[k];
      out.edits.push(edit, tick.now_ns);
    }
    phase_ = Phase::tidying;
  }

  static void report(const Tick& tick, const char* what, const Text<80>& why, Outputs& out) {
    std::array<char, 96> words{};
    std::snprintf(words.data(), words.size(), "%s: %s", what, why.bytes.data());
    Notice notice;
    notice.severity = Severity::warning;
    notice.text = words.data();
    out.notices.push(notice, tick.now_ns);
  }

  Phase phase_ = Phase::waiting;
  std::uint32_t count_ = 0, corners_ = 0, revision_ = 0;
  std::array<std::uint32_t, max_corners> ids_{};  // ids of the corners in the plan
};
