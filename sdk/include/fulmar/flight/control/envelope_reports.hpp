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

/// Height that is lost although the law asks for all the pitch that it may: for seconds below the height
/// commanded, sinking, the error growing.
class HeightWatch {
 public:
  enum class Finding : std::uint8_t {
    held,
    lost,          ///< with power: the engine, the air or the envelope gives no more
    contradiction  ///< and without power: the commands of the law contradict each other
  };
  void reset() { lost_s_ = idle_s_ = 0; }

  /// After the law has filled `said`. A law that holds no height leaves its error at 0.
  Finding step(const VehicleState& s, const AttitudeCommand& asked, const ControllerInternals& said,
               double dt_s) {
    constexpr double below_m = 10, sink_mps = 1, lost_s = 5, idle_s = 4, idle_frac = 0.3;
    const bool lost = s.height_valid && said.height_error_m > below_m && s.climb_rate_mps < -sink_mps &&
                      (said.pitch_saturated || said.stalled);
    lost_s_ = std::clamp(lost ? lost_s_ + dt_s : lost_s_ - dt_s, 0.0, lost_s);
    const bool idles = lost && !said.stalled && asked.pitch_rad > 0 && asked.throttle_frac < idle_frac;
    idle_s_ = idles ? idle_s_ + dt_s : 0;
    if (idle_s_ >= idle_s) return Finding::contradiction;
    return lost_s_ >= lost_s ? Finding::lost : Finding::held;
  }

 private:
  double lost_s_ = 0, idle_s_ = 0;
};

/// Notices, each when something begins or ends, the same one no more often than every few seconds.
class EnvelopeReports {
 public:
  template <class Queue>
  void step(const Tick& tick, const EnvelopeGuard& guard, const ControllerInternals& said, Queue& notices) {
    if (said.stalled != stalled_) {
      stalled_ = said.stalled;
      constexpr double degrees = 57.295779513082323;
      if (stalled_)
        push(tick, notices, Severity::error,
             "stall at %.0f deg angle of attack: nose down, wings level, full power",
             degrees * guard.alpha_rad());
      else
        push(tick, notices, Severity::info,
             "out of the stall: full power, little bank, until the height is reached", 0);
    }
    if (said.height_uncontrolled != lost_) {
      lost_ = said.height_uncontrolled;
      if (lost_)
        push(tick, notices, Severity::error, "not in control of height: %.0f m too low and sinking",
             said.height_error_m);
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
