// SPDX-License-Identifier: BSD-3-Clause
// Standard messages of ROS 2 as commands: a goal becomes a plan of one waypoint, a twist becomes course,
// height and speed.
#pragma once
#include <algorithm>

#include "convert.hpp"
#include "fulmar/flight/math/angles.hpp"
#include "fulmar/msg/guidance_command.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::ros_bridge {

enum class GoalMode : std::uint8_t { replace, append };

/// Goal of rviz's "2D Goal Pose" or of another node.
struct Goal {
  static constexpr const char* doc = "Plan edits from a goal pose of ROS 2 (ENU).";
  struct Inputs {
    Queue<RosPoseStamped> goal;
    Optional<VehicleState> state;
  };
  struct Outputs {
    OutQueue<PlanEdit> edits;
    Probe refused_ratio;  // number of rejected goals since the start
  };
  struct Params {
    Choice<GoalMode> mode{GoalMode::replace,
                          "use of the goal; replace: it is the whole plan; append: it is the last waypoint"};
    Flag use_heading{false, "use of the heading of the pose at the goal"};
    Param height{0, "m", 0, 10000,
                 "height above the origin for goals with z = 0, as rviz sends them; 0: present height"};
    Param airspeed{0, "m/s", 0, 200, "airspeed on the leg to the goal; 0: airspeed of the plan"};
  };

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    refused_ += in.goal.lost();
    for (const auto& sample : in.goal) {
      if (!take(tick, sample.value, in, p, out)) ++refused_;
    }
    out.refused_ratio = refused_;
    return Status::ok;
  }

 private:
  bool take(const Tick& tick, const RosPoseStamped& goal, const Inputs& in, const Params& p, Outputs& out) {
    PlanEdit edit;
    edit.waypoint.position_m = ned(goal.pose.position);
    const Vec3<Ned>& at = edit.waypoint.position_m;
    if (!std::isfinite(at.north) || !std::isfinite(at.east) || !std::isfinite(at.down)) return false;
    if (at.down == 0 && !choose_height(in, p, edit.waypoint)) return false;
    edit.waypoint.airspeed_mps = p.airspeed;
    edit.waypoint.has_course = p.use_heading && course_of(goal.pose.orientation, edit.waypoint.course_rad);
    if (out.edits.count + 2 > out.edits.items.size()) return false;
    if (p.mode.value == GoalMode::replace) {
      PlanEdit clear;
      clear.kind = PlanEditKind::clear;
      clear.group = edit.group = ++group_;  // a goal that the planner rejects leaves the plan unchanged
      clear.group_size = edit.group_size = 2;
      out.edits.push(clear, tick.now_ns);
    }
    return out.edits.push(edit, tick.now_ns);
  }
  static bool choose_height(const Inputs& in, const Params& p, Waypoint& w) {
    const bool known = in.state && in.state->height_valid;
    if (p.height <= 0 && !known) return false;
    w.position_m.down = p.height > 0 ? -p.height : -in.state->height_m;
    return true;
  }

  std::uint32_t refused_ = 0, group_ = 0;
};

/// Follows twists: linear.x true airspeed, linear.z climb, angular.z turn to the left, in FLU. Fills the role
/// `guide`.
struct Velocity {
  static constexpr const char* doc =
      "Guidance from twists of ROS 2: forward speed, climb rate, turn rate to the left.";
  struct Inputs {
    In<VehicleState> state;
    Optional<RosTwist> twist;
  };
  struct Outputs {
    GuidanceCommand command;
  };
  struct Params {
    Param airspeed_min{10, "m/s", 0, 200, "lower limit of the airspeed command"};
    Param airspeed_max{25, "m/s", 0, 200, "upper limit of the airspeed command"};
    Param climb_max{3, "m/s", 0, 50, "largest climb rate command, either way"};
    Param turn_max{0.4, "rad/s", 0, 2, "largest turn rate command, either way"};
    Param height_min{20, "m", 0, 10000, "lower limit of the commanded height above the origin"};
    Param timeout{0.5, "s", 0.05, 60,
                  "largest age of a twist; after it straight and level flight at the last airspeed"};
  };

  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Outputs&) {
    begin(*in.state, p);
    begun_ = true;
    last_ns_ = tick.now_ns;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    constexpr double g = 9.80665;
    if (!begun_) begin(*in.state, p);
    const double dt = begun_ ? 1e-9 * static_cast<double>(tick.now_ns - last_ns_) : 0;
    begun_ = true;
    last_ns_ = tick.now_ns;
    const bool heard = in.twist && in.twist.age_s() <= p.timeout && usable(*in.twist);
    double turn = 0, climb = 0;  // to the right; up
    if (heard) {
      turn = std::clamp(-in.twist->angular.z, -p.turn_max.value, p.turn_max.value);
      climb = std::clamp(in.twist->linear.z, -p.climb_max.value, p.climb_max.value);
      command_.airspeed_mps = std::clamp(in.twist->linear.x, p.airspeed_min.value,
                                         std::max(p.airspeed_min.value, p.airspeed_max.value));
    }
    command_.course_rad = wrap_pi(command_.course_rad + turn * dt);
    const double height = std::max(command_.height_m + climb * dt, p.height_min.value);
    command_.climb_rate_mps = height > p.height_min ? climb : 0;
    command_.height_m = height;
    command_.roll_feedforward_rad =
        std::atan(in.state->ground_speed_mps * turn / g);  // coordinated turn, B&M (9.14) without wind
    out.command = command_;
    return heard ? Status::ok : Status::degraded;
  }

 private:
  static bool usable(const RosTwist& t) {
    return std::isfinite(t.linear.x) && std::isfinite(t.linear.z) && std::isfinite(t.angular.z);
  }
  void begin(const VehicleState& s, const Params& p) {
    command_ = {};
    command_.course_rad = s.course_rad;
    command_.height_m = std::max(s.height_m, p.height_min.value);
    command_.airspeed_mps = std::clamp(s.airspeed_mps, p.airspeed_min.value,
                                       std::max(p.airspeed_min.value, p.airspeed_max.value));
  }

  GuidanceCommand command_;
  bool begun_ = false;
  std::int64_t last_ns_ = 0;
};

}  // namespace fulmar::ros_bridge
