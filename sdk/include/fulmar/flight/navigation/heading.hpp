// SPDX-License-Identifier: BSD-3-Clause
// Error of the heading from accelerations alone: the change of the horizontal velocity between two fixes,
// beside that of the specific force turned into NED. Needs no magnetometer and finds an error of any size.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "fulmar/flight/math/angles.hpp"

namespace fulmar::navigation {

/// Of the magnetometer, about the body z axis.
struct Mount {
  double turn_rad = 0;     ///< what its samples are turned by
  bool confirmed = false;  ///< agreed with the accelerations
  bool unknown = false;    ///< it contradicts: the next sample gives the turn
  double off_rad = 0;      ///< of its heading from the estimate, as turned
  double seen_s = -1e9;    ///< when that was
};

/// The test of one heading; times in seconds on one clock.
class HeadingTest {
 public:
  void clear() { *this = {}; }
  /// Attitude after measurements, or set by any other than a prediction. The sums are those of a heading
  /// without such corrections, so that they stay comparable.
  void corrected(const Eigen::Matrix3d& R_nb) {
    const Eigen::Matrix3d turn = R_nb * R_nb_.transpose();
    corrected_rad_ += std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
    R_nb_ = R_nb;
  }
  /// Attitude after an inertial sample.
  void predicted(const Eigen::Matrix3d& R_nb, const Eigen::Vector3d& f_b, double dt, double time_s) {
    R_nb_ = R_nb;
    felt(R_nb * f_b, dt, time_s);
  }
  /// The specific force of an inertial sample, NED, over `dt`.
  void felt(const Eigen::Vector3d& f_n, double dt, double time_s) {
    sum_ += dt * (Eigen::Rotation2Dd(-corrected_rad_) * f_n.head<2>());
    if (time_s - at(0).time_s < step_s) return;
    newest_ = (newest_ + 1) % past_.size();
    past_[newest_] = {time_s, sum_};
  }
  /// Horizontal velocity at a past time.
  void fix(const Eigen::Vector2d& v_n, double std_mps, double time_s) {
    const Sum now = sum_at(time_s);
    const double dt = now.time_s - last_.time_s;
    if (now.known && last_.known && dt > 0 && dt < gap_s) {
      const double keep = std::exp(-dt / memory_s);
      const Eigen::Vector2d felt = now.sum - last_.sum, seen = v_n - v_last_;
      turned_ =
          keep * turned_ + std::conj(std::complex(felt.x(), felt.y())) * std::complex(seen.x(), seen.y());
      weight_ = keep * weight_ + felt.squaredNorm();
      squares_ = keep * squares_ + seen.squaredNorm();
      count_ = keep * count_ + 2;
      times_ = keep * times_ + dt * dt;
      std_ = std_mps;
    }
    last_ = now;
    v_last_ = v_n;
  }
  /// rad, by which the true heading exceeds the estimate, and its standard deviation. Where the specific
  /// force is noise or a tilt error, the velocities do not follow it, and the deviation is large.
  double error_rad() const { return wrap_pi(std::arg(turned_) - corrected_rad_); }
  double std_rad() const {
    const double common = std::abs(turned_);
    if (!(common > 0 && count_ > 4)) return 1e3;
    const double left = std::max(weight_ + squares_ - 2 * common, 0.0) / count_;  // of the fit
    return std::sqrt(std::max(left, 2 * std_ * std_) * weight_) / common;
  }
  /// rad, at most, in addition: by a constant error of the specific force, from tilt and biases.
  double bias_rad() const { return weight_ > 0 ? tilt_mps2 * std::sqrt(times_ / weight_) : 1e3; }

 private:
  static constexpr double step_s = 0.0199, gap_s = 1.5, memory_s = 15;
  static constexpr double tilt_mps2 = 0.6;  ///< 3.5 deg of tilt

  struct Sum {
    double time_s = -1e9;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    bool known = false;
  };
  struct Past {
    double time_s = -1e9;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  };
  const Past& at(std::size_t back) const { return past_[(newest_ + past_.size() - back) % past_.size()]; }
  Sum sum_at(double time_s) const {
    for (std::size_t i = 0; i + 1 < past_.size(); ++i) {
      const Past &after = at(i), &before = at(i + 1);
      if (before.time_s > time_s || before.time_s < -1e8) continue;  // empty
      if (i == 0 && time_s > after.time_s) return {after.time_s, after.sum, true};
      const double k = (time_s - before.time_s) / (after.time_s - before.time_s);
      return {time_s, before.sum + k * (after.sum - before.sum), true};
    }
    return {};
  }

  std::array<Past, 64> past_{};
  std::size_t newest_ = 0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero(), v_last_ = Eigen::Vector2d::Zero();
  Sum last_;
  Eigen::Matrix3d R_nb_ = Eigen::Matrix3d::Zero();  ///< the last one; zero: unknown
  double corrected_rad_ = 0;
  std::complex<double> turned_ = 0;
  double weight_ = 0, squares_ = 0, count_ = 0, times_ = 0, std_ = 1;
};

}  // namespace fulmar::navigation
