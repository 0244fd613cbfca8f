// SPDX-License-Identifier: BSD-3-Clause
// Conversion between Fulmar's frames (NED, FRD) and those of ROS (ENU, FLU: REP 103), and from flight time to
// stamps.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/plugin.hpp"
#include "ros_messages.hpp"

namespace fulmar::ros_bridge {

// ---- time

constexpr std::int64_t second_ns = 1'000'000'000;

inline RosTime ros_time(std::int64_t utc_ns) {
  std::int64_t sec = utc_ns / second_ns;
  if (sec * second_ns > utc_ns) --sec;
  return {static_cast<std::int32_t>(sec), static_cast<std::uint32_t>(utc_ns - sec * second_ns)};
}

/// UTC of flight times: from the first fix with UTC, else from a parameter. It then stays, so that stamps
/// never jump back.
class Clock {
 public:
  void note(const Optional<Gnss>& gnss, std::int64_t epoch_s) {
    if (known_) return;
    zero_ns_ = epoch_s * second_ns;
    if (!gnss || gnss->utc_ns == 0) return;
    zero_ns_ = gnss->utc_ns - gnss.valid_at_ns();
    known_ = true;
  }
  std::int64_t utc_ns(std::int64_t flight_ns) const { return zero_ns_ + flight_ns; }
  RosHeader header(std::int64_t flight_ns, const RosText& frame) const {
    return {ros_time(utc_ns(flight_ns)), frame};
  }

 private:
  std::int64_t zero_ns_ = 0;
  bool known_ = false;
};

// ---- vectors

inline RosVector3 enu(const Vec3<Ned>& v) { return {v.east, v.north, -v.down}; }
inline RosVector3 flu(const Vec3<Body>& v) { return {v.x, -v.y, -v.z}; }
inline RosPoint enu_point(const Vec3<Ned>& v) { return {v.east, v.north, -v.down}; }
inline Vec3<Ned> ned(const RosPoint& p) { return {p.y, p.x, -p.z}; }

inline RosVector3 as_is(const Vec3<Body>& v) { return {v.x, v.y, v.z}; }
inline RosQuaternion as_is(const Quat& q) { return {q.x, q.y, q.z, q.w}; }

inline RosQuaternion ros(Eigen::Quaterniond q) {
  q.normalize();
  const double sign = q.w() < 0 ? -1 : 1;
  return {sign * q.x(), sign * q.y(), sign * q.z(), sign * q.w()};
}

// NED to ENU and back: half a turn about the horizontal axis between north and east. FRD to FLU and back:
// half a turn about forward.
inline const Eigen::Quaterniond ned_enu{0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0};
inline const Eigen::Quaterniond frd_flu{0, 1, 0, 0};

/// Attitude in the ROS convention: rotates FLU components to ENU components.
inline RosQuaternion enu_flu(const Quat& q_nb) { return ros(ned_enu * eigen(q_nb) * frd_flu); }

/// Horizontal direction: yaw about up, from east, of a course from north, clockwise.
inline RosQuaternion enu_heading(double course_rad) {
  const double yaw = std::numbers::pi / 2 - course_rad;
  return ros(Eigen::Quaterniond(std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)));
}

/// Course, from north, clockwise, of the x axis of an orientation in ENU. Returns false when it points up or
/// down.
inline bool course_of(const RosQuaternion& q, double& course_rad) {
  const double east = 1 - 2 * (q.y * q.y + q.z * q.z), north = 2 * (q.x * q.y + q.w * q.z);
  if (!(std::hypot(east, north) > 1e-3)) return false;
  course_rad = std::atan2(east, north);
  return true;
}

// ---- covariances

/// Puts a 3 x 3 block at row and column `at` of a matrix of `n` columns.
template <std::size_t Size>
void put_block(std::array<double, Size>& matrix, std::size_t n, std::size_t at,
               const Eigen::Matrix3d& block) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      matrix[(at + i) * n + at + k] = block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
}

/// Covariance of standard deviations along north, east, down: the diagonal along east, north, up.
inline Eigen::Matrix3d enu_covariance(const Vec3<Ned>& std) {
  return Eigen::Vector3d(std.east * std.east, std.north * std.north, std.down * std.down).asDiagonal();
}

/// The same, turned into body axes, forward, left, up.
inline Eigen::Matrix3d flu_covariance(const Quat& q_nb, const Vec3<Ned>& std) {
  const Eigen::Matrix3d R_fn = (eigen(q_nb) * frd_flu).conjugate().toRotationMatrix();
  return R_fn *
         Eigen::Vector3d(std.north * std.north, std.east * std.east, std.down * std.down).asDiagonal() *
         R_fn.transpose();
}

inline Eigen::Matrix3d even_covariance(double std) { return std * std * Eigen::Matrix3d::Identity(); }

}  // namespace fulmar::ros_bridge
