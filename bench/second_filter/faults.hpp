// SPDX-License-Identifier: BSD-3-Clause
// One fault rule for all sensors: generalised likelihood ratio of a jump of one slow error (Willsky & Jones,
// IEEE TAC 21(1) (1976)). A fault of a sensor is a jump of the state that models its error. For each such
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

/// A state that may jump or, with `ramp`, drift by so much in ten seconds; the size from which it is a fault,
/// in the unit of the state.
struct MayJump {
  int state;
  double least;
  double after_s;  ///< in a window: a short manoeuvre may look like a fault
  bool ramp = false;
  double doubt = 1;  ///< factor on the likelihood ratio that a fault needs: gusts look like one of the pitot
};
inline constexpr std::array may_jump{MayJump{fix_pos, 4, 0},
                                     MayJump{fix_pos + 1, 4, 0},
                                     MayJump{fix_pos + 2, 8, 0},
                                     MayJump{fix_vel, 1, 0},
                                     MayJump{fix_vel + 1, 1, 0},
                                     MayJump{fix_vel + 2, 1.5, 0},
                                     MayJump{baro_bias, 3, 0},
                                     MayJump{tube_bias, 3, 0, false, 3},
                                     MayJump{theta + 2, 0.1, 3},
                                     MayJump{gyro_bias, 2e-3, 6},
                                     MayJump{gyro_bias + 1, 2e-3, 6},
                                     MayJump{gyro_bias + 2, 2e-3, 6},
                                     MayJump{accel_bias, 0.15, 6},
                                     MayJump{accel_bias + 1, 0.15, 6},
                                     MayJump{accel_bias + 2, 0.15, 6},
                                     MayJump{fix_pos, 3, 6, true},
                                     MayJump{fix_pos + 1, 3, 6, true},
                                     MayJump{baro_bias, 1, 6, true},
                                     MayJump{tube_bias, 3, 8, true, 3},
                                     MayJump{gyro_bias, 5e-4, 12, true},
                                     MayJump{gyro_bias + 1, 5e-4, 12, true},
                                     MayJump{gyro_bias + 2, 5e-4, 12, true}};

/// A jump that was found.
struct Fault {
  int state = -1;  ///< -1: none
  double size = 0;
  double ratio = 0;  ///< twice the logarithm of the likelihood ratio
};

/// The hypotheses over one window.
class Jumps {
 public:
  static constexpr int count = static_cast<int>(may_jump.size());
  using Errors = Eigen::Matrix<double, size, count>;
  using PerJump = Eigen::Matrix<double, count, 1>;
  static constexpr double hasty_s = 8;  ///< a window this long asks for twice the likelihood

  explicit Jumps(double window_s) : window_s_(window_s) { begin(0); }
  void begin(double time_s) {
    begun_s_ = time_s;
    errors_.setZero();
    for (int i = 0; i < count; ++i)
      if (!of(i).ramp) errors_(of(i).state, i) = 1;
    information_.setZero();
    sum_.setZero();
    squares_.setZero();
    products_.setZero();
    fourth_.setZero();
    concentrated_.setZero();
    striking_ = 0;
  }
  double window_s() const { return window_s_; }
  bool over(double time_s) const { return time_s - begun_s_ > window_s_; }

  /// A scalar update with gain `K`; `S`: variance of the innovation. One beyond `gate` standard deviations
  /// counts for less (Huber), so that a few outliers are no jump.
  void fused(const Row& H, const Vector& K, double innovation, double S, double gate) {
    const double trust = std::min(gate * std::sqrt(S) / std::max(std::abs(innovation), 1e-30), 1.0);
    PerJump effect = PerJump::Zero();  // H times the errors
    for (int i = 0; i < size; ++i)
      if (H(i) != 0) effect.noalias() += H(i) * errors_.row(i).transpose();
    const double square = std::min(innovation * innovation / S, wildest * wildest);
    if (square > striking * striking) striking_ += std::min(square, gate * gate);
    const PerJump weight = effect.cwiseAbs2() * (trust / S);
    information_ += weight;
    sum_ += effect * (trust * innovation / S);
    squares_ += weight * square;
    products_ += weight.cwiseProduct(effect) * (innovation / S);
    fourth_ += weight.cwiseProduct(effect.cwiseAbs2()) / S;
    concentrated_ += weight.cwiseAbs2();
    for (int i = 0; i < count; ++i) errors_.col(i).noalias() -= effect(i) * K;
  }
  /// As the covariance: B = sum R dt, D = -[dv]x, E = -D B / 2 over the step T.
  void predicted(const Matrix3d& B, const Matrix3d& D, const Matrix3d& E, double T, const Vector& decay) {
    using Three = Eigen::Matrix<double, 3, count>;
    const Three dv = D * errors_.middleRows<3>(theta) - B * errors_.middleRows<3>(accel_bias);
    errors_.middleRows<3>(pos) += T * errors_.middleRows<3>(vel) + 0.5 * T * dv;
    errors_.middleRows<3>(vel) += dv + E * errors_.middleRows<3>(gyro_bias);
    errors_.middleRows<3>(theta) -= B * errors_.middleRows<3>(gyro_bias);
    for (int i = wind; i < size; ++i)
      if (decay(i) != 1) errors_.row(i) *= decay(i);
    for (int i = 0; i < count; ++i)
      if (of(i).ramp) errors_(of(i).state, i) += T / ramp_s;
  }

  /// Twice the logarithm of the likelihood ratio, of each jump with its most likely size, over the mean
  /// square of the innovations that it leaves, where that exceeds 1: a motion outside the model is no fault.
  /// Without `unit` the inertial unit is not judged.
  PerJump ratio(double time_s, bool unit) const {
    PerJump ratio = PerJump::Zero();
    for (int i = 0; i < count; ++i) {
      const bool of_unit = of(i).state >= gyro_bias && of(i).state < accel_bias + 3;
      if (time_s - begun_s_ < of(i).after_s || (of_unit && !unit)) continue;
      const double all = std::max(information_(i), 1e-12), size = sum_(i) / all;
      if (all * all < least_samples * concentrated_(i)) continue;  // a few samples carry it
      if (explained(i) < 0.5 * striking_) continue;                // less than half of what is odd
      const double left = (squares_(i) - 2 * size * products_(i) + size * size * fourth_(i)) / all;
      ratio(i) = sum_(i) * size / (of(i).doubt * std::max(left, 1.0));
    }
    return ratio;
  }
  double size_of(int i) const { return sum_(i) / std::max(information_(i), 1e-12); }
  double variance_of(int i) const { return 1 / std::max(information_(i), 1e-12); }
  /// Error of the estimate per unit of this jump, now.
  Vector error(int i) const { return errors_.col(i); }

 private:
  static constexpr double least_samples = 8, ramp_s = 10, striking = 3, wildest = 100;

  /// What all hypotheses of this kind about the same sensor explain: a receiver jumps along each axis.
  double explained(int i) const {
    const auto group = [](int state) { return state < delay && state >= fix_pos ? +fix_pos : state / 3; };
    double all = 0;
    for (int k = 0; k < count; ++k)
      if (of(k).ramp == of(i).ramp && group(of(k).state) == group(of(i).state)) all += sum_(k) * size_of(k);
    return all;
  }
  static const MayJump& of(int i) { return may_jump[static_cast<std::size_t>(i)]; }

  double window_s_, begun_s_ = 0;
  Errors errors_;
  PerJump information_, sum_;            ///< sums over the window: of H e / S, squared and times innovation
  PerJump squares_, products_, fourth_;  ///< of the squared innovations, weighted with their information
  double striking_ = 0;   ///< sum of the squares of innovations beyond three standard deviations
  PerJump concentrated_;  ///< sum of the squared weights
};

}  // namespace fulmar::second_filter
