// SPDX-License-Identifier: BSD-3-Clause
// Inputs from the pilot for the laws of this plugin: shaped sticks, and the presence of a transmitter.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/control/sticks.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::manual {

struct StickParams {
  Param dead_zone{0.05, "ratio", 0, 0.5, "dead zone of the sticks around their centre"};
  Param expo{0.3, "ratio", 0, 1, "share of the cubic term of the stick curve"};
  Param timeout{0.5, "s", 0.02, 10, "largest age of a transmitter frame before the pilot counts as absent"};
};

struct Sticks {
  bool there = false;                   ///< a pilot is connected; else all others are 0
  double roll = 0, pitch = 0, yaw = 0;  ///< -1 to 1: right, nose up, nose right
  double throttle = 0;                  ///< 0 to 1, without dead zone and expo: a lever has no middle
};

/// Age of the last frame, s; `never_s` without a frame, without a link, or with an invalid frame.
inline constexpr double never_s = 1e9;
inline double stick_age_s(const Optional<Rc>& rc, const Tick& tick) {
  if (!rc || rc.stale() || !rc->link) return never_s;
  if (!std::isfinite(rc->roll_frac + rc->pitch_frac + rc->yaw_frac + rc->throttle_frac)) return never_s;
  // Not the age of the input, which counts from the last step of its writer: a receiver may stay silent.
  return std::max(0.0, 1e-9 * static_cast<double>(tick.now_ns - rc.valid_at_ns()));
}

inline Sticks sticks(const Optional<Rc>& rc, const Tick& tick, const StickParams& p) {
  if (stick_age_s(rc, tick) > p.timeout) return {};
  const auto stick = [&](double x) { return shaped(std::clamp(x, -1.0, 1.0), p.dead_zone, p.expo); };
  return {true, stick(rc->roll_frac), stick(rc->pitch_frac), stick(rc->yaw_frac),
          std::clamp(rc->throttle_frac, 0.0, 1.0)};
}

/// Moves from the applied to the wanted value without a step and without a sudden rate. When the source
/// changes, the difference is kept and decays as (1 + t/T) exp(-t/T), critically damped.
class Blend {
 public:
  /// Starts from a value that another component applied last.
  void begin(double applied) {
    value_ = applied;
    known_ = true;
    source_ = -1;
  }
  void reset() { *this = {}; }
  /// Limits the last value: the next source begins there.
  double kept(double applied) { return value_ = applied; }
  /// `decay`: exp(-dt / time constant), one for all blends of a step.
  double step(double wanted, int source, double decay) {
    if (source != source_) {
      offset_ = known_ ? value_ - wanted : 0;
      rate_ = 0;
    } else {
      const double moved = -std::log(decay) * (rate_ + offset_);
      offset_ = decay * (offset_ + moved);
      rate_ = decay * (rate_ - moved);
    }
    source_ = source;
    known_ = true;
    return value_ = wanted + offset_;
  }

 private:
  double value_ = 0, offset_ = 0;
  double rate_ = 0;  ///< of the offset, per time constant
  int source_ = -1;
  bool known_ = false;
};

/// Reports the pilot to the conditions of phases, which cannot detect missing frames.
struct Pilot {
  static constexpr const char* doc =
      "Presence of the pilot for the conditions of phases, and the frames of the transmitter.";
  struct Inputs {
    Optional<Rc> rc;
  };
  struct Outputs {
    Rc rc;              // as received; without a pilot link 0 and all else 0
    Probe there_ratio;  // 1: a frame came within the time-out, with its link
    Probe stick_age_s;  // of the last frame; 1e9: none, no link, or not finite
  };
  struct Params {
    Param timeout{0.5, "s", 0.02, 10, "largest age of a transmitter frame before the pilot counts as absent"};
  };
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double age = stick_age_s(in.rc, tick);
    out.stick_age_s = age;
    const bool there = age <= p.timeout;
    out.there_ratio = there ? 1.0 : 0.0;
    out.rc = there ? *in.rc : Rc{};
    return Status::ok;
  }
};

}  // namespace fulmar::manual
