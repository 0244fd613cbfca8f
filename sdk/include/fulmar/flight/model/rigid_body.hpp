// SPDX-License-Identifier: BSD-3-Clause
// Six degrees of freedom over flat ground: a rigid body in NED, advanced by the classical fourth-order
// Runge-Kutta method with loads at each of its four stages. Source: Beard & McLain (3.14)-(3.17), with the
// velocity in NED and the attitude as a quaternion.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace fulmar {

/// Position and velocity of the centre of gravity in NED, attitude (body to NED), body rate. `S` is double,
/// or Dual for derivatives.
template <class S>
struct RigidBodyOf {
  Eigen::Vector3<S> p_n = Eigen::Vector3<S>::Zero();
  Eigen::Vector3<S> v_n = Eigen::Vector3<S>::Zero();
  Eigen::Quaternion<S> q_nb = Eigen::Quaternion<S>::Identity();
  Eigen::Vector3<S> omega_b = Eigen::Vector3<S>::Zero();
};
using RigidBody = RigidBodyOf<double>;

/// Force without gravity, and moment about the centre of gravity, body axes.
template <class S>
struct LoadOf {
  Eigen::Vector3<S> force_b = Eigen::Vector3<S>::Zero();   ///< N
  Eigen::Vector3<S> moment_b = Eigen::Vector3<S>::Zero();  ///< N m
};
using Load = LoadOf<double>;

/// Mass, kg, and inertia about the centre of gravity in body axes, kg m2.
struct MassProperties {
  MassProperties(double mass_kg, const Eigen::Matrix3d& inertia_kgm2)
      : mass(mass_kg), J(inertia_kgm2), J_inverse(inertia_kgm2.inverse()) {}
  double mass;
  Eigen::Matrix3d J, J_inverse;
};

/// Algebra of a step, coefficient by coefficient. Eigen loads two doubles at once, which wait for the single
/// stores before them, and took half of a step. The order of the sums is that of Eigen with two doubles a
/// register, so that older flights are reproduced to the bit.
namespace plain {

/// a x b.
template <class S>
Eigen::Vector3<S> cross(const Eigen::Vector3<S>& a, const Eigen::Vector3<S>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// A v.
template <class S, class T>
Eigen::Vector3<S> product(const Eigen::Matrix3<T>& A, const Eigen::Vector3<S>& v) {
  return {A(0, 0) * v.x() + A(0, 1) * v.y() + A(0, 2) * v.z(),
          A(1, 0) * v.x() + A(1, 1) * v.y() + A(1, 2) * v.z(),
          A(2, 0) * v.x() + (A(2, 1) * v.y() + A(2, 2) * v.z())};
}

/// Body to NED.
template <class S>
Eigen::Vector3<S> rotated(const Eigen::Quaternion<S>& q, const Eigen::Vector3<S>& v) {
  const S tx = 2 * q.x(), ty = 2 * q.y(), tz = 2 * q.z();
  const S wx = tx * q.w(), wy = ty * q.w(), wz = tz * q.w();
  const S xx = tx * q.x(), xy = ty * q.x(), xz = tz * q.x();
  const S yy = ty * q.y(), yz = tz * q.y(), zz = tz * q.z();
  return {(1 - (yy + zz)) * v.x() + (xy - wz) * v.y() + (xz + wy) * v.z(),
          (xy + wz) * v.x() + (1 - (xx + zz)) * v.y() + (yz - wx) * v.z(),
          (xz - wy) * v.x() + ((yz + wx) * v.y() + (1 - (xx + yy)) * v.z())};
}

/// NED to body.
template <class S>
Eigen::Vector3<S> rotated_back(const Eigen::Quaternion<S>& q, const Eigen::Vector3<S>& v) {
  const Eigen::Vector3<S> axis(-q.x(), -q.y(), -q.z()), c = cross<S>(axis, v);
  const Eigen::Vector3<S> twice(c.x() + c.x(), c.y() + c.y(), c.z() + c.z()), d = cross<S>(axis, twice);
  return {v.x() + q.w() * twice.x() + d.x(), v.y() + q.w() * twice.y() + d.y(),
          v.z() + q.w() * twice.z() + d.z()};
}

/// Euclidean length.
template <class S>
S norm(const Eigen::Vector3<S>& v) {
  using std::sqrt;
  return sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
}

}  // namespace plain

/// Time derivative of RigidBodyOf: m/s, m/s2, 1/s, rad/s2.
template <class S>
struct RigidBodyRateOf {
  Eigen::Vector3<S> p_n, v_n;
  Eigen::Vector4<S> q_nb;  ///< x y z w, Eigen's order
  Eigen::Vector3<S> omega_b;
};
using RigidBodyRate = RigidBodyRateOf<double>;

/// Beard & McLain (3.14)-(3.17). `g_n` is the acceleration of gravity, NED.
template <class S>
RigidBodyRateOf<S> rate_of(const RigidBodyOf<S>& x, const LoadOf<S>& load, const MassProperties& body,
                           const Eigen::Vector3d& g_n) {
  const auto& q = x.q_nb;
  const auto& w = x.omega_b;
  RigidBodyRateOf<S> d;
  d.p_n = x.v_n;
  const Eigen::Vector3<S> a = plain::rotated<S>(
      q, {load.force_b.x() / body.mass, load.force_b.y() / body.mass, load.force_b.z() / body.mass});
  d.v_n = {a.x() + g_n.x(), a.y() + g_n.y(), a.z() + g_n.z()};
  d.q_nb = {0.5 * (q.w() * w.x() + q.y() * w.z() - q.z() * w.y()),
            0.5 * (q.w() * w.y() + q.z() * w.x() - q.x() * w.z()),
            0.5 * (q.w() * w.z() + q.x() * w.y() - q.y() * w.x()),
            -0.5 * (q.x() * w.x() + q.y() * w.y() + q.z() * w.z())};
  const Eigen::Vector3<S> turned = plain::cross<S>(w, plain::product<S>(body.J, w));
  d.omega_b = plain::product<S>(
      body.J_inverse,
      {load.moment_b.x() - turned.x(), load.moment_b.y() - turned.y(), load.moment_b.z() - turned.z()});
  return d;
}

/// One Euler step of `dt`, s. The quaternion is not normalised.
inline RigidBody advanced(const RigidBody& x, const RigidBodyRate& d, double dt) {
  RigidBody y;
  y.p_n = x.p_n + dt * d.p_n;
  y.v_n = x.v_n + dt * d.v_n;
  y.q_nb.coeffs() = x.q_nb.coeffs() + dt * d.q_nb;
  y.omega_b = x.omega_b + dt * d.omega_b;
  return y;
}

/// One step. `first` is the load at the present state; `load_at(state, part)` returns it at a later stage, at
/// the fraction `part` of the step: 0.5 or 1. Quaternions of the stages are not normalised, with an error of
/// the order of the method; the result is. `g_n` is the acceleration of gravity, or another argument of
/// `rate_of`, such as the rotating Earth of round_earth.hpp.
template <class Gravity = Eigen::Vector3d, class LoadAt>
RigidBody runge_kutta(const RigidBody& x, const Load& first, double dt, const MassProperties& body,
                      const Gravity& g_n, LoadAt&& load_at) {
  const RigidBodyRate k1 = rate_of(x, first, body, g_n);
  const RigidBody x2 = advanced(x, k1, 0.5 * dt);
  const RigidBodyRate k2 = rate_of(x2, load_at(x2, 0.5), body, g_n);
  const RigidBody x3 = advanced(x, k2, 0.5 * dt);
  const RigidBodyRate k3 = rate_of(x3, load_at(x3, 0.5), body, g_n);
  const RigidBody x4 = advanced(x, k3, dt);
  const RigidBodyRate k4 = rate_of(x4, load_at(x4, 1.0), body, g_n);
  RigidBody y;
  y.p_n = x.p_n + dt / 6 * (k1.p_n + 2 * (k2.p_n + k3.p_n) + k4.p_n);
  y.v_n = x.v_n + dt / 6 * (k1.v_n + 2 * (k2.v_n + k3.v_n) + k4.v_n);
  y.q_nb.coeffs() = x.q_nb.coeffs() + dt / 6 * (k1.q_nb + 2 * (k2.q_nb + k3.q_nb) + k4.q_nb);
  y.omega_b = x.omega_b + dt / 6 * (k1.omega_b + 2 * (k2.omega_b + k3.omega_b) + k4.omega_b);
  y.q_nb.normalize();
  return y;
}

}  // namespace fulmar
