// SPDX-License-Identifier: BSD-3-Clause
// The legs of an aircraft, from its size or its contact points, and its attitude at rest on them.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::sim {

/// One leg: a spring and damper at its foot, body axes, m from the centre of gravity.
struct Leg {
  Eigen::Vector3d r_b = Eigen::Vector3d::Zero();  ///< foot, unloaded
  double k = 0, c = 0;                            ///< stiffness and damping, vertical, N/m, N s/m
  double k_t = 0, c_t = 0;                        ///< the same along the ground, while sticking
  double rolling = 0;                             ///< friction along the heading
  bool skid = false;                              ///< true: `rolling` is the friction in every direction
  const char* part = "";                          ///< name in reports
  Eigen::Vector2d bristle = Eigen::Vector2d::Zero();
  bool down = false;
};

/// Name of a wheel or skid whose foot is at `r_b`.
inline const char* leg_part(const Eigen::Vector3d& r_b, bool skid) {
  constexpr double middle = 0.02;  // m
  const bool front = r_b.x() > 0;
  if (std::abs(r_b.y()) <= middle)
    return skid ? (front ? "nose skid" : "tail skid") : (front ? "nose wheel" : "tail wheel");
  if (!skid) return r_b.y() < 0 ? "left main wheel" : "right main wheel";
  if (r_b.y() < 0) return front ? "left front skid" : "left rear skid";
  return front ? "right front skid" : "right rear skid";
}

/// Name of a point of the hull at `r_b`.
inline const char* hull_part(const Eigen::Vector3d& r_b, double span_m) {
  const double y = r_b.y() / span_m;
  if (std::abs(y) > 0.35) return y < 0 ? "left wing tip" : "right wing tip";
  if (std::abs(y) > 0.1) return y < 0 ? "left wing" : "right wing";
  if (std::abs(r_b.x()) > std::abs(r_b.z())) return r_b.x() > 0 ? "nose" : "tail";
  return r_b.z() < 0 ? "back" : "belly";
}

/// Rest on flat ground: height of the centre of gravity, and attitude without heading.
struct Standing {
  bool found = false;
  double height_m = 0;
  Eigen::Quaterniond tilt = Eigen::Quaterniond::Identity();
};

/// Legs and hull points of an airframe, and its attitude at rest. Body axes, m.
class Legs {
 public:
  /// `friction`: factor on the airframe's friction.
  explicit Legs(const Airframe& a, double friction = 1)
      : weight_(a.mass_kg * isa::g0), friction_(friction), span_(a.wing.span_m) {
    if (a.gear.contacts.empty())
      derive(a);
    else
      take(a);
    for (const Leg& l : legs()) reach_ = std::max(reach_, l.r_b.norm());
    for (const Eigen::Vector3d& r : hull()) reach_ = std::max(reach_, r.norm());
  }

  std::span<Leg> legs() { return {legs_.data(), legs_count_}; }
  std::span<const Leg> legs() const { return {legs_.data(), legs_count_}; }
  /// Points that break on contact.
  std::span<const Eigen::Vector3d> hull() const { return {hull_.data(), hull_count_}; }
  const char* hull_part(std::size_t i) const { return sim::hull_part(hull_[i], span_); }
  double reach() const { return reach_; }
  const Standing& standing() const { return standing_; }

 private:
  static constexpr double sag = 0.01;     ///< m, deflection of the gear under the weight; sets the stiffness
  static constexpr double damping = 0.7;  ///< damping ratio of the bounce on the gear
  static constexpr double nose_share = 0.15;         ///< share of the weight on the nose wheel
  static constexpr double tail_strike_pitch = 0.28;  ///< rad
  static constexpr double tip_rise =
      0.05;  ///< height of the wing tips above the centre of gravity, share of the span

  /// Nose wheel, main wheels, tail skid.
  void derive(const Airframe& a) {
    const double rolling = a.gear.rolling_friction_ratio, sliding = a.gear.side_friction_ratio;
    const double L = a.gear.length_m, h = a.gear.height_m + sag, y = a.gear.track_m / 2;
    const double tail_z = h - (1 - nose_share) * L * std::tan(tail_strike_pitch);
    // With a small load on the nose wheel, the elevator lifts it before the wing carries the weight.
    add({(1 - nose_share) * L, 0, h}, nose_share * weight_, rolling);
    add({-nose_share * L, -y, h}, (1 - nose_share) / 2 * weight_, rolling);
    add({-nose_share * L, y, h}, (1 - nose_share) / 2 * weight_, rolling);
    add({-L, 0, tail_z}, nose_share * weight_, sliding);
    legs_[legs_count_ - 1].part = leg_part({-L, 0, tail_z}, true);
    break_at_tips(a, L);
    standing_ = {true, a.gear.height_m};
  }

  void take(const Airframe& a) {
    double front = 0;
    for (const GearContact& c : a.gear.contacts) {
      const bool skid = c.kind == ContactKind::skid, bears = c.carries_ratio > 0;
      const double usual = skid ? a.gear.side_friction_ratio : a.gear.rolling_friction_ratio;
      add(eigen(c.at_m) + Eigen::Vector3d(0, 0, bears ? sag : 0),
          (bears ? c.carries_ratio : nose_share) * weight_, c.friction_ratio >= 0 ? c.friction_ratio : usual);
      legs_[legs_count_ - 1].skid = skid;
      legs_[legs_count_ - 1].part = leg_part(eigen(c.at_m), skid);
      front = std::max(front, c.at_m.x);
    }
    standing_ = find_standing();
    if (a.gear.hull_m.empty()) return break_at_tips(a, front);
    for (const Vec3<Body>& r : a.gear.hull_m) hull_[hull_count_++] = eigen(r);
  }

  /// Wing tips, nose and top as points that break.
  void break_at_tips(const Airframe& a, double nose) {
    const double tip_z = -tip_rise * a.wing.span_m;
    hull_ = {Eigen::Vector3d(0, -a.wing.span_m / 2, tip_z), Eigen::Vector3d(0, a.wing.span_m / 2, tip_z),
             Eigen::Vector3d(nose, 0, 0), Eigen::Vector3d(0, 0, -a.gear.height_m)};
    hull_count_ = 4;
  }

  void add(const Eigen::Vector3d& r_b, double carried, double rolling) {
    Leg& l = legs_[legs_count_++];
    l.r_b = r_b;
    l.part = leg_part(r_b, false);
    l.k = carried / sag;
    l.c = 2 * damping * std::sqrt(l.k * carried / isa::g0);
    l.k_t = l.k;
    l.c_t = l.c;
    l.rolling = friction_ * rolling;
  }

  /// Minimum energy of weight and springs over height, pitch and roll, by Newton's method with Levenberg's
  /// damping.
  Standing find_standing() const;
  struct Slopes {
    double energy = 0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };
  Slopes slopes(const Eigen::Vector3d& height_pitch_roll) const;

  double weight_, friction_, span_;
  std::array<Leg, 12> legs_;
  std::array<Eigen::Vector3d, 12> hull_;
  std::size_t legs_count_ = 0, hull_count_ = 0;
  double reach_ = 0;
  Standing standing_;
};

inline Legs::Slopes Legs::slopes(const Eigen::Vector3d& s) const {
  const double ct = std::cos(s(1)), st = std::sin(s(1)), cp = std::cos(s(2)), sp = std::sin(s(2));
  Slopes out;
  out.energy = weight_ * s(0);
  out.gradient(0) = weight_;
  for (const Leg& l : legs()) {
    const double across = sp * l.r_b.y() + cp * l.r_b.z();
    const double depth = -st * l.r_b.x() + ct * across - s(0);
    if (depth <= 0) continue;
    const Eigen::Vector3d d(-1, -ct * l.r_b.x() - st * across, ct * (cp * l.r_b.y() - sp * l.r_b.z()));
    out.energy += 0.5 * l.k * depth * depth;
    out.gradient += l.k * depth * d;
    out.hessian += l.k * d * d.transpose();
  }
  return out;
}

inline Standing Legs::find_standing() const {
  double lowest = 0, farthest = sag;
  for (const Leg& l : legs()) {
    lowest = std::max(lowest, l.r_b.z());
    farthest = std::max(farthest, l.r_b.norm());
  }
  Eigen::Vector3d s(lowest, 0, 0);
  Slopes now = slopes(s);
  double damp = weight_ / sag;
  const Eigen::Vector3d scale(1, farthest, farthest);
  const auto found = [&] { return now.gradient.cwiseQuotient(scale).norm() < 1e-6 * weight_; };
  for (int i = 0; i < 500 && !found(); ++i) {
    Eigen::Matrix3d H = now.hessian;
    H.diagonal() += damp * scale.cwiseAbs2();
    const Eigen::Vector3d next = s - H.fullPivLu().solve(now.gradient);
    const Slopes there = slopes(next);
    const bool better = there.energy <= now.energy && std::abs(next(1)) < 1.5 && std::abs(next(2)) < 1.5;
    damp *= better ? 0.3 : 4;
    if (!better) continue;
    s = next;
    now = there;
  }
  Standing out;
  out.found = found();
  out.height_m = s(0);
  out.tilt =
      Eigen::AngleAxisd(s(1), Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(s(2), Eigen::Vector3d::UnitX());
  return out;
}

}  // namespace fulmar::sim
