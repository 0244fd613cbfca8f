// SPDX-License-Identifier: BSD-3-Clause
// Reports of an outer law: a stall and its end, and loss of height control.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fulmar/flight/control/envelope.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/controller_internals.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar {

/// Loss of height at the pitch limit: for seconds below the commanded height, sinking, with a growing error.
class HeightWatch {
 public:
  enum class Finding : std::uint8_t {
    held,
    lost,          ///< with power: limit of engine, air or envelope
    contradiction  ///< without power: the commands of the law contradict each other
  };
  void reset() { lost_s_ = idle_s_ = 0; }

  /// Call after the law has set `internals`. A law without height hold has the error 0.
  Finding step(const VehicleState& s, const AttitudeCommand& asked, const ControllerInternals& internals,
               double dt_s) {
    constexpr double below_m = 10, sink_mps = 1, lost_s = 5, idle_s = 4, idle_frac = 0.3;
    const bool lost = s.height_valid && internals.height_error_m > below_m && s.climb_rate_mps < -sink_mps &&
                      (internals.pitch_saturated || internals.stalled);
    lost_s_ = std::clamp(lost ? lost_s_ + dt_s : lost_s_ - dt_s, 0.0, lost_s);
    const bool idles = lost && !internals.stalled && asked.pitch_rad > 0 && asked.throttle_frac < idle_frac;
    idle_s_ = idles ? idle_s_ + dt_s : 0;
    if (idle_s_ >= idle_s) return Finding::contradiction;
    return lost_s_ >= lost_s ? Finding::lost : Finding::held;
  }

 private:
  double lost_s_ = 0, idle_s_ = 0;
};

/// Notices at the start or end of a condition, each at most once in several seconds.
class EnvelopeReports {
 public:
  template <class Queue>
  void step(const Tick& tick, const EnvelopeGuard& guard, const ControllerInternals& internals,
            Queue& notices) {
    if (internals.stalled != stalled_) {
      stalled_ = internals.stalled;
      constexpr double degrees = 57.295779513082323;
      if (stalled_)
        push(tick, notices, Severity::error,
             "stall at %.0f deg angle of attack: nose down, wings level, full power",
             degrees * guard.alpha_rad());
      else
        push(tick, notices, Severity::info,
             "out of the stall: full power, little bank, until the height is reached", 0);
    }
    if (internals.height_uncontrolled != lost_) {
      lost_ = internals.height_uncontrolled;
      if (lost_)
        push(tick, notices, Severity::error, "not in control of height: %.0f m too low and sinking",
             internals.height_error_m);
      else
        push(tick, notices, Severity::info, "in control of height again", 0);
    }
  }

 private:
  template <class Queue>
  static void push(const Tick& tick, Queue& notices, Severity severity, const char* text, double figure) {
    Notice notice;
    notice.severity = severity;
    std::snprintf(notice.text.bytes.data(), notice.text.bytes.size(), text, figure);
    notices.push(notice, tick.now_ns);
  }
  bool stalled_ = false, lost_ = false;
};

}  // namespace fulmar
