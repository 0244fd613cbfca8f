// SPDX-License-Identifier: BSD-3-Clause
// Frames in the type: a vector knows whether it is north-east-down or body, and the two do not mix.
// The only bridge to Eigen: `eigen()` inside an algorithm, `from_eigen` at its door.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fulmar {

struct Ned {};   ///< north, east, down; origin and axes of the mission's local frame
struct Body {};  ///< forward, right, down; origin at the centre of gravity

template <class Frame>
struct Vec3;

template <>
struct Vec3<Ned> {
  double north = 0, east = 0, down = 0;
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

template <>
struct Vec3<Body> {
  double x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// Attitude: turns body components into NED components. Unit quaternion, scalar first.
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

inline Eigen::Vector3d eigen(const Vec3<Ned>& v) { return {v.north, v.east, v.down}; }
inline Eigen::Vector3d eigen(const Vec3<Body>& v) { return {v.x, v.y, v.z}; }
inline Eigen::Quaterniond eigen(const Quat& q) { return {q.w, q.x, q.y, q.z}; }

/// `from_eigen<Ned>(v)`: the author states the frame, once, where the algorithm ends.
template <class Frame>
Vec3<Frame> from_eigen(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
inline Quat from_eigen(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

template <class Frame>
Vec3<Frame> operator+(const Vec3<Frame>& a, const Vec3<Frame>& b) {
  return from_eigen<Frame>(eigen(a) + eigen(b));
}
template <class Frame>
Vec3<Frame> operator-(const Vec3<Frame>& a, const Vec3<Frame>& b) {
  return from_eigen<Frame>(eigen(a) - eigen(b));
}
template <class Frame>
Vec3<Frame> operator*(double k, const Vec3<Frame>& v) {
  return from_eigen<Frame>(k * eigen(v));
}

/// Rotation by an attitude: `to_ned(q, v_body)`, `to_body(q, v_ned)`.
inline Vec3<Ned> to_ned(const Quat& q, const Vec3<Body>& v) { return from_eigen<Ned>(eigen(q) * eigen(v)); }
inline Vec3<Body> to_body(const Quat& q, const Vec3<Ned>& v) { return from_eigen<Body>(eigen(q).conjugate() * eigen(v)); }

}  // namespace fulmar
