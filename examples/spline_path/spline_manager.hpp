// SPDX-License-Identifier: BSD-3-Clause
// A smooth curve through the waypoints of the plan, one leg after the other. Centripetal Catmull-Rom: Yuksel,
// Schaefer & Keyser, Parameterization and Applications of Catmull-Rom Curves (2011), section 3: a leg has no
// loop and no cusp, for any length of the adjacent legs.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/path/curve.hpp>
#include <fulmar/msg/path.hpp>
#include <fulmar/msg/plan.hpp>
#include <fulmar/msg/progress.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct SplineManager {
  static constexpr const char* doc = "Smooth curve through the waypoints, and the progress along it.";
  struct Inputs {
    In<VehicleState> state;
    In<Plan> plan;
  };
  struct Outputs {
    Out<Path> path;  // silent until the position is known
    Progress progress;
    Probe along_ratio;  // position along the leg
  };
  struct Params {
    Param tension{0, "ratio", 0, 1,
                  "tension of the spline; 0: Catmull-Rom; 1: straight legs with sharp corners"};
    Param rejoin_distance{60, "m", 10, 1000, "distance from the curve beyond which a new curve is computed"};
    Param hold_height{50, "m", 0, 10000, "minimum height of the orbit that is flown without a plan"};
    Count first_item{0, 0, 65535, "index of the first waypoint"};
  };

  /// Curve of the leg that ends at waypoint `i`. A circuit of two waypoints is a circle; the ends of an open
  /// plan are mirrored.
  static Curve leg(const Plan& plan, std::uint32_t i, double tension) {
    const std::uint32_t n = plan.waypoints.count;
    const bool closed = plan.end == PlanEnd::circuit;
    const auto point = [&](std::uint32_t k) { return plan.waypoints[k % n].position_m; };
    const Vec3<Ned> from = point(i + n - 1), to = point(i);
    if (closed && n == 2) {
      const Vec3<Ned> across{2 * (to.east - from.east), -2 * (to.north - from.north), 0};
      return Curve::hermite(from, across, to, -1 * across);
    }
    const Vec3<Ned> before = closed || i > 1 ? point(i + 2 * n - 2) : 2 * from - to;
    const Vec3<Ned> after = closed || i + 1 < n ? point(i + 1) : 2 * to - from;
    const double k = 1 - tension;
    return Curve::hermite(from, k * slope(before, from, to, knots(from, to)), to,
                          k * slope(from, to, after, knots(from, to)));
  }

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    const VehicleState& state = *in.state;
    const Plan& plan = *in.plan;
    if (!state.position_valid) {  // the path that was published stays in force
      out.progress = progress_;
      return Status::degraded;
    }
    if (mode_ == Mode::idle || plan.revision != progress_.plan_revision) adopt(plan, state, p);
    if (mode_ != Mode::orbit) fly(plan, state, p);
    publish(plan, state, p, out);
    return Status::ok;
  }
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs&) {
    mode_ = Mode::idle;
    return Status::ok;
  }

 private:
  enum class Mode : std::uint8_t { idle, join, leg, orbit };

  static double knots(const Vec3<Ned>& a, const Vec3<Ned>& b) {  // centripetal: root of the length
    return std::sqrt(std::max(std::hypot(b.north - a.north, b.east - a.east), 1.0));
  }
  /// dp/du at `b`, for an adjacent leg of `t` knots. Barry & Goldman (1988), differentiated.
  static Vec3<Ned> slope(const Vec3<Ned>& a, const Vec3<Ned>& b, const Vec3<Ned>& c, double t) {
    const double t1 = knots(a, b), t2 = knots(b, c);
    return t * ((1 / t1) * (b - a) - (1 / (t1 + t2)) * (c - a) + (1 / t2) * (c - b));
  }

  void adopt(const Plan& plan, const VehicleState& state, const Params& p) {
    const std::uint32_t n = plan.waypoints.count;
    const bool jump = mode_ == Mode::idle || plan.jumps != jumps_ || progress_.items == 0;
    std::uint32_t item = std::min(progress_.item, std::max(n, 1u) - 1);
    if (mode_ == Mode::idle && progress_.plan_revision == 0)
      item = static_cast<std::uint32_t>(p.first_item.value);
    else if (plan.jumps != jumps_)
      item = plan.jump_item;
    else
      for (std::uint32_t i = 0; i < n; ++i)
        if (plan.waypoints[i].id != 0 && plan.waypoints[i].id == target_id_) item = i;
    progress_.items = n;
    progress_.plan_revision = plan.revision;
    jumps_ = plan.jumps;
    if (jump) begun_ = false;
    if (n < 2) return orbit(plan, state, p);
    progress_.item = std::min(item, n - 1);
    const bool stays =
        mode_ == Mode::leg && !jump && is_leg(plan) && leg(plan, progress_.item, p.tension).p == curve_.p;
    progress_.finished = progress_.finished && mode_ == Mode::orbit && !jump && progress_.item + 1 == n;
    if (!stays && !progress_.finished) join(plan, state, p);
  }
  bool is_leg(const Plan& plan) const { return progress_.item > 0 || plan.end == PlanEnd::circuit; }

  /// Curve from the position and course of the aircraft to the waypoint, and on into the next leg.
  void join(const Plan& plan, const VehicleState& state, const Params& p) {
    mode_ = Mode::join;
    const std::uint32_t i = progress_.item;
    const bool goes_on = plan.end == PlanEnd::circuit || i + 1 < plan.waypoints.count;
    const Curve known =
        goes_on ? leg(plan, (i + 1) % plan.waypoints.count, p.tension) : leg(plan, i, p.tension);
    const double chi = known.course_rad(goes_on ? 0 : 1);
    const Vec3<Ned> to = plan.waypoints[i].position_m;
    const double d =
        std::max(std::hypot(to.north - state.position_m.north, to.east - state.position_m.east), 50.0);
    Vec3<Ned> from = state.position_m;
    curve_ = Curve::hermite(from, d * Vec3<Ned>{std::cos(state.course_rad), std::sin(state.course_rad), 0},
                            to, d * Vec3<Ned>{std::cos(chi), std::sin(chi), 0});
    closest_m_ = unknown_std;
  }

  void orbit(const Plan& plan, const VehicleState& state, const Params& p) {
    mode_ = Mode::orbit;
    progress_.item = 0;
    centre_ = state.position_m;
    centre_.down = -std::max(state.height_m, p.hold_height.value);
    if (plan.waypoints.count > 0) centre_ = plan.waypoints[plan.waypoints.count - 1].position_m;
  }

  void fly(const Plan& plan, const VehicleState& state, const Params& p) {
    u_ = curve_.closest(state.position_m.north, state.position_m.east);
    const Vec3<Ned> at = curve_.point(u_), to = plan.waypoints[progress_.item].position_m;
    closest_m_ =
        std::min(closest_m_, std::hypot(to.north - state.position_m.north, to.east - state.position_m.east));
    if (u_ > 1 - 1e-4) return reach(plan, state, p);
    const double off_m = std::hypot(at.north - state.position_m.north, at.east - state.position_m.east);
    if (off_m > p.rejoin_distance) join(plan, state, p);
  }

  void reach(const Plan& plan, const VehicleState& state, const Params& p) {
    const std::uint32_t n = plan.waypoints.count, id = plan.waypoints[progress_.item].id;
    ++progress_.reached;
    progress_.miss_m = closest_m_;
    closest_m_ = unknown_std;
    if (!begun_) {
      begun_ = true;
      first_id_ = id;
    } else if (id == first_id_) {
      ++progress_.circuits;
    }
    if (plan.end == PlanEnd::orbit && progress_.item + 1 == n) {
      progress_.finished = true;
      ++progress_.circuits;
      const std::uint32_t last = progress_.item;
      orbit(plan, state, p);
      progress_.item = last;
      return;
    }
    progress_.item = (progress_.item + 1) % n;
    mode_ = Mode::leg;
    curve_ = leg(plan, progress_.item, p.tension);
    u_ = curve_.closest(state.position_m.north, state.position_m.east);
  }

  void publish(const Plan& plan, const VehicleState& state, const Params& p, Outputs& out) {
    Path path;
    const std::uint32_t n = plan.waypoints.count, i = progress_.item;
    const double own = n > 0 ? plan.waypoints[i].airspeed_mps : 0;
    path.airspeed_mps = own > 0 ? own : plan.airspeed_mps;
    if (mode_ == Mode::orbit) {
      path.kind = PathKind::orbit;
      path.origin_m = centre_;
      path.radius_m = plan.turn_radius_m;
    } else {
      set_curve(path, curve_, u_);
      if (plan.end == PlanEnd::circuit || i + 1 < n) {
        const Curve next = leg(plan, (i + 1) % n, p.tension);
        path.has_next = path.next.is_curve = true;
        path.next.control_m = next.p;
        path.next.length_m = next.length_m();
        path.next.airspeed_mps = path.airspeed_mps;
        path.next_curvature_ratio = next.curvature(0);
      }
    }
    const Vec3<Ned> goal = n > 0 ? plan.waypoints[i].position_m : centre_;
    progress_.distance_m = std::hypot(goal.north - state.position_m.north, goal.east - state.position_m.east);
    progress_.joining = mode_ == Mode::join;
    if (n > 0) target_id_ = plan.waypoints[i].id;
    out.path.publish(path);
    out.progress = progress_;
    out.along_ratio = mode_ == Mode::orbit ? 0 : u_;
  }

  Mode mode_ = Mode::idle;
  Curve curve_;
  double u_ = 0, closest_m_ = unknown_std;
  Vec3<Ned> centre_;
  Progress progress_;
  std::uint32_t jumps_ = 0, target_id_ = 0, first_id_ = 0;
  bool begun_ = false;  // for a circuit: true after its start
};
