// SPDX-License-Identifier: BSD-3-Clause
// wired: progress manage.progress, state nav.state, results plan.results
// says: edits PlanEdit[]
// rate: 10 Hz
// feeds: edits plan.edits
// A planner: it reads the progress of the flight, and edits the plan.
#pragma once
#include <fulmar/msg/plan_edit.hpp>
#include <fulmar/msg/progress.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {
  static constexpr const char* doc = "A detour after some waypoints, then the rest of the plan.";
  struct Inputs {
    In<Progress> progress;
    In<VehicleState> state;
    Queue<PlanEditResult> results;  // result of each edit, also of edits by other components
  };
  struct Outputs {
    OutQueue<PlanEdit, 16> edits;  // all edits of one step arrive together, in their order
  };
  struct Params {
    Count after{2, 1, 1000, "number of waypoints before the detour"};
    Vector<Ned> detour{{0, 0, -80}, "m", -10000, 10000, "position of the detour, from the origin"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    for (const auto& sample : in.results)
      if (sample.value.id == our_id && !sample.value.accepted)
        refused_ = true;  // the reason is in sample.value.reason
    if (refused_) return Status::degraded;
    // Replace this condition by your own plan.
    if (sent_ || in.progress->items == 0 || in.progress->reached < p.after) return Status::ok;
    PlanEdit edit;
    edit.id = our_id;
    edit.group = 1;  // both edits are applied, or none
    edit.group_size = 2;
    edit.kind = PlanEditKind::insert;
    edit.index = in.progress->item;  // before the active waypoint
    edit.waypoint.position_m = p.detour.value;
    sent_ = out.edits.push(edit, tick.now_ns);
    edit.kind = PlanEditKind::set_current;  // and fly there at once
    out.edits.push(edit, tick.now_ns);
    return Status::ok;
  }

 private:
  static constexpr std::uint32_t our_id = 1;
  bool sent_ = false, refused_ = false;
};
