// SPDX-License-Identifier: BSD-3-Clause
// Past position and velocity by the present estimate, for late measurements.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "bench/second_filter/states.hpp"

namespace fulmar::second_filter {

/// `age_s` is 0 for the present.
struct Past {
  Vector3d p_n, v_n;
  double age_s = 0;
  bool known = false;  ///< false: older than the memory
};

/// The last 64 steps of the covariance.
class Memory {
 public:
  /// The present state, the reference of the past ones.
  struct Now {
    double time_s = 0;
    Vector3d p_n, v_n;
  };

  void clear() { count_ = 0; }
  void remember(const Now& now) {
    steps_[next_] = {now.time_s, now.p_n, now.v_n, corrected_};
    next_ = (next_ + 1) % steps_.size();
    count_ = std::min(count_ + 1, steps_.size());
  }
  void correct(const Vector3d& dp, const Vector3d& dv, double time_s) {
    corrected_.p += dp;
    corrected_.v += dv;
    corrected_.vt += dv * time_s;
  }
  Past at(double time_s, const Now& now) const {
    if (time_s >= now.time_s || count_ == 0) return {now.p_n, now.v_n, 0, time_s >= now.time_s};
    const Step present{now.time_s, now.p_n, now.v_n, corrected_};
    for (std::size_t i = 0; i < count_; ++i) {
      const Step& before = steps_[slot(i)];
      if (before.time > time_s) continue;
      const Step& after = i > 0 ? steps_[slot(i - 1)] : present;
      const double k = after.time > before.time ? (time_s - before.time) / (after.time - before.time) : 0;
      const Past a = as_known(before, now.time_s), b = as_known(after, now.time_s);
      return {a.p_n + k * (b.p_n - a.p_n), a.v_n + k * (b.v_n - a.v_n), now.time_s - time_s, true};
    }
    return {now.p_n, now.v_n, 0, false};
  }
  /// Changes each past velocity by dv(past), and the position with it.
  template <class ChangeOf>
  void change(double now_s, ChangeOf&& change_of) {
    for (std::size_t i = 0; i < count_; ++i) {
      Step& step = steps_[slot(i)];
      const Past then = as_known(step, now_s);
      const Vector3d dv = change_of(then);
      step.v += dv;
      step.p -= 0.5 * then.age_s * dv;
    }
  }

 private:
  struct Corrections {  ///< sums over all updates; vt is weighted with their time
    Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), vt = Vector3d::Zero();
  };
  struct Step {
    double time = 0;
    Vector3d p = Vector3d::Zero(), v = Vector3d::Zero();
    Corrections corrected;
  };

  std::size_t slot(std::size_t back) const {  // 0: the newest
    return (next_ + steps_.size() - 1 - back) % steps_.size();
  }
  /// A correction made at time s moved position by dp and velocity by dv: at an earlier time t it means dp -
  /// (s - t) dv.
  Past as_known(const Step& step, double now_s) const {
    const Vector3d dv = corrected_.v - step.corrected.v;
    return {step.p + (corrected_.p - step.corrected.p) - (corrected_.vt - step.corrected.vt) + step.time * dv,
            step.v + dv, now_s - step.time, true};
  }

  Corrections corrected_;
  std::array<Step, 64> steps_{};
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace fulmar::second_filter
