// SPDX-License-Identifier: BSD-3-Clause
// Ellipsoid through the readings of a magnetometer that was turned all ways: hard iron is its centre, soft iron its shape.
// Start: linear least squares of a quadric with fixed trace. Then geometric: Gauss-Newton on the distances | |L (m - b)| - 1 |, with
// Huber's weights against outliers (Huber, "Robust estimation of a location parameter", 1964).
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace fulmar::fcu {

struct EllipsoidFit {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();       ///< b, in the unit of the samples
  Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();  ///< A, symmetric, determinant 1: |A (m - b)| is `field`
  double field = 0;                                     ///< geometric mean of the radii
  double residual_ratio = 0;                            ///< rms of | |A (m - b)| - field | / field
  double uncertainty_ratio = 0;                         ///< standard deviation of b, over field; of A likewise: the larger
  double coverage_ratio = 0;                            ///< of 24 parts of the sphere: those that hold a sample
  double stretch_ratio = 0;                             ///< longest radius over shortest
  std::string fault;                                    ///< why there is no fit; "" when there is one
  bool ok() const { return fault.empty(); }
};

namespace fit_detail {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Points = std::vector<Eigen::Vector3d>;

/// |L (u - c)| = 1, L symmetric.
struct Shape {
  Eigen::Matrix3d L = Eigen::Matrix3d::Identity();
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
};

/// x2 + y2 + z2 = p0 (x2 + y2 - 2 z2) + p1 (x2 - 2 y2 + z2) + 2 p2 xy + 2 p3 xz + 2 p4 yz + 2 p5 x + 2 p6 y + 2 p7 z + p8
inline bool quadric(const Points& points, Shape& out) {
  Eigen::MatrixXd D(static_cast<Eigen::Index>(points.size()), 9);
  Eigen::VectorXd d(D.rows());
  for (Eigen::Index i = 0; i < D.rows(); ++i) {
    const Eigen::Vector3d& u = points[static_cast<std::size_t>(i)];
    const double x = u.x(), y = u.y(), z = u.z();
    D.row(i) << x * x + y * y - 2 * z * z, x * x - 2 * y * y + z * z, 2 * x * y, 2 * x * z, 2 * y * z, 2 * x, 2 * y, 2 * z, 1;
    d(i) = u.squaredNorm();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(D);
  if (qr.rank() < 9) return false;
  const Vector9 p = qr.solve(d);
  Eigen::Matrix3d Q;
  Q << 1 - p(0) - p(1), -p(2), -p(3), -p(2), 1 - p(0) + 2 * p(1), -p(4), -p(3), -p(4), 1 + 2 * p(0) - p(1);
  const Eigen::Vector3d g = p.segment<3>(5);
  out.c = Q.fullPivLu().solve(g);
  const double size = p(8) + out.c.dot(g);  // (u - c)' Q (u - c) = size
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Q / size);
  if (!(eigen.eigenvalues().minCoeff() > 1e-6)) return false;
  out.L = eigen.operatorSqrt();
  return true;
}

/// One Gauss-Newton step on L (xx, yy, zz, xy, xz, yz) and c. Returns its size; `rms` and `information` are those before it.
inline double improve(const Points& points, Shape& s, double& rms, Matrix9& information) {
  Matrix9 H = Matrix9::Zero();
  Vector9 b = Vector9::Zero();
  double sum = 0, weights = 0;
  const double huber = std::max(3 * rms, 1e-6);
  for (const Eigen::Vector3d& u : points) {
    const Eigen::Vector3d d = u - s.c, q = s.L * d, n = q.normalized();
    const double r = q.norm() - 1, w = std::fabs(r) <= huber ? 1 : huber / std::fabs(r);
    Vector9 J;
    J << n.x() * d.x(), n.y() * d.y(), n.z() * d.z(), n.x() * d.y() + n.y() * d.x(), n.x() * d.z() + n.z() * d.x(),
        n.y() * d.z() + n.z() * d.y(), -(s.L * n);
    H += w * J * J.transpose();
    b -= w * r * J;
    sum += w * r * r;
    weights += w;
  }
  information = H;
  rms = std::sqrt(sum / weights);
  const Vector9 step = H.ldlt().solve(b);
  if (!step.allFinite()) return 1e9;
  Eigen::Matrix3d dL;
  dL << step(0), step(3), step(4), step(3), step(1), step(5), step(4), step(5), step(2);
  s.L += dL;
  s.c += step.segment<3>(6);
  return step.norm();
}

/// Which of 24 parts of the sphere: the face of a cube that it looks through, and the quarter of that face.
inline int part_of_sphere(const Eigen::Vector3d& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  const int quarter = (v((axis + 1) % 3) > 0 ? 1 : 0) + (v((axis + 2) % 3) > 0 ? 2 : 0);
  return (axis * 2 + (v(axis) > 0 ? 1 : 0)) * 4 + quarter;
}

inline double coverage(const Points& points, const Shape& s) {
  std::array<bool, 24> seen{};
  for (const Eigen::Vector3d& u : points) seen[static_cast<std::size_t>(part_of_sphere(s.L * (u - s.c)))] = true;
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / static_cast<double>(seen.size());
}

inline bool refine(const Points& points, Shape& s, double& rms, Matrix9& information) {
  rms = 1;
  for (int i = 0; i < 50; ++i)
    if (improve(points, s, rms, information) < 1e-10) return true;
  return false;
}

}  // namespace fit_detail

/// The ellipsoid of at least 50 samples. Quality is the caller's to judge, but for a shape that is none.
inline EllipsoidFit fit_ellipsoid(const std::vector<Eigen::Vector3d>& samples) {
  using namespace fit_detail;
  EllipsoidFit out;
  const auto failed = [&](const char* why) {
    out.fault = why;
    return out;
  };
  if (samples.size() < 50) return failed("fewer than 50 samples");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& m : samples) mean += m / static_cast<double>(samples.size());
  double square = 0;
  for (const Eigen::Vector3d& m : samples) square += (m - mean).squaredNorm() / static_cast<double>(samples.size());
  const double scale = std::sqrt(square);  // well conditioned whatever the unit
  if (!(scale > 0) || !std::isfinite(scale)) return failed("the samples are all the same, or not finite");
  Points points;
  for (const Eigen::Vector3d& m : samples) points.push_back((m - mean) / scale);
  Shape s;
  double rms = 0;
  Matrix9 information;
  if (!quadric(points, s) || !refine(points, s, rms, information)) return failed("the samples lie on no ellipsoid");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(s.L);
  if (!(eigen.eigenvalues().minCoeff() > 0.05) || !s.c.allFinite()) return failed("the samples lie on no ellipsoid");
  const double size = std::cbrt(s.L.determinant());
  out.shape = s.L / size;
  out.field = scale / size;
  out.bias = mean + scale * s.c;
  out.residual_ratio = rms;
  out.stretch_ratio = eigen.eigenvalues().maxCoeff() / eigen.eigenvalues().minCoeff();
  out.coverage_ratio = coverage(points, s);
  // perfect samples do not make a perfect fit: half a per cent is what a sensor does at best
  const Matrix9 covariance = std::pow(std::max(rms, 0.005), 2) * information.inverse();
  const double of_bias = std::sqrt((s.L * covariance.bottomRightCorner<3, 3>() * s.L).trace());
  const double of_shape = std::sqrt(covariance.topLeftCorner<6, 6>().trace()) / s.L.norm();
  out.uncertainty_ratio = std::max(of_bias, of_shape);
  if (!std::isfinite(out.uncertainty_ratio)) return failed("the samples do not tell the ellipsoid's shape");
  return out;
}

}  // namespace fulmar::fcu
