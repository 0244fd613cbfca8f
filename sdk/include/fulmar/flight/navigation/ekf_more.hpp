// SPDX-License-Identifier: BSD-3-Clause
// States that a component appends to those of the filter in ekf.hpp, with all correlations: a bias that only
// its own sensor sees, a scale of the inertial unit. Of the whole P = [Pxx C; C' Pyy] this holds C' and Pyy;
// the filter holds Pxx and moves both by the same equations (augmented states: Groves, Principles of GNSS,
// Inertial and Multisensor Integrated Navigation Systems (2013), section 3.2).
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace fulmar::ekf {

inline constexpr int max_more = 4;  ///< states that can be appended

using MoreVector = Eigen::Matrix<double, max_more, 1>;
using MoreRow = Eigen::Matrix<double, 1, max_more>;
using MoreCovariance = Eigen::Matrix<double, max_more, max_more>;

/// Means of the inertial samples over a step, without biases.
struct Motion {
  double time_s = 0;
  Eigen::Matrix3d R_nb = Eigen::Matrix3d::Identity();
  Eigen::Vector3d rate_b = Eigen::Vector3d::Zero(), force_b = Eigen::Vector3d::Zero();  ///< rad/s, m/s2
};
/// By how much attitude (a rotation about NED, rad), velocity (m/s) and position (m) at the end of a step
/// change per unit of an appended state: its column of the transition.
using Drive = Eigen::Matrix<double, 9, 1> (*)(const Motion&);

/// Model of one appended state.
struct MoreState {
  double std = 1;         ///< before it is learnt, in its unit
  double walk = 0;        ///< unit/sqrt(s): a random walk
  double time_s = 0;      ///< > 0: first-order Gauss-Markov instead, which keeps `std`
  Drive drive = nullptr;  ///< its effect on the motion; null: only measurements depend on it
};

/// Up to `max_more` appended states of a filter with `size` error states: values, covariance, and covariance
/// with the filter.
template <int size>
class MoreStates {
 public:
  /// Returns its index. Throws std::length_error: there is no room for it, or std::invalid_argument.
  int append(const MoreState& s) {
    if (count_ == max_more) throw std::length_error("at most 4 states can be appended to the filter");
    if (!(s.std > 0 && s.walk >= 0 && s.time_s >= 0) || !std::isfinite(s.std + s.walk + s.time_s))
      throw std::invalid_argument("an appended state needs std > 0, walk >= 0 and time_s >= 0");
    models_[static_cast<std::size_t>(count_)] = s;
    set(count_++, 0, s.std);
    return count_ - 1;
  }
  int count() const { return count_; }
  double value(int i) const { return y_(i); }
  double std(int i) const { return std::sqrt(P_(i, i)); }
  const MoreVector& values() const { return y_; }
  const MoreCovariance& covariance() const { return P_; }
  /// Covariance with the filter's own states: a row for each appended one.
  const Eigen::Matrix<double, max_more, size>& cross() const { return C_; }

  /// A new value and standard deviation, without correlation with the rest.
  void set(int i, double value, double std) {
    y_(i) = value;
    C_.row(i).setZero();
    P_.row(i).setZero();
    P_.col(i).setZero();
    P_(i, i) = std * std;
  }
  /// As they were appended.
  void begin_again() {
    for (int i = 0; i < count_; ++i) set(i, 0, models_[static_cast<std::size_t>(i)].std);
  }

  // For the filter.
  void forget(int first, int n) { C_.middleCols(first, n).setZero(); }
  void decay(int first, int n, double phi) {
    if (count_ > 0) C_.middleCols(first, n) *= phi;
  }
  /// P H' of these rows.
  MoreVector project(const Eigen::Matrix<double, 1, size>& H, const MoreRow& more) const {
    return C_ * H.transpose() + P_ * more.transpose();
  }
  /// P <- P - k k' of these rows and columns; `k_more` is theirs.
  void fused(const Eigen::Matrix<double, size, 1>& k, const MoreVector& k_more, double ratio) {
    C_.noalias() -= k_more * k.transpose();
    P_.noalias() -= k_more * k_more.transpose();
    for (int i = 0; i < count_; ++i) P_(i, i) = std::max(P_(i, i), min_variance);
    y_ += k_more * ratio;
  }
  /// The filter's states were moved by the gain K, these were not; `PHt` is P H' of these rows.
  void considered(const Eigen::Matrix<double, size, 1>& K, const MoreVector& PHt) {
    C_.noalias() -= PHt * K.transpose();
  }
  /// With G the columns of the drives and X' = C' Phi': Pxx += G X' + X G' + G Pyy G', C' <- Psi (X' + Pyy
  /// G'), Pyy <- Psi Pyy Psi + Q. `turned` is X' of the states 0 to 8. Returns G y, which moves the state.
  Eigen::Matrix<double, 9, 1> propagate(const Motion& motion,
                                        const Eigen::Matrix<double, max_more, 9>& turned,
                                        Eigen::Matrix<double, size, size>& Pxx) {
    Eigen::Matrix<double, 9, max_more> G = Eigen::Matrix<double, 9, max_more>::Zero();
    for (int i = 0; i < count_; ++i)
      if (const Drive drive = models_[static_cast<std::size_t>(i)].drive) G.col(i) = drive(motion);
    C_.template leftCols<9>() = turned;
    const Eigen::Matrix<double, 9, size> GX = G * C_;
    const Eigen::Matrix<double, 9, 9> square = GX.template leftCols<9>() + 0.5 * G * P_ * G.transpose();
    Pxx.template topLeftCorner<9, 9>() += square + square.transpose();
    Pxx.template topRightCorner<9, size - 9>() += GX.template rightCols<size - 9>();
    Pxx.template bottomLeftCorner<size - 9, 9>() += GX.template rightCols<size - 9>().transpose();
    C_.template leftCols<9>() += P_ * G.transpose();
    const Eigen::Matrix<double, 9, 1> moved = G * y_;
    for (int i = 0; i < count_; ++i) walk(i, motion.time_s);
    return moved;
  }

 private:
  static constexpr double min_variance = 1e-14;

  void walk(int i, double T_s) {
    const MoreState& m = models_[static_cast<std::size_t>(i)];
    const double phi = m.time_s > 0 ? std::exp(-T_s / m.time_s) : 1;
    y_(i) *= phi;
    C_.row(i) *= phi;
    P_.row(i) *= phi;
    P_.col(i) *= phi;
    P_(i, i) += m.time_s > 0 ? m.std * m.std * (1 - phi * phi) : m.walk * m.walk * T_s;
  }

  std::array<MoreState, max_more> models_{};
  int count_ = 0;
  MoreVector y_ = MoreVector::Zero();
  Eigen::Matrix<double, max_more, size> C_ = Eigen::Matrix<double, max_more, size>::Zero();
  MoreCovariance P_ = MoreCovariance::Zero();
};

}  // namespace fulmar::ekf
