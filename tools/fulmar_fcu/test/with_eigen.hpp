// SPDX-License-Identifier: BSD-3-Clause
// The magnetometer's calibration with Eigen's types, for short tests.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "tools/fulmar_fcu/mag_fit.hpp"

namespace fulmar::fcu::test {

inline Vector3 plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Matrix3 rows_of(const Eigen::Matrix3d& A) {
  return {{{A(0, 0), A(0, 1), A(0, 2)}, {A(1, 0), A(1, 1), A(1, 2)}, {A(2, 0), A(2, 1), A(2, 2)}}};
}
inline std::vector<Vector3> plain(const std::vector<Eigen::Vector3d>& all) {
  std::vector<Vector3> out;
  for (const Eigen::Vector3d& v : all) out.push_back(plain(v));
  return out;
}
inline Eigen::Vector3d with_eigen(const Vector3& v) { return {v[0], v[1], v[2]}; }
inline Eigen::Matrix3d with_eigen(const Matrix3& A) {
  Eigen::Matrix3d out;
  out << with_eigen(A[0]).transpose(), with_eigen(A[1]).transpose(), with_eigen(A[2]).transpose();
  return out;
}

struct Fit : EllipsoidFit {
  Eigen::Vector3d bias;
  Eigen::Matrix3d shape;
};
inline Fit fit_ellipsoid(const std::vector<Eigen::Vector3d>& samples) {
  const EllipsoidFit fit = fcu::fit_ellipsoid(plain(samples));
  return {fit, with_eigen(fit.bias), with_eigen(fit.shape)};
}

}  // namespace fulmar::fcu::test
