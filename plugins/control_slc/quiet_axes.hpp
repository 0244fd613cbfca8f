// SPDX-License-Identifier: BSD-3-Clause
// Reduces the gains of an axis that oscillates, with a notice.
#pragma once
#include <algorithm>
#include <array>
#include <fulmar/flight/control/oscillation.hpp>
#include <fulmar/msg/notice.hpp>
#include <fulmar/plugin.hpp>

#include "messages.hpp"

namespace fulmar::slc {

/// Reduced share of the gains of each axis, valid until the gains are changed.
class QuietAxes {
 public:
  enum Axis : std::uint8_t { roll, pitch, yaw, axes };
  using Each = std::array<double, axes>;
  using Gains = std::array<double, 8>;
  /// Of the surface of each axis, rad: deflection, part of it that the command alone causes, and throw.
  struct Surfaces {
    Each deflection{}, commanded{}, limit{};
  };

  void configure(const Gains& gains) { gains_ = gains; }
  /// New gains restart all axes.
  void retune(const Gains& gains) {
    if (gains != gains_)
      for (Quietening& axis : quiet_) axis.restore();
    gains_ = gains;
  }
  /// Clears the history of swings: after a hand-over, on the ground.
  void begin() {
    for (Quietening& axis : quiet_) axis.begin();
  }
  double gain(Axis axis) const { return quiet_[axis].gain(); }
  bool quietened() const {
    return std::any_of(quiet_.begin(), quiet_.end(), [](const Quietening& axis) { return axis.gain() < 1; });
  }
  /// Reduces the gains of an axis whose surface swings repeatedly by more than an eighth of its throw.
  template <class Notices>
  void step(const Tick& tick, const Surfaces& surfaces, double dt, Notices& notices) {
    for (std::size_t i = 0; i < axes; ++i)
      if (quiet_[i].step(surfaces.deflection[i], surfaces.commanded[i], surfaces.limit[i] / 8, dt))
        report(tick, i, notices);
  }

 private:
  template <class Notices>
  void report(const Tick& tick, std::size_t axis, Notices& notices) const {
    static constexpr std::array<const char*, axes> names{"roll", "pitch", "yaw"};
    Notice notice;
    notice.severity = Severity::warning;
    control_slc_messages::axis_oscillates.write(notice.text.bytes.data(), notice.text.bytes.size(),
                                                names[axis], Fixed{quiet_[axis].gain(), 2});
    notices.push(notice, tick.now_ns);
  }

  std::array<Quietening, axes> quiet_;
  Gains gains_{};  ///< the gains that the shares belong to
};

}  // namespace fulmar::slc
