// SPDX-License-Identifier: BSD-3-Clause
// Follows any path as a curve: Samson's law in cross-track distance and angle. Source: Micaelli & Samson,
// Trajectory tracking for unicycle-type and two-steering-wheels mobile robots (INRIA 2097, 1993).
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/flight/math/angles.hpp>
#include <fulmar/flight/path/curve.hpp>
#include <fulmar/msg/guidance_command.hpp>
#include <fulmar/msg/path.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <numbers>

using namespace fulmar;

struct SplineFollower {  // fills the role `guide`
  static constexpr const char* doc =
      "Path following of a curve: cross-track error and course error to zero by lateral acceleration.";
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
    Probe cross_track_m;  // right of the path is positive
    Probe curvature_ratio;
  };
  struct Params {
    Param length{20, "m", 5, 500, "decay length of the cross-track error: smaller is tighter"};
    Param damping{0.8, "ratio", 0.3, 2, "damping ratio of the decay"};
    Param lead_time{0.5, "s", 0, 3, "lead time of the bank command before a change of curvature"};
    Param approach_max{1.05, "rad", 0.2, 1.5, "approach angle to the path at large distance"};
  };

  /// Closest point of the path, and the curvature at the place that the aircraft reaches after the roll-in.
  struct Foot {
    double course_rad = 0, cross_m = 0, curvature = 0, curvature_ahead = 0, height_m = 0, climb_ratio = 0;
  };

  static Foot foot_of(const Path& path, const VehicleState& state, double lead_m) {
    Foot foot;
    const Vec3<Ned>& p = state.position_m;
    const double n = p.north - path.origin_m.north, e = p.east - path.origin_m.east;
    if (path.is_curve) {
      const Curve curve = curve_of(path);
      const double u = curve.closest(p.north, p.east), ahead = u + lead_m / std::max(curve.speed(u), 1.0);
      const Vec3<Ned> at = curve.point(u);
      foot.course_rad = curve.course_rad(u);
      foot.cross_m =
          std::cos(foot.course_rad) * (p.east - at.east) - std::sin(foot.course_rad) * (p.north - at.north);
      foot.curvature = curve.curvature(u);
      foot.curvature_ahead = curve.curvature(std::min(ahead, 1.0));
      if (ahead > 1 && path.has_next && path.next.is_curve) {
        const Curve next{path.next.control_m};
        const double more_m = (ahead - 1) * std::max(curve.speed(u), 1.0);
        foot.curvature_ahead = next.curvature(std::min(more_m / std::max(next.speed(0), 1.0), 1.0));
      }
      foot.height_m = -at.down;
      foot.climb_ratio = curve.climb_ratio(u);
      return foot;
    }
    if (path.kind == PathKind::line) {
      const Vec3<Ned>& q = path.direction_ratio;
      const double level = std::max(std::hypot(q.north, q.east), 1e-6);
      foot.course_rad = std::atan2(q.east, q.north);
      foot.cross_m = (q.north * e - q.east * n) / level;
      foot.climb_ratio = -q.down / level;
      foot.height_m = -path.origin_m.down + foot.climb_ratio * (n * q.north + e * q.east) / level;
    } else {
      const double side = path.turn == Turn::right ? 1 : -1, R = std::max(path.radius_m, 1.0),
                   azimuth = std::atan2(e, n);
      foot.course_rad = wrap_pi(azimuth + side * std::numbers::pi / 2);
      foot.cross_m = -side * (std::hypot(n, e) - R);
      foot.curvature = side / R;
      foot.climb_ratio = path.climb_ratio;
      foot.height_m = -path.origin_m.down + path.climb_ratio * side * R * wrap_pi(azimuth - path.start_rad);
    }
    foot.curvature_ahead = path.remaining_m < lead_m ? path.next_curvature_ratio : foot.curvature;
    return foot;
  }

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    constexpr double g = 9.80665;
    const VehicleState& state = *in.state;
    const double Vg = std::max(state.ground_speed_mps, 1.0), chi = state.course_rad;
    const Foot foot = foot_of(*in.path, state, Vg * p.lead_time);
    const double theta = angle_difference(chi, foot.course_rad);
    // Linear: d'' + 2 zeta a d' + a^2 d = 0 over the distance flown, with a = 1 / length. Far away the angle
    // of approach is limited.
    const double a = 1 / p.length, k_theta = 2 * p.damping * a, k_d = a * a;
    const double reach_m = k_theta / k_d * p.approach_max, d = std::clamp(foot.cross_m, -reach_m, reach_m);
    const double near =
        std::max(1 - foot.curvature * foot.cross_m, 0.3);  // the foot moves faster inside a turn
    const double along = std::max(std::cos(theta), 0.0);
    const double turn = foot.curvature_ahead * along / near - k_theta * theta - k_d * d;  // rad per metre
    const double a_chi = Vg * Vg * turn;
    // The commanded acceleration is normal to the ground track; lift acts normal to the heading.
    const double lateral = a_chi / std::max(std::cos(angle_difference(chi, state.yaw_rad)), 0.5);

    out.command = {};
    out.command.lateral = LateralMode::acceleration;
    out.command.lateral_acceleration_mps2 = lateral;
    out.command.course_rad = chi;
    out.command.roll_feedforward_rad = std::atan(lateral / g);
    out.command.height_m = foot.height_m;
    out.command.climb_rate_mps = foot.climb_ratio * Vg * std::cos(theta);
    out.command.airspeed_mps = in.path->airspeed_mps;
    out.cross_track_m = foot.cross_m;
    out.curvature_ratio = foot.curvature;
    return state.position_valid ? Status::ok : Status::degraded;
  }
};
