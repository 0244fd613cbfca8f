// SPDX-License-Identifier: BSD-3-Clause
// Attitude: 3-2-1 Euler angles, rotation vectors, attitude from two directions. Quaternions turn body into
// NED, scalar first. Sources: Beard & McLain (2012) chapter 2 and appendix B; Sola, Quaternion kinematics for
// the error-state Kalman filter (2017); TRIAD: Black (1964).
//
// Suffixes of vectors and rotations in fulmar/flight and fulmar/sim: _n north, east, down from the origin;
// _b body, forward, right, down from the centre of gravity; _e Earth-centred, Earth-fixed; q_nb and R_nb turn
// body into NED. v_r is the velocity relative to the air in body axes, u_n the same in NED.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fulmar {

/// skew(a) b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// 3-2-1 Euler angles of the attitude q_nb: yaw, then pitch, then roll.
struct Euler {
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
};

inline Eigen::Quaterniond quaternion_from(const Euler& e) {  // B&M (B.6)
  return Eigen::Quaterniond(Eigen::AngleAxisd(e.yaw_rad, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(e.pitch_rad, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(e.roll_rad, Eigen::Vector3d::UnitX()));
}

/// Roll and yaw in +-pi, pitch in +-pi/2. With the nose straight up or down only the sum of roll and yaw is
/// defined: then roll is 0.
inline Euler euler_from(const Eigen::Matrix3d& R_nb) {
  const double s = std::clamp(-R_nb(2, 0), -1.0, 1.0);
  if (std::abs(s) > 1 - 1e-12)
    return {0, std::copysign(std::numbers::pi / 2, s), std::atan2(-R_nb(0, 1), R_nb(1, 1))};
  return {std::atan2(R_nb(2, 1), R_nb(2, 2)), std::asin(s), std::atan2(R_nb(1, 0), R_nb(0, 0))};
}
/// The same for a unit quaternion.
inline Euler euler_from(const Eigen::Quaterniond& q_nb) { return euler_from(q_nb.toRotationMatrix()); }

/// Quaternion of a rotation vector (axis times angle).
inline Eigen::Quaterniond exp_map(const Eigen::Vector3d& rotation_rad) {
  const Eigen::Vector3d half = 0.5 * rotation_rad;
  const double x = half.squaredNorm();
  if (x < 2.5e-3) {  // up to 0.1 rad: series, accurate to 1e-13, without a sine
    const double k = 1 - x / 6 * (1 - x / 20 * (1 - x / 42));
    return {1 - x / 2 * (1 - x / 12 * (1 - x / 30)), k * half.x(), k * half.y(), k * half.z()};
  }
  const double h = std::sqrt(x), k = std::sin(h) / h;
  return {std::cos(h), k * half.x(), k * half.y(), k * half.z()};
}

/// Rotation vector of a quaternion, its length in [0, pi].
inline Eigen::Vector3d log_map(const Eigen::Quaterniond& q) {
  const double n = q.vec().norm();
  const double sign = q.w() < 0 ? -1 : 1;
  const double k = n < 1e-9 ? 2 : 2 * std::atan2(n, sign * q.w()) / n;
  return sign * k * q.vec();
}

/// Attitude that maps the direction `first_b` exactly to `first_n`, and `second_b` as close as possible to
/// `second_n` (TRIAD). The two directions must not be parallel.
inline Eigen::Quaterniond attitude_from_directions(const Eigen::Vector3d& first_b,
                                                   const Eigen::Vector3d& first_n,
                                                   const Eigen::Vector3d& second_b,
                                                   const Eigen::Vector3d& second_n) {
  const auto triad = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Matrix3d m;
    m.col(0) = a.normalized();
    m.col(1) = a.cross(b).normalized();
    m.col(2) = m.col(0).cross(m.col(1));
    return m;
  };
  return Eigen::Quaterniond(Eigen::Matrix3d(triad(first_n, second_n) * triad(first_b, second_b).transpose()));
}

}  // namespace fulmar
