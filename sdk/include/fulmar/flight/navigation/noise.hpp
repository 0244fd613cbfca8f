// SPDX-License-Identifier: BSD-3-Clause
// Noise from samples: of an inertial unit, and the white part of a receiver's velocity error.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "fulmar/flight/navigation/witness.hpp"

namespace fulmar::navigation {

/// White noise of three axes of an inertial unit, as a spectral density, from third differences: for white
/// noise of standard deviation s their mean square is (1 + 9 + 9 + 1) s^2, while a motion of w rad/s adds (w
/// dt)^3 of itself: 0.002 at 100 Hz and 2 Hz. Below 80 Hz the motion dominates, and nothing is learnt.
class UnitNoise {
 public:
  void sampled(const Eigen::Vector3d& values, double dt) {
    if (!(dt < max_s)) count_ = 0;
    const Eigen::Vector3d third = values - past_[2] - 3 * (past_[0] - past_[1]);
    past_ = {values, past_[0], past_[1]};
    if (count_ < 3) {
      ++count_;
      return;
    }
    seen_s_ = std::min(seen_s_ + dt, window_s);
    const double variance = third.squaredNorm() / (3 * 20);
    mean_ += dt / seen_s_ * (variance * dt - mean_);
  }
  /// In unit/sqrt(Hz); `reported`: the value before learning. Bounded both ways, so that other errors of a
  /// quiet unit count, and other sensors beside a shaken one.
  double density(double reported) const {
    if (seen_s_ < min_s) return reported;
    return std::min(std::sqrt(mean_ + min_share * reported * min_share * reported), max_share * reported);
  }

 private:
  static constexpr double max_s = 0.0125, window_s = 5, min_s = 0.5, min_share = 0.5, max_share = 5;

  std::array<Eigen::Vector3d, 3> past_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};  ///< the last one first
  double mean_ = 0, seen_s_ = 0;
  int count_ = 0;
};

/// Split of a receiver's reported velocity error: the part that changes from fix to fix follows from
/// successive differences of innovations (von Neumann, Annals of Mathematical Statistics 12 (1941)). The rest
/// is slow: n fixes within twice its correlation time have the information of one.
class FixNoise {
 public:
  /// Innovations, NED, m/s, and the standard deviation that the receiver reports.
  void add(const Eigen::Vector3d& innovation_mps, double std_mps, double time_s) {
    const double dt = time_s - last_s_;
    last_s_ = time_s;
    reported_ = std_mps * std_mps;
    const Eigen::Vector3d step = innovation_mps - before_;
    before_ = innovation_mps;
    if (!(dt > 0 && dt < max_s)) return;
    seen_s_ = std::min(seen_s_ + dt, window_s);
    const double of_mean = dt / seen_s_;
    level_ += of_mean * (0.25 * step.head<2>().squaredNorm() - level_);
    climb_ += of_mean * (0.5 * step.z() * step.z() - climb_);
  }
  /// Variances of a fix, (m/s)^2, whose slow part counts `n` times. Until it is learnt the level velocity is
  /// taken to be white, and the climb to be slow: that would be integrated to a height.
  double level(double n) const { return white_level() + n * (reported_ - white_level()); }
  double climb(double n) const {
    const double white = known() ? std::min(climb_, reported_) : 0;
    return white + n * (reported_ - white);
  }
  /// m/s, of one axis of the horizontal velocity: the part of `shared` beyond the slow part that is counted.
  double beyond(double shared_mps) const {
    return std::sqrt(std::max(shared_mps * shared_mps - (reported_ - white_level()), 0.0));
  }

 private:
  static constexpr double window_s = 30, min_s = 5, max_s = 1;

  bool known() const { return seen_s_ > min_s; }
  double white_level() const { return known() ? std::min(level_, reported_) : reported_; }

  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();
  double level_ = 0, climb_ = 0, reported_ = 0, last_s_ = never, seen_s_ = 0;
};

}  // namespace fulmar::navigation
