// SPDX-License-Identifier: BSD-3-Clause
// Look-ahead guidance: steers to the point of the path at distance L1, also beyond a corner. Source: Park,
// Deyst & How, A New Nonlinear Guidance Logic for Trajectory Tracking (AIAA 2004-4900), equation (1). L1
// grows with the speed for a constant period and damping (section IV: omega = sqrt(2) Vg / L1 at a damping of
// 1/sqrt(2)).
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

struct L1Guide {  // fills the role `guide`
  static constexpr const char* doc = "Guidance to a point ahead on the path by lateral acceleration (L1).";
  struct Inputs {
    In<VehicleState> state;
    In<Path> path;
  };
  struct Outputs {
    GuidanceCommand command;
    Probe cross_track_m;  // right of the path is positive
    Probe eta_rad;        // from the ground track to the target point
    Probe corner_ratio;   // 1: the target point lies on the next piece
  };
  struct Params {
    Param period{7, "s", 2, 60, "period of the oscillation about the path: smaller is tighter"};
    Param damping{0.75, "ratio", 0.3, 1.5, "damping ratio of the oscillation about the path"};
    Flag corners{true, "switch for the look-ahead into the next leg"};
  };

  struct Point {
    double north = 0, east = 0;
  };

  /// Projection of the aircraft onto the active piece.
  struct Foot {
    PathPiece piece;  // starts at the foot
    double u = 0;     // curve parameter
    double course_rad = 0, height_m = 0, climb_ratio = 0, cross_m = 0;
  };

  static Foot foot_of(const Path& path, const VehicleState& state) {
    Foot foot;
    PathPiece& at = foot.piece;
    at.kind = path.kind;
    at.turn = path.turn;
    at.origin_m = path.origin_m;
    at.direction_ratio = path.direction_ratio;
    at.radius_m = std::max(path.radius_m, 1.0);
    at.is_curve = path.is_curve;
    at.control_m = path.control_m;
    const Vec3<Ned>& p = state.position_m;
    const double n = p.north - path.origin_m.north, e = p.east - path.origin_m.east;
    if (path.is_curve) {
      const Curve curve = curve_of(path);
      foot.u = curve.closest(p.north, p.east);
      const Vec3<Ned> c = curve.point(foot.u);
      foot.course_rad = curve.course_rad(foot.u);
      foot.climb_ratio = curve.climb_ratio(foot.u);
      foot.height_m = -c.down;
      foot.cross_m =
          std::cos(foot.course_rad) * (p.east - c.east) - std::sin(foot.course_rad) * (p.north - c.north);
    } else if (path.kind == PathKind::line) {
      const Vec3<Ned>& q = path.direction_ratio;
      const double level = std::max(std::hypot(q.north, q.east), 1e-6);
      const double along = (n * q.north + e * q.east) / level;
      foot.course_rad = std::atan2(q.east, q.north);
      foot.climb_ratio = -q.down / level;
      foot.height_m = -path.origin_m.down + foot.climb_ratio * along;
      foot.cross_m = (q.north * e - q.east * n) / level;
      at.origin_m.north += along * q.north / level;
      at.origin_m.east += along * q.east / level;
    } else {
      const double side = path.turn == Turn::right ? 1 : -1;
      at.start_rad = std::atan2(e, n);
      foot.course_rad = wrap_pi(at.start_rad + side * std::numbers::pi / 2);
      foot.climb_ratio = path.climb_ratio;
      foot.height_m = -path.origin_m.down +
                      path.climb_ratio * side * at.radius_m * wrap_pi(at.start_rad - path.start_rad);
      foot.cross_m = -side * (std::hypot(n, e) - at.radius_m);
    }
    return foot;
  }

  /// Point of a piece `s` metres after its start (on a curve: after `u`).
  static Point ahead(const PathPiece& piece, double s, double u = 0) {
    if (piece.is_curve) {
      const Curve curve{piece.control_m};
      for (int i = 0; i < 20 && u < 1; ++i) u += s / 20 / std::max(curve.speed(u), 1.0);
      const Vec3<Ned> at = curve.point(std::min(u, 1.0));
      return {at.north, at.east};
    }
    if (piece.kind == PathKind::line) {
      const double level =
          std::max(std::hypot(piece.direction_ratio.north, piece.direction_ratio.east), 1e-6);
      return {piece.origin_m.north + s * piece.direction_ratio.north / level,
              piece.origin_m.east + s * piece.direction_ratio.east / level};
    }
    const double azimuth = piece.start_rad + (piece.turn == Turn::right ? 1 : -1) * s / piece.radius_m;
    return {piece.origin_m.north + piece.radius_m * std::cos(azimuth),
            piece.origin_m.east + piece.radius_m * std::sin(azimuth)};
  }

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    constexpr double g = 9.80665;
    const VehicleState& state = *in.state;
    const Path& path = *in.path;
    const double Vg = std::max(state.ground_speed_mps, 1.0), chi = state.course_rad;
    const double L1 = p.damping * p.period * Vg / std::numbers::pi;
    const Foot foot = foot_of(path, state);
    // On a straight path the target point is at distance L1.
    const double s = std::sqrt(std::max(L1 * L1 - foot.cross_m * foot.cross_m, 0.0));
    const bool corner = p.corners && path.has_next && s > path.remaining_m;
    const Point to = corner ? ahead(path.next, s - path.remaining_m) : ahead(foot.piece, s, foot.u);
    const double n = to.north - state.position_m.north, e = to.east - state.position_m.east;
    const double distance = std::hypot(n, e);
    // At the target point its direction is undefined: straight ahead.
    const double eta = distance > 0.1 ? wrap_pi(std::atan2(e, n) - chi) : 0;
    const double across = std::sin(std::clamp(eta, -std::numbers::pi / 2, std::numbers::pi / 2));
    const double a_chi = 2 * Vg * Vg / std::clamp(distance, 0.3 * L1, L1) * across;  // (1)
    // The commanded acceleration is normal to the ground track; lift acts normal to the heading.
    const double a = a_chi / std::max(std::cos(angle_difference(chi, state.yaw_rad)), 0.5);

    out.command = {};
    out.command.lateral = LateralMode::acceleration;
    out.command.lateral_acceleration_mps2 = a;
    out.command.course_rad = chi;
    out.command.roll_feedforward_rad = std::atan(a / g);
    out.command.height_m = foot.height_m;
    out.command.climb_rate_mps = foot.climb_ratio * Vg * std::cos(angle_difference(chi, foot.course_rad));
    out.command.airspeed_mps = path.airspeed_mps;
    out.cross_track_m = foot.cross_m;
    out.eta_rad = eta;
    out.corner_ratio = corner ? 1.0 : 0.0;
    return state.position_valid ? Status::ok : Status::degraded;
  }
};
