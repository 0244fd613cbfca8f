// SPDX-License-Identifier: BSD-3-Clause
// Flat ground and the gear: nose wheel, two main wheels, tail skid, or the contact points of the airframe.
// Each is a vertical spring and damper. Friction is a bristle that stretches before it slips (Dahl/LuGre
// without the Stribeck part), so that an aircraft at rest does not creep.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/gear_legs.hpp"

namespace fulmar::sim {

/// Contact of gear and hull with flat ground at height 0: forces, touch-downs, crash.
class Ground {
 public:
  /// `friction`: factor on the airframe's friction, for wet grass or ice.
  explicit Ground(const Airframe& a, double friction = 1)
      : legs_(a, friction), sliding_(friction * a.gear.side_friction_ratio) {}

  /// True if the aircraft is too high for any contact.
  bool clear(const RigidBody& x) const { return -x.p_n.z() > legs_.reach(); }

  /// Adds the load of the gear at state `x`.
  void add_load(const RigidBody& x, Load& load) const {
    if (clear(x)) return;
    const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
    const Eigen::Vector2d forward = R.block<2, 1>(0, 0).normalized();
    for (const auto& l : legs_.legs()) {
      const Contact c = contact(l, x, R, forward);
      if (c.normal <= 0) continue;
      double f = -l.k_t * l.bristle.x() - l.c_t * c.velocity.x();
      double s = -l.k_t * l.bristle.y() - l.c_t * c.velocity.y();
      hold(l, l.rolling * c.normal, sliding_ * c.normal, f, s);
      const Eigen::Vector3d force_n(f * forward.x() - s * forward.y(), f * forward.y() + s * forward.x(),
                                    -c.normal);
      const Eigen::Vector3d force_b = R.transpose() * force_n;
      load.force_b += force_b;
      load.moment_b += l.r_b.cross(force_b);
    }
  }

  /// Sets the aircraft on its wheels, at rest.
  void stand() {
    touching_ = true;
    air_s_ = 0;
    for (auto& l : legs_.legs()) l.down = true;
  }

  /// Call after each step: updates bristles, and detects touch-downs.
  void advance(const RigidBody& x, double dt) {
    air_s_ = touching_ ? 0 : air_s_ + dt;
    touching_ = false;
    if (clear(x)) {
      for (auto& l : legs_.legs()) lift(l);
      return;
    }
    const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
    const Eigen::Vector2d forward = R.block<2, 1>(0, 0).normalized();
    const Leg* deepest = nullptr;
    double depth = 0;
    for (auto& l : legs_.legs()) {
      const Contact c = contact(l, x, R, forward);
      if (c.depth <= 0) {
        lift(l);
        continue;
      }
      if (c.depth > depth) {
        deepest = &l;
        depth = c.depth;
      }
      if (!l.down && c.sink > hardest_touch) break_at(l.part);
      l.down = touching_ = true;
      l.bristle += dt * c.velocity;
      hold(l, l.rolling * c.normal / l.k_t, sliding_ * c.normal / l.k_t, l.bristle.x(), l.bristle.y());
    }
    if (deepest && air_s_ >= shortest_flight && !crashed_) note(deepest->part);
    break_hull(x, R);
  }

  /// Attitude at rest.
  const Standing& standing() const { return legs_.standing(); }
  bool touching() const { return touching_; }
  bool crashed() const { return crashed_; }
  /// Number of touch-downs, including the contact that broke, and the part with the last one.
  std::uint32_t touches() const { return touches_; }
  const char* touched_part() const { return part_; }

 private:
  static constexpr double hardest_touch = 3;      ///< m/s
  static constexpr double shortest_flight = 0.5;  ///< s: an earlier return is a bounce

  struct Contact {
    double depth = 0, sink = 0, normal = 0;
    Eigen::Vector2d velocity =
        Eigen::Vector2d::Zero();  ///< velocity over the ground, along the heading and to its right
  };

  void note(const char* part) {
    part_ = part;
    ++touches_;
  }

  void break_at(const char* part) {
    if (!crashed_) note(part);
    crashed_ = true;
  }

  void break_hull(const RigidBody& x, const Eigen::Matrix3d& R) {
    std::size_t i = 0;
    for (const auto& r : legs_.hull()) {
      if (x.p_n.z() + R.row(2).dot(r) > 0) break_at(legs_.hull_part(i));
      ++i;
    }
  }

  /// Limits a force, or its bristle, by friction. A skid has no heading.
  static void hold(const Leg& l, double max_along, double max_across, double& along, double& across) {
    if (!l.skid) {
      along = std::clamp(along, -max_along, max_along);
      across = std::clamp(across, -max_across, max_across);
    } else if (const double size = std::hypot(along, across); size > max_along) {
      along *= max_along / size;
      across *= max_along / size;
    }
  }

  static void lift(Leg& l) {
    l.bristle.setZero();
    l.down = false;
  }

  static Contact contact(const Leg& l, const RigidBody& x, const Eigen::Matrix3d& R,
                         const Eigen::Vector2d& forward) {
    Contact c;
    c.depth = x.p_n.z() + R.row(2).dot(l.r_b);
    if (c.depth <= 0) return c;
    const Eigen::Vector3d v = x.v_n + R * x.omega_b.cross(l.r_b);
    c.sink = v.z();
    c.normal = std::max(0.0, l.k * c.depth + l.c * c.sink);
    c.velocity = {v.x() * forward.x() + v.y() * forward.y(), v.y() * forward.x() - v.x() * forward.y()};
    return c;
  }

  Legs legs_;
  double sliding_;
  bool touching_ = false, crashed_ = false;
  double air_s_ = shortest_flight;  ///< time since the last contact
  std::uint32_t touches_ = 0;
  const char* part_ = "";
};

}  // namespace fulmar::sim
