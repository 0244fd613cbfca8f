// SPDX-License-Identifier: BSD-3-Clause
// The gains of the inner loops during tuning: given, kept, in use, and changing.
#pragma once
#include <algorithm>
#include <array>
#include <fulmar/msg/autotune_report.hpp>

#include "gain_search.hpp"
#include "inner.hpp"

namespace fulmar::slc {

/// Indices of the tuned axes, in their order.
struct TunedAxis {
  enum Index : std::size_t { roll, pitch, yaw, axes };
};

/// The gains of each axis. They move within change_s, so that no surface steps.
class TunedGains {
  using enum TunedAxis::Index;

 public:
  static AxisGains gains_of(const Inner::Params& p, std::size_t axis) {
    if (axis == roll) return {p.roll_kp, p.roll_ki, p.roll_kd};
    if (axis == pitch) return {p.pitch_kp, p.pitch_ki, p.pitch_kd};
    return {0, 0, p.yaw_kd};
  }
  static AxisGains times(const AxisGains& g, double by) { return {g.kp * by, g.ki * by, g.kd * by}; }

  void configure(const Inner::Params& p) {
    for (std::size_t i = 0; i < axes; ++i)
      given_[i] = old_[i] = kept_[i] = used_[i] = goal_[i] = gains_of(p, i);
  }
  /// Takes gains from a change of parameters at once. Returns true when they differ from those before.
  bool give(std::size_t axis, const AxisGains& now) {
    if (now == given_[axis]) return false;
    given_[axis] = kept_[axis] = used_[axis] = goal_[axis] = now;
    return true;
  }
  /// Begins the tuning: the gains as reduced by quietening are the initial ones.
  void begin(std::size_t axis, double left) {
    kept_[axis] = old_[axis] = goal_[axis] = used_[axis] = times(used_[axis], left);
  }

  void change_to(std::size_t axis, const AxisGains& g) {
    goal_[axis] = g;
    left_s_[axis] = change_s;
  }
  void go_back(std::size_t axis) { change_to(axis, kept_[axis]); }
  void keep(std::size_t axis) { kept_[axis] = used_[axis]; }
  /// Completes the change at once: no surface depends on the gains now.
  void finish_change(std::size_t axis) {
    used_[axis] = goal_[axis];
    left_s_[axis] = 0;
  }
  /// Returns true when the gains in use have moved.
  bool change_over(std::size_t axis, double dt) {
    if (left_s_[axis] <= 0) return false;
    const double part = std::min(1.0, dt / left_s_[axis]);
    left_s_[axis] = part < 1 ? left_s_[axis] - dt : 0;
    const AxisGains &to = goal_[axis], &now = used_[axis];
    used_[axis] = part < 1 ? AxisGains{now.kp + part * (to.kp - now.kp), now.ki + part * (to.ki - now.ki),
                                       now.kd + part * (to.kd - now.kd)}
                           : to;
    return true;
  }

  const AxisGains& used(std::size_t axis) const { return used_[axis]; }
  /// Writes the gains into the parameters of the law.
  void put_into(Inner::Params& law, std::size_t axis) const {
    const AxisGains& g = used_[axis];
    if (axis == roll) {
      law.roll_kp.value = g.kp;
      law.roll_ki.value = g.ki;
      law.roll_kd.value = g.kd;
    }
    if (axis == pitch) {
      law.pitch_kp.value = g.kp;
      law.pitch_ki.value = g.ki;
      law.pitch_kd.value = g.kd;
    }
    if (axis == yaw) law.yaw_kd.value = g.kd;
  }
  void put_into(AutotuneReport& r, std::size_t axis) const {
    r.before_kp_ratio[axis] = old_[axis].kp;
    r.before_ki_ratio[axis] = old_[axis].ki;
    r.before_kd_ratio[axis] = old_[axis].kd;
    r.kp_ratio[axis] = used_[axis].kp;
    r.ki_ratio[axis] = used_[axis].ki;
    r.kd_ratio[axis] = used_[axis].kd;
  }

 private:
  static constexpr double change_s = 0.5;

  std::array<AxisGains, axes> given_{}, old_{}, kept_{}, used_{}, goal_{};
  std::array<double, axes> left_s_{};  ///< rest of the time of a change of gains
};

}  // namespace fulmar::slc
