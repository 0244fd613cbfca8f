// SPDX-License-Identifier: BSD-3-Clause
// One fault rule for all sensors: generalised likelihood ratio of a jump of slow errors (Willsky & Jones,
// IEEE TAC 21(1) (1976)). A fault of a sensor is a jump of the states that model its error. For each such
// state the error that a unit jump at the beginning of a window causes in the estimate is carried through
// prediction and updates; its effect on the innovations, compared with the innovations, gives the size of
// the jump and how much more likely it is than no fault.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bench/second_filter/states.hpp"

namespace fulmar::second_filter {

/// States of one sensor that may jump together, in any direction, or with `ramp` drift by so much in ten
/// seconds; the size from which it is a fault, in the unit of the states.
struct MayJump {
  int first, count;
  double least;
  double after_s;  ///< in a window: a short manoeuvre may look like a fault
  bool ramp = false;
  double doubt = 1;  ///< factor on the likelihood ratio that a fault needs: gusts look like one of the pitot
};
inline constexpr std::array may_jump{MayJump{fix_pos, 2, 4, 0},
                                     MayJump{fix_pos + 2, 1, 8, 0},
                                     MayJump{fix_vel, 2, 1, 0},
                                     MayJump{fix_vel + 2, 1, 1.5, 0},
                                     MayJump{baro_bias, 1, 3, 0},
                                     MayJump{tube_bias, 1, 20, 0, false, 3},
                                     MayJump{theta + 2, 1, 0.1, 3},
                                     MayJump{gyro_bias, 3, 2e-3, 6},
                                     MayJump{accel_bias, 3, 0.15, 1},
                                     MayJump{fix_pos, 2, 3, 6, true},
                                     MayJump{baro_bias, 1, 1, 6, true},
                                     MayJump{tube_bias, 1, 100, 1, true, 1.5},
                                     MayJump{gyro_bias, 3, 5e-4, 12, true}};

/// Where the columns of a jump begin among those of all; of the number of jumps: how many columns there are.
constexpr int column(std::size_t jump) {
  int first = 0;
  for (std::size_t i = 0; i < jump; ++i) first += may_jump[i].count;
  return first;
}

/// A jump that was found.
struct Fault {
  int first = -1;    ///< state; -1: none
  double size = 0;   ///< of one state with its sign, of several their norm
  double ratio = 0;  ///< twice the logarithm of the likelihood ratio
  bool ramp = false;
};

/// The hypotheses over one window.
class Jumps {
 public:
  static constexpr std::size_t count = may_jump.size();
  static constexpr int columns = column(count);
  using PerJump = std::array<double, count>;
  static constexpr double hasty_s = 8;  ///< a window this long asks for twice the likelihood

  explicit Jumps(double window_s) : window_s_(window_s) { begin(0); }
  void begin(double time_s) {
    begun_s_ = time_s;
    errors_.setZero();
    for (std::size_t i = 0; i < count; ++i)
      if (!may_jump[i].ramp)
        errors_.block(may_jump[i].first, column(i), may_jump[i].count, may_jump[i].count).setIdentity();
    sums_ = {};
    striking_ = 0;
  }
  double window_s() const { return window_s_; }
  bool over(double time_s) const { return time_s - begun_s_ > window_s_; }

  /// A scalar update with gain `K`; `S`: variance of the innovation. One beyond `gate` standard deviations
  /// counts for less (Huber), so that a few outliers are no jump.
  void fused(const Row& H, const Vector& K, double innovation, double S, double gate) {
    const double std = std::sqrt(S), r = std::clamp(innovation / std, -wildest, wildest),
                 trust = std::min(gate / std::max(std::abs(r), 1e-30), 1.0);
    Eigen::Matrix<double, 1, columns> effect = Eigen::Matrix<double, 1, columns>::Zero();  // H errors
    for (int i = 0; i < size; ++i)
      if (H(i) != 0) effect.noalias() += H(i) * errors_.row(i);
    if (r * r > striking * striking) striking_ += std::min(r * r, gate * gate);
    for (std::size_t i = 0; i < count; ++i) {
      Three e = Three::Zero();
      for (int k = 0; k < may_jump[i].count; ++k) e(k) = effect(column(i) + k) / std;
      Sums& s = sums_[i];
      const Matrix3d ee = e * e.transpose();
      // Of the fit: an outlier counts as one at the gate there, so that it does not hide a jump.
      const double weight = trust * trust * e.squaredNorm(), evidence = trust * std::abs(r) * e.norm();
      s.information += trust * ee;
      s.seen += trust * r * e;
      s.weight += weight;
      s.evidence += evidence;
      s.concentrated += evidence * evidence;
      s.squares += weight * r * r;
      s.products += weight * r * e;
      s.fourth += weight * ee;
    }
    errors_.noalias() -= K * effect;
  }
  /// As the covariance: B = sum R dt, D = -[dv]x, E = -D B / 2 over the step T.
  void predicted(const Matrix3d& B, const Matrix3d& D, const Matrix3d& E, double T, const Vector& decay) {
    using Rows = Eigen::Matrix<double, 3, columns>;
    const Rows dv = D * errors_.middleRows<3>(theta) - B * errors_.middleRows<3>(accel_bias);
    errors_.middleRows<3>(pos) += T * errors_.middleRows<3>(vel) + 0.5 * T * dv;
    errors_.middleRows<3>(vel) += dv + E * errors_.middleRows<3>(gyro_bias);
    errors_.middleRows<3>(theta) -= B * errors_.middleRows<3>(gyro_bias);
    for (int i = wind; i < size; ++i)
      if (decay(i) != 1) errors_.row(i) *= decay(i);
    for (std::size_t i = 0; i < count; ++i)
      if (may_jump[i].ramp)
        for (int k = 0; k < may_jump[i].count; ++k)
          errors_(may_jump[i].first + k, column(i) + k) += T / ramp_s;
  }

  /// Twice the logarithm of the likelihood ratio, of each jump with its most likely size, over the mean
  /// square of the innovations that it leaves, where that exceeds 1: a motion outside the model is no fault.
  /// Without `unit` the inertial unit is not judged.
  PerJump ratio(double time_s, bool unit) const {
    PerJump ratio{};
    for (std::size_t i = 0; i < count; ++i) {
      const Sums& s = sums_[i];
      if (time_s - begun_s_ < may_jump[i].after_s || (of_unit(may_jump[i].first) && !unit)) continue;
      if (s.evidence * s.evidence <= least_samples * s.concentrated) continue;  // a few samples carry it
      if (explained(i) < 0.5 * striking_) continue;  // less than half of what is odd
      const Three by = sizes(i);
      const double left = (s.squares - 2 * by.dot(s.products) + by.dot(s.fourth * by)) / s.weight;
      if (left < worst_fit) ratio[i] = s.seen.dot(by) / (may_jump[i].doubt * std::max(left, 1.0));
    }
    return ratio;
  }
  /// As Fault::size.
  double size_of(std::size_t i) const {
    const Three by = sizes(i);
    return may_jump[i].count == 1 ? by(0) : by.norm();
  }
  /// Change of the estimate that removes this jump, and the covariance of its size.
  Vector change(std::size_t i) const { return errors_of(i) * sizes(i); }
  Covariance spread(std::size_t i) const {
    const auto e = errors_of(i);
    return e * variance(i) * e.transpose();
  }

 private:
  using Three = Eigen::Vector3d;
  struct Sums {  ///< over the window, of e = H errors / sqrt(S) and the innovation r in standard deviations
    Matrix3d information = Matrix3d::Zero(), fourth = Matrix3d::Zero();  ///< e e', and with its weight
    Three seen = Three::Zero(), products = Three::Zero();                ///< r e, and with its weight
    double weight = 0, squares = 0;                                      ///< |e|^2, and times r^2
    double evidence = 0, concentrated = 0;                               ///< |r e|, and squared
  };
  static constexpr double least_samples = 8, ramp_s = 10, striking = 3, wildest = 1e3,
                          worst_fit = 4;  ///< mean square of the innovations that a jump may leave
  static constexpr double largest = 100;  ///< standard deviation of a jump, in its least sizes

  static constexpr bool of_unit(int state) { return state == gyro_bias || state == accel_bias; }

  Matrix3d variance(std::size_t i) const {
    const double prior = 1 / (largest * may_jump[i].least);
    return (sums_[i].information + prior * prior * Matrix3d::Identity()).inverse();
  }
  Three sizes(std::size_t i) const { return variance(i) * sums_[i].seen; }
  Eigen::Matrix<double, size, 3> errors_of(std::size_t i) const {
    Eigen::Matrix<double, size, 3> e = Eigen::Matrix<double, size, 3>::Zero();
    e.leftCols(may_jump[i].count) = errors_.middleCols(column(i), may_jump[i].count);
    return e;
  }
  /// By all hypotheses of this kind about the same sensor: a receiver jumps in position and velocity.
  double explained(std::size_t i) const {
    const auto sensor = [](int state) { return state < delay && state >= fix_pos ? +fix_pos : state; };
    double all = 0;
    for (std::size_t k = 0; k < count; ++k)
      if (may_jump[k].ramp == may_jump[i].ramp && sensor(may_jump[k].first) == sensor(may_jump[i].first))
        all += sums_[k].seen.dot(sizes(k));
    return all;
  }

  double window_s_, begun_s_ = 0;
  Eigen::Matrix<double, size, columns> errors_;
  std::array<Sums, count> sums_{};
  double striking_ = 0;  ///< sum of the squares of innovations beyond three standard deviations
};

}  // namespace fulmar::second_filter
