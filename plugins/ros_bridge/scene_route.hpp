// SPDX-License-Identifier: BSD-3-Clause
// The route of a plan as poses: fillets, Dubins paths, the last orbit. Source: fulmar/flight/path/route.hpp,
// which path/Manager follows.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "convert.hpp"
#include "fulmar/flight/path/route.hpp"
#include "ros_markers.hpp"

namespace fulmar::ros_bridge {

/// Draws a plan leg by leg, so that the cost of a step does not depend on the size of the plan. A fillet that
/// the wind makes wider in flight is drawn as planned.
class RouteDrawing {
 public:
  static constexpr std::uint32_t legs_per_step = 32;
  static constexpr double arc_step_rad = 10 * std::numbers::pi / 180;  // 0.2 m off an arc of 50 m
  static constexpr std::uint32_t orbit_poses = 37;

  void begin(RosRoute& out, const RosHeader& header) {
    out.header = header;
    out.poses.clear();
    next_ = 0;
    busy_ = true;
  }
  bool busy() const { return busy_; }

  /// Draws some more legs. Returns true when the drawing is complete.
  bool go_on(const Plan& plan, RosRoute& out) {
    const Route route(plan);
    const std::uint32_t n = route.size();
    if (n == 0) return !(busy_ = false);
    if (route.is_point()) {
      add_orbit({plan.waypoints[0].position_m.north, plan.waypoints[0].position_m.east, route.height_m(0),
                 route.radius_m(), Turn::right},
                0, out);
      return !(busy_ = false);
    }
    // an open plan has no leg to its first waypoint
    if (next_ == 0 && !route.closed()) next_ = 1;
    const auto room = static_cast<std::uint32_t>(out.poses.capacity()) - 1 - orbit_poses;
    const std::uint32_t last = std::min(n, next_ + legs_per_step);
    for (; next_ < last; ++next_) add_leg(route.leg(next_), room / n, out);
    if (next_ < n) return false;
    if (!route.closed()) {
      const RouteOrbit orbit = route.final_orbit();
      const RosPoint& end = out.poses[out.poses.size() - 1].pose.position;
      add_orbit(orbit, std::atan2(end.x - orbit.east_m, end.y - orbit.north_m), out);
    }
    return !(busy_ = false);
  }

 private:
  static void add(const Pose& at, double height_m, RosRoute& out) {
    out.poses.push_back({out.header, {{at.east_m, at.north_m, height_m}, enu_heading(at.course_rad)}});
  }

  static std::uint32_t steps_of(const RoutePiece& piece) {
    if (piece.kind == PathKind::line) return 1;
    return static_cast<std::uint32_t>(
        std::clamp(std::ceil(piece.length_m / (piece.radius_m * arc_step_rad) - 1e-9), 1.0, 100.0));
  }

  /// `most` poses, at least 1. When more are needed, first all arcs become coarser, then pieces are left out.
  /// The end of a leg is always drawn.
  void add_leg(const RouteLeg& leg, std::uint32_t most, RosRoute& out) const {
    if (out.poses.empty()) add(leg[0].pose_at(0), leg[0].height_m, out);
    std::uint32_t wanted = 0;
    for (std::uint32_t i = 0; i < leg.count; ++i) wanted += steps_of(leg[i]);
    const std::uint32_t first = leg.count > most ? leg.count - std::max(most, 1U) : 0;
    for (std::uint32_t i = first; i < leg.count; ++i) {
      const RoutePiece& piece = leg[i];
      std::uint32_t steps = steps_of(piece);
      if (wanted > most) steps = std::max(1U, steps * (most > leg.count ? most - leg.count : 0) / wanted);
      for (std::uint32_t k = 1; k <= steps; ++k) {
        const double along = piece.length_m * k / steps;
        add(piece.pose_at(along), piece.height_at(along), out);
      }
    }
  }

  /// One turn, from an azimuth on.
  static void add_orbit(const RouteOrbit& orbit, double start_rad, RosRoute& out) {
    const double side = sign_of(orbit.turn);
    for (std::uint32_t k = 0; k < orbit_poses; ++k) {
      const double azimuth = start_rad + side * arc_step_rad * k;
      add({orbit.north_m + orbit.radius_m * std::cos(azimuth),
           orbit.east_m + orbit.radius_m * std::sin(azimuth), azimuth + side * std::numbers::pi / 2},
          orbit.height_m, out);
    }
  }

  std::uint32_t next_ = 0;
  bool busy_ = false;
};

}  // namespace fulmar::ros_bridge
