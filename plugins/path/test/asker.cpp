// SPDX-License-Identifier: BSD-3-Clause
// For a test: edits the plan in flight and uses the answers. At the first waypoint a group of three and an
// invalid edit; then it removes the added ones, by their reported ids.
#include <fulmar/msg/plan_edit.hpp>
#include <fulmar/msg/progress.hpp>
#include <fulmar/plugin.hpp>

using namespace fulmar;

struct Tally {
  std::uint32_t in_force = 0, refused = 0, taken_away = 0;
  Text<80> reason;
};

struct Asker {
  static constexpr const char* doc = "Edits the plan and counts the answers.";
  struct Inputs {
    In<Progress> progress;
    Queue<PlanEditResult> results;
  };
  struct Outputs {
    OutQueue<PlanEdit, 8> edits;
    Tally tally;
  };
  struct Params {
    Param airspeed{18, "m/s", 3, 50, "set for the plan"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    for (const auto& sample : in.results) hear(tick, sample.value, out);
    if (!asked_ && in.progress->reached > 0) ask(tick, p, out);
    out.tally = tally_;
    return Status::ok;
  }

 private:
  void ask(const Tick& tick, const Params& p, Outputs& out) {
    asked_ = true;
    PlanEdit edit;
    edit.group = 1;
    edit.group_size = 3;
    for (const double north : {700.0, 900.0}) {
      ++edit.id;
      edit.waypoint.position_m = {north, 300, -70};
      out.edits.push(edit, tick.now_ns);
    }
    PlanEdit speed = edit_of(PlanSetting::airspeed);
    speed.id = 3;
    speed.group = 1;
    speed.group_size = 3;
    speed.airspeed_mps = p.airspeed;
    out.edits.push(speed, tick.now_ns);
    PlanEdit wrong;
    wrong.id = 4;
    wrong.kind = PlanEditKind::remove;
    wrong.waypoint_id = 99;
    out.edits.push(wrong, tick.now_ns);
  }

  void hear(const Tick& tick, const PlanEditResult& result, Outputs& out) {
    if (result.id == 1) added_ = result.waypoint_id;
    if (!result.accepted) {
      ++tally_.refused;
      tally_.reason = result.reason;
    }
    if (!result.in_force) return;
    ++tally_.in_force;
    if (result.id == 5) tally_.taken_away = result.waypoint_id;
    if (result.id != 3) return;
    PlanEdit away;
    away.id = 5;
    away.kind = PlanEditKind::remove;
    away.waypoint_id = added_;
    out.edits.push(away, tick.now_ns);
  }

  Tally tally_;
  std::uint32_t added_ = 0;
  bool asked_ = false;
};

FULMAR_PLUGIN("1.0.0", Asker)
