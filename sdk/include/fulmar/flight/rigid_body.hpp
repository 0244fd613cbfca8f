// SPDX-License-Identifier: BSD-3-Clause
// Six degrees of freedom over flat ground: a rigid body in NED, advanced by the classical fourth-order
// Runge-Kutta method with the loads evaluated anew at each of its four stages. Source: Beard & McLain
// (3.14)-(3.17), with the velocity in NED and the attitude as a quaternion.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace fulmar {

/// Position and velocity of the centre of gravity in NED, attitude (body to NED), body rate. `S` is double,
/// or Dual where the model is differentiated.
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

struct MassProperties {
  MassProperties(double mass_kg, const Eigen::Matrix3d& inertia_kgm2)
      : mass(mass_kg), J(inertia_kgm2), J_inverse(inertia_kgm2.inverse()) {}
  double mass;
  Eigen::Matrix3d J, J_inverse;
};

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
  d.v_n = q.toRotationMatrix() * (load.force_b / body.mass) + g_n;
  d.q_nb << 0.5 * (q.w() * w.x() + q.y() * w.z() - q.z() * w.y()),
      0.5 * (q.w() * w.y() + q.z() * w.x() - q.x() * w.z()),
      0.5 * (q.w() * w.z() + q.x() * w.y() - q.y() * w.x()),
      -0.5 * (q.x() * w.x() + q.y() * w.y() + q.z() * w.z());
  d.omega_b = body.J_inverse * (load.moment_b - w.cross(body.J * w));
  return d;
}

inline RigidBody advanced(const RigidBody& x, const RigidBodyRate& d, double dt) {
  RigidBody y;
  y.p_n = x.p_n + dt * d.p_n;
  y.v_n = x.v_n + dt * d.v_n;
  y.q_nb.coeffs() = x.q_nb.coeffs() + dt * d.q_nb;
  y.omega_b = x.omega_b + dt * d.omega_b;
  return y;
}

/// One step. `first` is the load at the present state; `load_at(state, part)` gives it at a later stage,
/// `part` of the step on: 0.5 or 1. Quaternions of the stages are not normalised: the error is of the
/// method's order; the result is. `g_n` is the acceleration of gravity, or what else `rate_of` knows, such as
/// the turning Earth of earth.hpp.
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
