// SPDX-License-Identifier: BSD-3-Clause
// The stabilising solution of A'X + XA - XGX + Q = 0, G = B R^-1 B', by a structure-preserving doubling
// algorithm: Chu, Fan & Lin, Linear Algebra and its Applications 396 (2005) 55-80, equations (9) and
// (11)-(13). Fixed sizes: nothing is allocated.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

/// Whether it was found. `A` and `B` must be stabilisable, `Q` and `R` symmetric and positive definite.
template <int n, int m>
bool riccati(const Eigen::Matrix<double, n, n>& A, const Eigen::Matrix<double, n, m>& B,
             const Eigen::Matrix<double, n, n>& Q, const Eigen::Matrix<double, m, m>& R,
             Eigen::Matrix<double, n, n>& X) {
  using Square = Eigen::Matrix<double, n, n>;
  const Square I = Square::Identity(), G = B * R.inverse() * B.transpose();
  const double gamma = 2.4;
  const Square C = (A - gamma * I).partialPivLu().inverse();  // A_gamma^-1
  const Square W = (A - gamma * I).transpose() + Q * C * G;   // A_gamma' + H A_gamma^-1 G
  const Square V = W.partialPivLu().inverse();
  Square Ak = I + 2 * gamma * V.transpose();
  Square Gk = 2 * gamma * C * G * V;
  X = 2 * gamma * V * Q * C;
  for (int k = 0; k < 40; ++k) {
    const Square Y = (I + Gk * X).partialPivLu().inverse(), before = X;
    X += (Ak.transpose() * X * Y * Ak).eval();
    Gk += (Ak * Y * Gk * Ak.transpose()).eval();
    Ak = (Ak * Y * Ak).eval();
    X = 0.5 * (X + X.transpose()).eval();
    Gk = 0.5 * (Gk + Gk.transpose()).eval();
    if ((X - before).norm() < 1e-13 * X.norm()) return X.allFinite();
  }
  return false;
}
