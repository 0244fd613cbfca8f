// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/vlm/solver.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "tools/fulmar_aero/vlm/messages.hpp"

namespace fulmar::aero {
namespace {

using Eigen::Vector3d;
enum Basic : int { stream_x, stream_y, stream_z, rate_p, rate_q, rate_r, first_control };
/// The changed quantity: alpha, beta, p, q, r, then the controls.
enum Changed : int { by_alpha, by_beta, by_p, by_q, by_r, by_control };

/// Velocity by a straight vortex of strength 4 pi from a to b, with d = point - a, e = point - b.
inline Vector3d segment(const Vector3d& d, const Vector3d& e) {
  const double D = std::sqrt(d.squaredNorm()), E = std::sqrt(e.squaredNorm());
  const double below = D * E + d.dot(e);
  if (below < 1e-12 * D * E) return Vector3d::Zero();
  return d.cross(e) * ((1 / D + 1 / E) / below);
}

/// The same for a vortex from a to infinity along the unit vector t.
inline Vector3d ray(const Vector3d& d, const Vector3d& t) {
  const double D = std::sqrt(d.squaredNorm()), below = D - d.dot(t);
  if (below < 1e-12 * D) return Vector3d::Zero();
  return t.cross(d) / (D * below);
}

/// Velocity at `point` by a panel's horseshoe of strength 1. `own`: the point lies on its bound vortex.
inline Vector3d horseshoe(const Panel& j, const Vector3d& point, const Vector3d& wake, bool straight,
                          bool own) {
  const Vector3d d = point - j.a, e = point - j.b;
  Vector3d v = own ? Vector3d::Zero() : segment(d, e);
  if (straight) {
    v += ray(e, wake) - ray(d, wake);
  } else {
    const Vector3d far_d(point.x() - j.edge_a, d.y(), d.z()), far_e(point.x() - j.edge_b, e.y(), e.z());
    v += segment(e, far_e) - segment(d, far_d) + ray(far_e, wake) - ray(far_d, wake);
  }
  return v / (4 * pi);
}

Vector3d stream_of(double alpha, double beta) {
  return {std::cos(alpha) * std::cos(beta), -std::sin(beta), std::sin(alpha) * std::cos(beta)};
}

}  // namespace

Vlm::Vlm(const Lattice& lattice, const ReferenceQuantities& reference, const Vector3d& about,
         double wake_alpha)
    : lattice_(lattice), reference_(reference), about_(about), wake_alpha_(wake_alpha) {
  const auto n = Eigen::Index(lattice_.panels.size());
  const Vector3d wake(std::cos(wake_alpha), 0, std::sin(wake_alpha));
  const bool straight = wake_alpha == 0;
  Eigen::MatrixXd influence(n, n);
  for (Eigen::Index col = 0; col < n; ++col) {
    const Panel& j = lattice_.panels[std::size_t(col)];
    for (Eigen::Index row = 0; row < n; ++row) {
      const Panel& i = lattice_.panels[std::size_t(row)];
      influence(row, col) = horseshoe(j, i.control, wake, straight, false).dot(i.normal);
    }
  }
  const Eigen::Index columns = first_control + 3 * Eigen::Index(controls);
  Eigen::MatrixXd right(n, columns);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Panel& i = lattice_.panels[std::size_t(row)];
    const Vector3d arm = i.control - about_;
    right.row(row).segment<3>(stream_x) = -i.normal;
    // the air moves by -omega x r, and body rates are about x forward, z down
    right(row, rate_p) = -arm.cross(-Vector3d::UnitX()).dot(i.normal);
    right(row, rate_q) = -arm.cross(Vector3d::UnitY()).dot(i.normal);
    right(row, rate_r) = -arm.cross(-Vector3d::UnitZ()).dot(i.normal);
    for (std::size_t c = 0; c < controls; ++c)
      right.row(row).segment<3>(first_control + 3 * Eigen::Index(c)) = -i.turned[c];
  }
  circulation_ = Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(influence).solve(right);
  if (!circulation_.allFinite() || circulation_.cwiseAbs().maxCoeff() > 1e6 * reference.span_m)
    throw core::Error(aero_messages::flow_not_solvable());
  for (Eigen::MatrixXd& one : induced_) one.setZero(n, columns);
  Eigen::MatrixXd part(n, 3);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Panel& i = lattice_.panels[std::size_t(row)];
    for (Eigen::Index col = 0; col < n; ++col) {
      const Panel& j = lattice_.panels[std::size_t(col)];
      part.row(col) = horseshoe(j, i.centre, wake, straight, row == col);
    }
    const Eigen::MatrixXd at = part.transpose() * circulation_;
    for (int axis = 0; axis < 3; ++axis) induced_[std::size_t(axis)].row(row) = at.row(axis);
  }
}

Vlm::Basis Vlm::basis(const FlowState& s) const {
  Basis out;
  out.stream = stream_of(s.alpha, s.beta);
  const double b = reference_.span_m, c = reference_.chord_m;
  out.omega = {2 * s.p / b, 2 * s.q / c, 2 * s.r / b};  // V = 1
  out.weight.setZero(circulation_.cols());
  out.weight.segment<3>(stream_x) = out.stream;
  out.weight.segment<3>(rate_p) = out.omega;
  for (std::size_t k = 0; k < controls; ++k)
    out.weight.segment<3>(first_control + 3 * Eigen::Index(k)) = s.deflection[k] * out.stream;
  return out;
}

/// Derivative of the basis by `which`.
Vlm::Basis Vlm::change(const FlowState& s, int which) const {
  Basis out{Eigen::VectorXd::Zero(circulation_.cols()), Vector3d::Zero(), Vector3d::Zero()};
  const double ca = std::cos(s.alpha), sa = std::sin(s.alpha), cb = std::cos(s.beta), sb = std::sin(s.beta);
  if (which == by_alpha) out.stream = Vector3d(-sa * cb, 0, ca * cb);
  if (which == by_beta) out.stream = Vector3d(-ca * sb, -cb, -sa * sb);
  if (which == by_p) out.omega.x() = 2 / reference_.span_m;
  if (which == by_q) out.omega.y() = 2 / reference_.chord_m;
  if (which == by_r) out.omega.z() = 2 / reference_.span_m;
  out.weight.segment<3>(stream_x) = out.stream;
  out.weight.segment<3>(rate_p) = out.omega;
  for (std::size_t k = 0; k < controls; ++k) {
    auto part = out.weight.segment<3>(first_control + 3 * Eigen::Index(k));
    part = s.deflection[k] * out.stream;
    if (which == by_control + int(k)) part += stream_of(s.alpha, s.beta);
  }
  return out;
}

/// With `change` the derivative, else the value.
Six Vlm::coefficients(const Basis& now, const Basis* change, const FlowState& s, int which) const {
  const auto velocities = [&](const Basis& basis) {
    std::array<Eigen::VectorXd, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = induced_[k] * basis.weight;
    return v;
  };
  const auto air = [&](const Basis& basis, const Vector3d& at) {
    const Vector3d omega(-basis.omega.x(), basis.omega.y(), -basis.omega.z());
    return Vector3d(basis.stream - omega.cross(at - about_));
  };
  const Eigen::VectorXd gamma = circulation_ * now.weight;
  const auto v = velocities(now);
  Eigen::VectorXd gamma_change;
  std::array<Eigen::VectorXd, 3> v_change;
  if (change) {
    gamma_change = circulation_ * change->weight;
    v_change = velocities(*change);
  }
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero(), force_change = force;
  const auto add = [&](Eigen::Index k, const Vector3d& at, const Vector3d& along, bool bound) {
    const auto at_vortex = [&](const std::array<Eigen::VectorXd, 3>& all) {
      return bound ? Vector3d(all[0][k], all[1][k], all[2][k]) : Vector3d::Zero();
    };
    const Vector3d across = (air(now, at) + at_vortex(v)).cross(along);
    const Vector3d f = 2 * gamma[k] * across;
    force += f;
    Vector3d counted = f;
    if (change) {
      const Vector3d other = (air(*change, at) + at_vortex(v_change)).cross(along);
      counted = 2 * (gamma_change[k] * across + gamma[k] * other);
      force_change += counted;
    }
    moment += (at - about_).cross(counted);
  };
  for (std::size_t k = 0; k < lattice_.panels.size(); ++k) {
    const Panel& i = lattice_.panels[k];
    add(Eigen::Index(k), i.centre, i.b - i.a, true);
    // its legs are on the surface up to the trailing edge, where the cross flow acts on them
    const Vector3d edge_a(i.edge_a, i.a.y(), i.a.z()), edge_b(i.edge_b, i.b.y(), i.b.z());
    add(Eigen::Index(k), 0.5 * (i.a + edge_a), i.a - edge_a, false);
    add(Eigen::Index(k), 0.5 * (i.b + edge_b), edge_b - i.b, false);
  }
  const double ca = std::cos(s.alpha), sa = std::sin(s.alpha), cb = std::cos(s.beta), sb = std::sin(s.beta);
  const Vector3d lift(-sa, 0, ca), drag = stream_of(s.alpha, s.beta);
  const Vector3d& F = change ? force_change : force;
  Six out{lift.dot(F),
          drag.dot(F),
          F.y(),
          -moment.x() / reference_.span_m,
          moment.y() / reference_.chord_m,
          -moment.z() / reference_.span_m};
  if (change && which == by_alpha) {
    out.CL += Vector3d(-ca, 0, -sa).dot(force);
    out.CD += Vector3d(-sa * cb, 0, ca * cb).dot(force);
  }
  if (change && which == by_beta) out.CD += Vector3d(-ca * sb, -cb, -sa * sb).dot(force);
  for (double* x : {&out.CL, &out.CD, &out.CY, &out.Cl, &out.Cm, &out.Cn}) *x /= reference_.area_m2;
  return out;
}

Six Vlm::forces(const FlowState& state) const { return coefficients(basis(state), nullptr, state, -1); }

SixDerivatives Vlm::derivatives(const FlowState& state) const {
  SixDerivatives out;
  const Basis now = basis(state);
  const auto over = [&](int which) {
    const Basis by = change(state, which);
    return coefficients(now, &by, state, which);
  };
  out.value = coefficients(now, nullptr, state, -1);
  out.alpha = over(by_alpha);
  out.beta = over(by_beta);
  out.p = over(by_p);
  out.q = over(by_q);
  out.r = over(by_r);
  for (std::size_t k = 0; k < controls; ++k)
    if (lattice_.has[k]) out.control[k] = over(by_control + int(k));
  return out;
}

Vlm::FarField Vlm::far_field(const FlowState& state) const {
  const Eigen::VectorXd gamma = circulation_ * basis(state).weight;
  std::vector<double> strip(lattice_.strips.size(), 0.0);
  for (std::size_t k = 0; k < lattice_.panels.size(); ++k)
    strip[std::size_t(lattice_.panels[k].strip)] += gamma[Eigen::Index(k)];
  // in the plane across the wake: y, and the height above the sloped wake
  const double ca = std::cos(wake_alpha_), sa = std::sin(wake_alpha_);
  const auto across = [&](const Vector3d& p) { return Eigen::Vector2d(p.y(), ca * p.z() - sa * p.x()); };
  FarField out;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    const Eigen::Vector2d a = across(lattice_.strips[i].a), b = across(lattice_.strips[i].b),
                          mid = across(lattice_.strips[i].mid);
    Eigen::Vector2d v = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < strip.size(); ++j)
      for (const bool at_b : {false, true}) {
        const Eigen::Vector2d d = mid - across(at_b ? lattice_.strips[j].b : lattice_.strips[j].a);
        // a straight vortex along x with circulation about x: v = Gamma / (2 pi r^2) (-dz, dy)
        const double strength = (at_b ? strip[j] : -strip[j]) / (2 * pi * d.squaredNorm());
        v += strength * Eigen::Vector2d(-d.y(), d.x());
      }
    const Eigen::Vector2d width = b - a;
    out.CL += 2 * strip[i] * width.x() / reference_.area_m2;
    out.CY -= 2 * strip[i] * width.y() / reference_.area_m2;
    out.CD += strip[i] * (v.x() * width.y() - v.y() * width.x()) / reference_.area_m2;
  }
  return out;
}

Eigen::VectorXd Vlm::strip_lift(const FlowState& state) const {
  const Eigen::VectorXd gamma = circulation_ * basis(state).weight;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(lattice_.strips.size()));
  for (std::size_t k = 0; k < lattice_.panels.size(); ++k) {
    const auto strip = std::size_t(lattice_.panels[k].strip);
    out[Eigen::Index(strip)] += 2 * gamma[Eigen::Index(k)] / lattice_.strips[strip].chord;
  }
  return out;
}

}  // namespace fulmar::aero
