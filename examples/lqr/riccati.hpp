// SPDX-License-Identifier: BSD-3-Clause
// The stabilising solution of A'X + XA - XGX + Q = 0, G = B R^-1 B', by a structure-preserving doubling
// algorithm: Chu, Fan & Lin, Linear Algebra and its Applications 396 (2005) 55-80, equations (9) and
// (11)-(13). Fixed sizes: nothing is allocated.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

/// Product, coefficient by coefficient: Eigen's kernels for large matrices take half a minute to compile.
template <class L, class R>
Eigen::Matrix<double, L::RowsAtCompileTime, R::ColsAtCompileTime> times(const L& a, const R& b) {
  return a.lazyProduct(b);
}

/// Returns true if the solution was found. `A`, `B` must be stabilisable, `Q` and `R` symmetric and positive
/// definite.
template <int n, int m>
bool riccati(const Eigen::Matrix<double, n, n>& A, const Eigen::Matrix<double, n, m>& B,
             const Eigen::Matrix<double, n, n>& Q, const Eigen::Matrix<double, m, m>& R,
             Eigen::Matrix<double, n, n>& X) {
  using Square = Eigen::Matrix<double, n, n>;
  const auto inverse = [](const Square& M) -> Square { return M.partialPivLu().inverse(); };
  const Eigen::Matrix<double, m, n> Bt = B.transpose();
  const Square I = Square::Identity(), G = times(B, times(R.inverse().eval(), Bt));
  const double gamma = 2.4;
  const Square C = inverse(A - gamma * I);  // A_gamma^-1
  const Square V =
      inverse((A - gamma * I).transpose() + times(Q, times(C, G)));  // (A_gamma' + H A_gamma^-1 G)^-1
  Square Ak = I + 2 * gamma * V.transpose();
  Square Gk = 2 * gamma * times(C, times(G, V));
  X = 2 * gamma * times(V, times(Q, C));
  for (int k = 0; k < 40; ++k) {
    const Square Y = inverse(I + times(Gk, X)), AkY = times(Ak, Y), At = Ak.transpose(), before = X;
    X += times(times(At, X), times(Y, Ak));
    Gk += times(times(AkY, Gk), At);
    Ak = times(AkY, Ak);
    X = 0.5 * (X + X.transpose()).eval();
    Gk = 0.5 * (Gk + Gk.transpose()).eval();
    if ((X - before).norm() < 1e-13 * X.norm()) return X.allFinite();
  }
  return false;
}
