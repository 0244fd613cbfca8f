// SPDX-License-Identifier: BSD-3-Clause
// See ellipsoid_fit.hpp.
#include "tools/fulmar_fcu/ellipsoid_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fulmar::fcu {

namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Points = std::vector<Eigen::Vector3d>;
using Eigen3 = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/// |L (u - c)| = 1, L symmetric.
struct Shape {
  Eigen::Matrix3d L = Eigen::Matrix3d::Identity();
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
};

/// Inverse of a symmetric matrix without negative eigenvalues. Returns false when the smallest one is below
/// rounding: the result is then the inverse without it.
bool invert(const Matrix9& A, Matrix9& out) {
  const Eigen::LDLT<Matrix9> ldlt(A);
  const Vector9 pivots = ldlt.vectorD();
  out = ldlt.solve(Matrix9::Identity());
  return pivots.minCoeff() > 1e-14 * pivots.maxCoeff();
}

/// x2 + y2 + z2 = p0 (x2 + y2 - 2 z2) + p1 (x2 - 2 y2 + z2) + 2 p2 xy + 2 p3 xz + 2 p4 yz + 2 p5 x + 2 p6 y +
/// 2 p7 z + p8, by the normal equations. The geometric fit that starts here corrects their rounding errors.
bool quadric(const Points& points, Shape& out) {
  Matrix9 N = Matrix9::Zero(), inverse;
  Vector9 r = Vector9::Zero();
  for (const Eigen::Vector3d& u : points) {
    const double x = u.x(), y = u.y(), z = u.z();
    Vector9 row;
    row << x * x + y * y - 2 * z * z, x * x - 2 * y * y + z * z, 2 * x * y, 2 * x * z, 2 * y * z, 2 * x,
        2 * y, 2 * z, 1;
    N += row * row.transpose();
    r += u.squaredNorm() * row;
  }
  if (!invert(N, inverse)) return false;
  const Vector9 p = inverse * r;
  Eigen::Matrix3d Q;
  Q << 1 - p(0) - p(1), -p(2), -p(3), -p(2), 1 - p(0) + 2 * p(1), -p(4), -p(3), -p(4), 1 + 2 * p(0) - p(1);
  const Eigen3 eigen(Q);
  const Eigen::Matrix3d& V = eigen.eigenvectors();
  const Eigen::Vector3d& lambda = eigen.eigenvalues();
  const Eigen::Vector3d g = p.segment<3>(5);
  out.c = V * (V.transpose() * g).cwiseQuotient(lambda);
  const double size = p(8) + out.c.dot(g);  // (u - c)' Q (u - c) = size
  if (!((lambda / size).minCoeff() > 1e-6)) return false;
  out.L = V * (lambda / size).cwiseSqrt().asDiagonal() * V.transpose();
  return true;
}

/// One Gauss-Newton step on L (xx, yy, zz, xy, xz, yz) and c. Returns its size. `rms` and `covariance` (over
/// the variance of one sample) are those before the step.
double improve(const Points& points, Shape& s, double& rms, Matrix9& covariance) {
  Matrix9 H = Matrix9::Zero();
  Vector9 b = Vector9::Zero();
  double sum = 0, weights = 0;
  const double huber = std::max(3 * rms, 1e-6);
  for (const Eigen::Vector3d& u : points) {
    const Eigen::Vector3d d = u - s.c, q = s.L * d, n = q.normalized();
    const double r = q.norm() - 1, w = std::fabs(r) <= huber ? 1 : huber / std::fabs(r);
    Vector9 J;
    J << n.x() * d.x(), n.y() * d.y(), n.z() * d.z(), n.x() * d.y() + n.y() * d.x(),
        n.x() * d.z() + n.z() * d.x(), n.y() * d.z() + n.z() * d.y(), -(s.L * n);
    H += w * J * J.transpose();
    b -= w * r * J;
    sum += w * r * r;
    weights += w;
  }
  rms = std::sqrt(sum / weights);
  const bool reported = invert(H, covariance);
  const Vector9 step = covariance * b;
  if (!reported) covariance.setConstant(std::numeric_limits<double>::infinity());
  if (!step.allFinite()) return 1e9;
  Eigen::Matrix3d dL;
  dL << step(0), step(3), step(4), step(3), step(1), step(5), step(4), step(5), step(2);
  s.L += dL;
  s.c += step.segment<3>(6);
  return step.norm();
}

/// Index of the 24 parts of the sphere: the face of a cube in this direction, and the quarter of that face.
int part_of_sphere(const Eigen::Vector3d& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  const int quarter = (v((axis + 1) % 3) > 0 ? 1 : 0) + (v((axis + 2) % 3) > 0 ? 2 : 0);
  return (axis * 2 + (v(axis) > 0 ? 1 : 0)) * 4 + quarter;
}

double coverage(const Points& points, const Shape& s) {
  std::array<bool, 24> seen{};
  for (const Eigen::Vector3d& u : points)
    seen[static_cast<std::size_t>(part_of_sphere(s.L * (u - s.c)))] = true;
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / static_cast<double>(seen.size());
}

bool refine(const Points& points, Shape& s, double& rms, Matrix9& covariance) {
  rms = 1;
  for (int i = 0; i < 50; ++i)
    if (improve(points, s, rms, covariance) < 1e-10) return true;
  return false;
}

/// Origin and unit of the samples, for good conditioning in any unit.
struct Scale {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double size = 0;
};

Scale scale_of(const Points& samples) {
  Scale out;
  for (const Eigen::Vector3d& m : samples) out.mean += m / static_cast<double>(samples.size());
  double square = 0;
  for (const Eigen::Vector3d& m : samples)
    square += (m - out.mean).squaredNorm() / static_cast<double>(samples.size());
  out.size = std::sqrt(square);
  return out;
}

double uncertainty(const Shape& s, const Matrix9& covariance) {
  const double of_bias = std::sqrt((s.L * covariance.bottomRightCorner<3, 3>() * s.L).trace());
  const double of_shape = std::sqrt(covariance.topLeftCorner<6, 6>().trace()) / s.L.norm();
  return std::max(of_bias, of_shape);
}

EllipsoidFit failed(const char* why) {
  EllipsoidFit out;
  out.fault = why;
  return out;
}

}  // namespace

EllipsoidFit fit_ellipsoid(const std::vector<Vector3>& samples) {
  if (samples.size() < 50) return failed("fewer than 50 samples");
  Points points;
  for (const Vector3& m : samples) points.emplace_back(m[0], m[1], m[2]);
  const Scale scale = scale_of(points);
  if (!(scale.size > 0) || !std::isfinite(scale.size))
    return failed("the samples are all the same, or not finite");
  for (Eigen::Vector3d& u : points) u = (u - scale.mean) / scale.size;
  Shape s;
  double rms = 0;
  Matrix9 covariance;
  if (!quadric(points, s) || !refine(points, s, rms, covariance))
    return failed("the samples lie on no ellipsoid");
  const Eigen::Vector3d lambda = Eigen3(s.L).eigenvalues();
  if (!(lambda.minCoeff() > 0.05) || !s.c.allFinite()) return failed("the samples lie on no ellipsoid");
  const double size = std::cbrt(lambda.prod());
  const Eigen::Vector3d bias = scale.mean + scale.size * s.c;
  EllipsoidFit out;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<std::size_t>(i);
    out.shape[row] = {s.L(i, 0) / size, s.L(i, 1) / size, s.L(i, 2) / size};
    out.bias[row] = bias(i);
  }
  out.field = scale.size / size;
  out.residual_ratio = rms;
  out.stretch_ratio = lambda.maxCoeff() / lambda.minCoeff();
  out.coverage_ratio = coverage(points, s);
  // Perfect samples do not make a perfect fit: half a per cent is the best of a sensor.
  out.uncertainty_ratio = std::max(rms, 0.005) * uncertainty(s, covariance);
  if (!std::isfinite(out.uncertainty_ratio)) return failed("the samples do not tell the ellipsoid's shape");
  return out;
}

}  // namespace fulmar::fcu
