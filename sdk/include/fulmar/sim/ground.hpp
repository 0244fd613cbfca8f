// SPDX-License-Identifier: BSD-3-Clause
// Flat ground and the gear on it: nose wheel, two main wheels, tail skid. Each is a spring and damper along
// the vertical; friction is a bristle that stretches before it slips (Dahl/LuGre without the Stribeck part),
// so an aircraft that stands does not creep.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "fulmar/flight/atmosphere.hpp"
#include "fulmar/flight/rigid_body.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::sim {

class Ground {
 public:
  /// `friction`: factor on what the airframe says, for wet grass or ice.
  explicit Ground(const Airframe& a, double friction = 1)
      : rolling_(friction * a.gear.rolling_friction_ratio), sliding_(friction * a.gear.side_friction_ratio) {
    const double weight = a.mass_kg * isa::g0, L = a.gear.length_m, h = a.gear.height_m + sag,
                 y = a.gear.track_m / 2;
    const double tail_z = h - (1 - nose_share) * L * std::tan(tail_strike_pitch);
    // A nose wheel that carries little lets the elevator lift it before the wing carries all.
    legs_[0] = leg({(1 - nose_share) * L, 0, h}, nose_share * weight, rolling_);
    legs_[1] = leg({-nose_share * L, -y, h}, (1 - nose_share) / 2 * weight, rolling_);
    legs_[2] = leg({-nose_share * L, y, h}, (1 - nose_share) / 2 * weight, rolling_);
    legs_[3] = leg({-L, 0, tail_z}, nose_share * weight, sliding_);
    const double tip_z = -tip_rise * a.wing.span_m;
    hull_ = {Eigen::Vector3d(0, -a.wing.span_m / 2, tip_z), Eigen::Vector3d(0, a.wing.span_m / 2, tip_z),
             Eigen::Vector3d(L, 0, 0), Eigen::Vector3d(0, 0, -a.gear.height_m)};
    for (const auto& l : legs_) reach_ = std::max(reach_, l.r_b.norm());
    for (const auto& r : hull_) reach_ = std::max(reach_, r.norm());
  }

  /// Too high for anything to touch.
  bool clear(const RigidBody& x) const { return -x.p_n.z() > reach_; }

  /// Adds what the gear does at state `x`.
  void add_load(const RigidBody& x, Load& load) const {
    if (clear(x)) return;
    const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
    const Eigen::Vector2d forward = R.block<2, 1>(0, 0).normalized();
    for (const auto& l : legs_) {
      const Contact c = contact(l, x, R, forward);
      if (c.normal <= 0) continue;
      const double f = std::clamp(-l.k_t * l.bristle.x() - l.c_t * c.velocity.x(), -l.rolling * c.normal,
                                  l.rolling * c.normal);
      const double s = std::clamp(-l.k_t * l.bristle.y() - l.c_t * c.velocity.y(), -sliding_ * c.normal,
                                  sliding_ * c.normal);
      const Eigen::Vector3d force_n(f * forward.x() - s * forward.y(), f * forward.y() + s * forward.x(),
                                    -c.normal);
      const Eigen::Vector3d force_b = R.transpose() * force_n;
      load.force_b += force_b;
      load.moment_b += l.r_b.cross(force_b);
    }
  }

  /// Set down on its wheels, at rest.
  void stand() {
    touching_ = true;
    for (auto& l : legs_) l.down = true;
  }

  /// After each step: bristles follow, touch-downs are judged.
  void advance(const RigidBody& x, double dt) {
    touching_ = false;
    if (clear(x)) {
      for (auto& l : legs_) lift(l);
      return;
    }
    const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
    const Eigen::Vector2d forward = R.block<2, 1>(0, 0).normalized();
    for (auto& l : legs_) {
      const Contact c = contact(l, x, R, forward);
      if (c.depth <= 0) {
        lift(l);
        continue;
      }
      if (!l.down && c.sink > hardest_touch) crashed_ = true;
      l.down = touching_ = true;
      const double f = l.rolling * c.normal / l.k_t, s = sliding_ * c.normal / l.k_t;
      l.bristle.x() = std::clamp(l.bristle.x() + dt * c.velocity.x(), -f, f);
      l.bristle.y() = std::clamp(l.bristle.y() + dt * c.velocity.y(), -s, s);
    }
    for (const auto& r : hull_) crashed_ = crashed_ || x.p_n.z() + R.row(2).dot(r) > 0;
  }

  bool touching() const { return touching_; }
  bool crashed() const { return crashed_; }

 private:
  static constexpr double sag = 0.01;         ///< m: of the gear under the weight; sets the stiffness
  static constexpr double damping = 0.7;      ///< of the aircraft bouncing on its gear, part of critical
  static constexpr double nose_share = 0.15;  ///< of the weight on the nose wheel
  static constexpr double tail_strike_pitch = 0.28;  ///< rad
  static constexpr double tip_rise =
      0.05;  ///< height of the wing tips above the centre of gravity, of the span
  static constexpr double hardest_touch = 3;  ///< m/s

  struct Leg {
    Eigen::Vector3d r_b = Eigen::Vector3d::Zero();  ///< of its foot, unloaded
    double k = 0, c = 0;                            ///< N/m, N s/m: vertical
    double k_t = 0, c_t = 0;                        ///< along the ground, while it does not slip
    double rolling = 0;                             ///< friction along its heading
    Eigen::Vector2d bristle = Eigen::Vector2d::Zero();
    bool down = false;
  };
  struct Contact {
    double depth = 0, sink = 0, normal = 0;
    Eigen::Vector2d velocity =
        Eigen::Vector2d::Zero();  ///< over the ground, along the heading and to its right
  };

  static Leg leg(const Eigen::Vector3d& r_b, double carried, double rolling) {
    Leg l;
    l.r_b = r_b;
    l.k = carried / sag;
    l.c = 2 * damping * std::sqrt(l.k * carried / isa::g0);
    l.k_t = l.k;
    l.c_t = l.c;
    l.rolling = rolling;
    return l;
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

  std::array<Leg, 4> legs_;
  std::array<Eigen::Vector3d, 4> hull_;  ///< wing tips, nose, top: where they touch, it breaks
  double rolling_, sliding_;
  double reach_ = 0;
  bool touching_ = false, crashed_ = false;
};

}  // namespace fulmar::sim
