// SPDX-License-Identifier: BSD-3-Clause
// Ellipsoid through the readings of a magnetometer that was turned in all directions: hard iron is its
// centre, soft iron its shape. Initial value: linear least squares of a quadric with fixed trace. Then a
// geometric fit: Gauss-Newton on the distances | |L (m - b)| - 1 |, with Huber's weights against outliers
// (Huber, "Robust estimation of a location parameter", 1964).
#pragma once
#include <array>
#include <string>
#include <vector>

namespace fulmar::fcu {

// Without Eigen, so that only ellipsoid_fit.cpp needs the time to compile it.
using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  // rows

inline constexpr Matrix3 identity3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

struct EllipsoidFit {
  Vector3 bias{};                ///< b, in the unit of the samples
  Matrix3 shape = identity3;     ///< A, symmetric, determinant 1: |A (m - b)| is `field`
  double field = 0;              ///< geometric mean of the radii
  double residual_ratio = 0;     ///< rms of | |A (m - b)| - field | / field
  double uncertainty_ratio = 0;  ///< standard deviation of b, over field; of A likewise: the larger
  double coverage_ratio = 0;     ///< share of the 24 parts of the sphere that hold a sample
  double stretch_ratio = 0;      ///< longest radius over shortest
  std::string fault;             ///< reason why there is no fit; "" with one
  bool ok() const { return fault.empty(); }
};

/// Fits an ellipsoid to at least 50 samples. Only a degenerate shape is rejected; the caller judges the
/// quality.
EllipsoidFit fit_ellipsoid(const std::vector<Vector3>& samples);

}  // namespace fulmar::fcu
