// SPDX-License-Identifier: BSD-3-Clause
// Vectors with their frame in the type: north-east-down or body; the compiler rejects a mixture.
//
// Plain numbers without Eigen, because Eigen takes longer to compile than the rest of the SDK. An algorithm
// with matrices includes fulmar/eigen.hpp: `eigen()` converts its inputs, `from_eigen` its results.
#pragma once
#include <type_traits>

namespace Eigen {
template <typename Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
class Matrix;
template <typename Scalar, int Options>
class Quaternion;
}  // namespace Eigen

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

/// Attitude: rotates body components into NED components. Unit quaternion, scalar first.
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

template <class Frame>
constexpr Vec3<Frame> operator+(const Vec3<Frame>& a, const Vec3<Frame>& b) {
  const auto& [a0, a1, a2] = a;
  const auto& [b0, b1, b2] = b;
  return {a0 + b0, a1 + b1, a2 + b2};
}
template <class Frame>
constexpr Vec3<Frame> operator-(const Vec3<Frame>& a, const Vec3<Frame>& b) {
  const auto& [a0, a1, a2] = a;
  const auto& [b0, b1, b2] = b;
  return {a0 - b0, a1 - b1, a2 - b2};
}
namespace detail {
template <class A, class B>
constexpr Vec3<A> mixed_frames() {
  static_assert(std::is_same_v<A, B>,
                "a vector in NED and one in body axes do not add: turn one of them first, to_ned(q, v) or "
                "to_body(q, v)");
  return {};
}
}  // namespace detail
template <class A, class B>
constexpr Vec3<A> operator+(const Vec3<A>&, const Vec3<B>&) {
  return detail::mixed_frames<A, B>();
}
template <class A, class B>
constexpr Vec3<A> operator-(const Vec3<A>&, const Vec3<B>&) {
  return detail::mixed_frames<A, B>();
}
template <class Frame>
constexpr Vec3<Frame> operator*(double k, const Vec3<Frame>& v) {
  const auto& [v0, v1, v2] = v;
  return {k * v0, k * v1, k * v2};
}

namespace detail {
/// q v q* by two cross products: v + 2 w (u x v) + 2 u x (u x v) with u the vector part; `sign` -1 is the
/// inverse rotation.
template <class To, class From>
constexpr Vec3<To> rotated(const Quat& q, double sign, const Vec3<From>& v) {
  const auto& [v0, v1, v2] = v;
  const double u0 = sign * q.x, u1 = sign * q.y, u2 = sign * q.z;
  const double s0 = u1 * v2 - u2 * v1, s1 = u2 * v0 - u0 * v2, s2 = u0 * v1 - u1 * v0;
  const double t0 = s0 + s0, t1 = s1 + s1, t2 = s2 + s2;
  return {v0 + q.w * t0 + (u1 * t2 - u2 * t1), v1 + q.w * t1 + (u2 * t0 - u0 * t2),
          v2 + q.w * t2 + (u0 * t1 - u1 * t0)};
}
}  // namespace detail

/// Rotation by an attitude: `to_ned(q, v_body)`, `to_body(q, v_ned)`.
constexpr Vec3<Ned> to_ned(const Quat& q, const Vec3<Body>& v) { return detail::rotated<Ned>(q, 1, v); }
constexpr Vec3<Body> to_body(const Quat& q, const Vec3<Ned>& v) { return detail::rotated<Body>(q, -1, v); }

// ---- conversion to Eigen
// Templates, so that only their users need Eigen.

namespace detail {
using EigenVector3 = Eigen::Matrix<double, 3, 1, 0, 3, 1>;
using EigenQuaternion = Eigen::Quaternion<double, 0>;

template <class E>
constexpr bool eigen_is_there() {
  constexpr bool there = requires { sizeof(E); };
  static_assert(there, "eigen() and from_eigen() need Eigen: #include \"fulmar/eigen.hpp\"");
  return there;
}
}  // namespace detail

template <class Frame, class Vector3d = detail::EigenVector3>
auto eigen(const Vec3<Frame>& v) {
  if constexpr (detail::eigen_is_there<Vector3d>()) {
    const auto& [v0, v1, v2] = v;
    return Vector3d(v0, v1, v2);
  }
}
template <class Quaterniond = detail::EigenQuaternion>
auto eigen(const Quat& q) {
  if constexpr (detail::eigen_is_there<Quaterniond>()) return Quaterniond(q.w, q.x, q.y, q.z);
}
/// `from_eigen<Ned>(v)`: the author states the frame once, at the end of the algorithm.
template <class Frame, class Vector3d = detail::EigenVector3>
Vec3<Frame> from_eigen(const std::type_identity_t<Vector3d>& v) {
  return {v.x(), v.y(), v.z()};
}
template <class Quaterniond = detail::EigenQuaternion>
Quat from_eigen(const std::type_identity_t<Quaterniond>& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace fulmar
