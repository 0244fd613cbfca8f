// SPDX-License-Identifier: BSD-3-Clause
// Sloping ground: a plane through the origin. The gear computes in axes of the plane, where the ground is
// flat; forces and moments in body axes are equal in both.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "fulmar/flight/model/rigid_body.hpp"

namespace fulmar::sim {

/// A plane through the origin. Default: level.
class Slope {
 public:
  Slope() = default;
  /// Rises by `angle_rad` towards `towards_rad`, from north, clockwise.
  Slope(double angle_rad, double towards_rad)
      : some_(angle_rad != 0),
        q_(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d(-std::sin(towards_rad), std::cos(towards_rad), 0))) {}

  bool some() const { return some_; }
  /// Normal of the plane, away from the ground, NED.
  Eigen::Vector3d up() const { return q_ * -Eigen::Vector3d::UnitZ(); }
  /// Distance from the plane; positive above it.
  double height(const Eigen::Vector3d& p_n) const { return some_ ? p_n.dot(up()) : -p_n.z(); }

  /// State in the axes of the plane.
  RigidBody seen(const RigidBody& x) const {
    const Eigen::Quaterniond back = q_.conjugate();
    return {back * x.p_n, back * x.v_n, back * x.q_nb, x.omega_b};
  }

  /// State at rest on the plane, with the wheels' centre `height_m` above the ground at this place.
  RigidBody standing(double north_m, double east_m, double heading_rad, double height_m) const {
    const Eigen::Vector3d n = up();
    const auto on_plane = [&](double north, double east) {
      return Eigen::Vector3d(north, east, -(n.x() * north + n.y() * east) / n.z());
    };
    const Eigen::Vector3d ahead = q_.conjugate() * on_plane(std::cos(heading_rad), std::sin(heading_rad));
    RigidBody x;
    x.p_n = on_plane(north_m, east_m) + height_m * n;
    x.q_nb = q_ * Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ());
    return x;
  }

 private:
  bool some_ = false;
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
};

}  // namespace fulmar::sim
