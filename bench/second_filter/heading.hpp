// SPDX-License-Identifier: BSD-3-Clause
// Error of the heading from accelerations alone: the change of the horizontal velocity between two fixes,
// beside that of the specific force turned into NED. Needs no magnetometer and finds an error of any size.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "bench/second_filter/states.hpp"

namespace fulmar::second_filter {

class HeadingTest {
 public:
  void clear() { *this = {}; }
  /// The specific force of an inertial sample, NED, over `dt`.
  void felt(const Vector3d& f_n, double dt, double time_s) {
    sum_ += dt * f_n.head<2>();
    if (time_s - at(0).time_s < step_s) return;
    newest_ = (newest_ + 1) % past_.size();
    past_[newest_] = {time_s, sum_};
  }
  /// Horizontal velocity at a past time.
  void fix(const Vector2d& v_n, double std_mps, double time_s) {
    const Sum now = sum_at(time_s);
    const double dt = now.time_s - last_.time_s;
    if (now.known && last_.known && dt > 0 && dt < gap_s) {
      const double keep = std::exp(-dt / memory_s);
      const Vector2d felt = now.sum - last_.sum, seen = v_n - v_last_;
      turned_ =
          keep * turned_ + std::conj(std::complex(felt.x(), felt.y())) * std::complex(seen.x(), seen.y());
      weight_ = keep * weight_ + felt.squaredNorm();
      squares_ = keep * squares_ + seen.squaredNorm();
      count_ = keep * count_ + 2;
      std_ = std_mps;
    }
    last_ = now;
    v_last_ = v_n;
  }
  /// rad, by which the true heading exceeds the estimate, and its standard deviation.
  double error_rad() const { return std::arg(turned_); }
  double std_rad() const {
    if (!(weight_ > 0 && count_ > 4)) return 1e3;
    const double left = std::max(weight_ + squares_ - 2 * std::abs(turned_), 0.0) / count_;  // of the fit
    return std::sqrt(std::max(left, 2 * std_ * std_) / weight_);
  }

 private:
  static constexpr double step_s = 0.0199, gap_s = 1.5, memory_s = 15;

  struct Sum {
    double time_s = -1e9;
    Vector2d sum = Vector2d::Zero();
    bool known = false;
  };
  struct Past {
    double time_s = -1e9;
    Vector2d sum = Vector2d::Zero();
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
  Vector2d sum_ = Vector2d::Zero(), v_last_ = Vector2d::Zero();
  Sum last_;
  std::complex<double> turned_ = 0;
  double weight_ = 0, squares_ = 0, count_ = 0, std_ = 1;
};

}  // namespace fulmar::second_filter
