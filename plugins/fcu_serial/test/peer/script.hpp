// SPDX-License-Identifier: BSD-3-Clause
// What the pilot and the hardware do in a flight against the peer. Seconds from the first command of the host
// on.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "airplane.hpp"
#include "firmware.hpp"
#include "fulmar/flight/trim.hpp"

namespace fulmar::fcu::peer {

inline constexpr double never_s = std::numeric_limits<double>::infinity();

/// From `at` for `lasting`.
struct Span {
  double at = never_s, until = never_s;
  bool holds(double t) const { return t >= at && t < until; }
};

struct Script {
  double arm_at = 2;  ///< with the override switch on, half a second before it goes off
  double disarm_at = never_s;
  Span rc_silent, rc_lost, override, unplugged, mute;
  double reboot_at = never_s, crash_at = never_s;
};

/// The transmitter: arm switch on channel 5, override switch on channel 6. In flight the sticks stand where
/// the aircraft flies level, in case that it is handed over.
class Pilot {
 public:
  Pilot(const Script& script, const Airframe& a, double density) : script_(script) {
    const Trim trim = trimmed_flight(a, a.limits.airspeed_cruise_mps, density);
    if (!trim.found) return;
    const auto stick = [](double angle, const Surface& s) {
      return (s.reversed ? -angle : angle) / s.limit_rad;
    };
    trim_ = {stick(trim.deflections.aileron, a.aileron), stick(trim.deflections.elevator, a.elevator),
             stick(trim.deflections.rudder, a.rudder), trim.throttle_frac};
  }

  /// `t` seconds after the first command; negative before it.
  void act(Inputs& in, double t, bool disarm) const {
    const bool armed = t >= script_.arm_at && t < script_.disarm_at && !disarm;
    const bool taken = script_.override.holds(t);
    const bool flies = armed && t >= script_.arm_at + 0.5;
    const auto stick = [&](double v) {
      return static_cast<std::uint16_t>(std::lround(1500 + (flies ? 500 * v : 0)));
    };
    in.rc_us[0] = stick(trim_[0]);
    in.rc_us[1] = stick(trim_[1]);
    in.rc_us[2] = static_cast<std::uint16_t>(flies ? std::lround(1000 + 1000 * trim_[3]) : 1000);
    in.rc_us[3] = stick(trim_[2]);
    in.rc_us[4] = armed ? 2000 : 1000;
    in.rc_us[5] = taken || t < script_.arm_at + 0.5 ? 2000 : 1000;
    in.rc_frames = !script_.rc_silent.holds(t);
    in.rc_lost = script_.rc_lost.holds(t);
  }

 private:
  Script script_;
  std::array<double, 4> trim_{};
};

}  // namespace fulmar::fcu::peer
