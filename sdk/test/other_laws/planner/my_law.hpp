// SPDX-License-Identifier: BSD-3-Clause
// A planner unlike the template of `fulmar new`: it reduces the airspeed of the plan after the first circuit.
#pragma once
#include <fulmar/msg/plan_edit.hpp>
#include <fulmar/msg/progress.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct MyLaw {
  struct Inputs {
    In<Progress> progress;
    In<VehicleState> state;
    Queue<PlanEditResult> results;
  };
  struct Outputs {
    OutQueue<PlanEdit, 1> edits;
  };
  struct Params {
    Param airspeed{14, "m/s", 5, 50, "after the first circuit"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    for (const auto& result : in.results) refused_ = refused_ || !result.value.accepted;
    if (sent_ || in.progress->circuits < 1) return refused_ ? Status::degraded : Status::ok;
    PlanEdit edit = edit_of(PlanSetting::airspeed);
    edit.airspeed_mps = p.airspeed;
    sent_ = out.edits.push(edit, tick.now_ns);
    return Status::ok;
  }

 private:
  bool sent_ = false, refused_ = false;
};
