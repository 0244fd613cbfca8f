// SPDX-License-Identifier: BSD-3-Clause
// The pilot's radio, and the source of each command, pilot or computer, as selected by ROSflight 2.0: at
// frames of the radio only.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "mixer.hpp"
#include "params.hpp"

namespace fulmar::fcu::peer {

enum class ControlMode : std::uint8_t { pass = 0, rate = 1, angle = 2 };

struct Radio {
  enum Switch : std::size_t { arm, attitude_override, throttle_override, attitude_type, switches };
  std::array<double, 4> stick{};  ///< X, Y, Z, F
  std::array<bool, switches> on{}, mapped{};
  std::array<std::int32_t, switches> channel{};

  void map(const Params& p) {
    channel = {p.i(param("RC_ARM_CHN")), p.i(param("RC_ATT_OVRD_CHN")), p.i(param("RC_THR_OVRD_CHN")),
               p.i(param("RC_ATT_CTRL_CHN"))};
    for (std::size_t s = 0; s < switches; ++s)
      mapped[s] = channel[s] > 3 && channel[s] < p.i(param("RC_NUM_CHN"));
    sticks_ = {p.i(param("RC_X_CHN")), p.i(param("RC_Y_CHN")), p.i(param("RC_Z_CHN")),
               p.i(param("RC_F_CHN"))};
  }
  /// Any channel far out of range is a lost link.
  static bool sound(const Params& p, const std::array<std::uint16_t, 8>& us) {
    for (std::int32_t k = 0; k < p.i(param("RC_NUM_CHN")) && k < 8; ++k) {
      const double v = value(us[static_cast<std::size_t>(k)]);
      if (v < -0.25 || v > 1.25) return false;
    }
    return true;
  }
  void decode(const Params& p, const std::array<std::uint16_t, 8>& us) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double v = value(us[static_cast<std::size_t>(sticks_[k]) & 7]);
      stick[k] = k == 3 ? v : 2 * (v - 0.5);
    }
    for (std::size_t s = 0; s < switches; ++s) {
      on[s] = false;
      if (!mapped[s] || channel[s] > 7) continue;
      const auto c = static_cast<std::size_t>(channel[s]);
      const double v = value(us[c]);
      on[s] = p.i(param("SWITCH_5_DIR") + c - 4) < 0 ? v < 0.2 : v >= 0.8;
    }
  }

 private:
  static double value(std::uint16_t us) { return (us - 1000.0) / 1000.0; }
  std::array<std::int32_t, 4> sticks_{};
};

/// The last command of the computer, one flag per input.
struct Offboard {
  Commands u{};
  std::array<bool, 10> active{};
  ControlMode mode = ControlMode::pass;
  std::int64_t stamp_ms = 0;
  bool any() const {
    for (std::size_t i = 0; i < 6; ++i)
      if (active[i]) return true;
    return false;
  }
};

class Mux {
 public:
  Commands u{};  ///< combined
  std::array<ControlMode, 3> mode{};
  std::uint16_t reasons = 0;  ///< bits of Override
  bool pilot_throttle() const {
    return reasons & (override_throttle_switch | override_min_throttle | override_offboard_throttle_inactive);
  }
  bool pilot_attitude() const {
    return reasons &
           ~(override_throttle_switch | override_min_throttle | override_offboard_throttle_inactive);
  }

  void run(const Params& p, const Radio& radio, Offboard& offboard, std::int64_t now_ms) {
    if (now_ms > offboard.stamp_ms + p.i(param("OFFBOARD_TIMEOUT"))) offboard.active.fill(false);
    const Commands rc = pilot(p, radio);
    const auto axis = static_cast<std::size_t>(std::clamp(p.i(param("RC_F_AXIS")), 0, 2));
    reasons = 0;
    for (std::size_t k = 0; k < 3; ++k) attitude(p, radio, offboard, rc, k, now_ms);
    if (radio.mapped[Radio::throttle_override] && radio.on[Radio::throttle_override])
      reasons |= override_throttle_switch;
    if (!offboard.active[axis])
      reasons |= override_offboard_throttle_inactive;
    else if (p.i(param("TAKE_MIN_THR")) && rc[axis] < offboard.u[axis])
      reasons |= override_min_throttle;
    const bool pilots = pilot_throttle();
    for (std::size_t i = 0; i < 3; ++i) u[i] = pilots ? rc[i] : offboard.active[i] ? offboard.u[i] : 0;
    for (std::size_t i = 6; i < 10; ++i)
      if (offboard.active[i]) u[i] = offboard.u[i];  // never the pilot's: they keep their values
  }
  void restart() { *this = {}; }

 private:
  static Commands pilot(const Params& p, const Radio& radio) {
    Commands rc{};
    const auto axis = static_cast<std::size_t>(std::clamp(p.i(param("RC_F_AXIS")), 0, 2));
    rc[axis] = static_cast<float>(radio.stick[3]);
    const bool plane = p.i(param("FIXED_WING")) != 0, angles = p.i(param("RC_ATT_MODE")) != 0;
    const std::array<float, 3> most =
        plane ? std::array<float, 3>{1, 1, 1}
              : std::array<float, 3>{p.f(angles ? param("RC_MAX_ROLL") : param("RC_MAX_ROLLRATE")),
                                     p.f(angles ? param("RC_MAX_PITCH") : param("RC_MAX_PITCHRATE")),
                                     p.f(param("RC_MAX_YAWRATE"))};
    for (std::size_t k = 0; k < 3; ++k) rc[3 + k] = static_cast<float>(radio.stick[k]) * most[k];
    return rc;
  }
  void attitude(const Params& p, const Radio& radio, const Offboard& offboard, const Commands& rc,
                std::size_t k, std::int64_t now_ms) {
    bool pilots = false;
    const auto because = [&](std::uint16_t bit) {
      reasons |= bit;
      pilots = true;
    };
    if (radio.mapped[Radio::attitude_override] && radio.on[Radio::attitude_override])
      because(override_attitude_switch);
    if (deviated(p, radio, k, now_ms)) because(static_cast<std::uint16_t>(override_stick_x << k));
    if (!offboard.active[3 + k]) because(static_cast<std::uint16_t>(override_offboard_x_inactive << k));
    u[3 + k] = pilots ? rc[3 + k] : offboard.u[3 + k];
    const ControlMode pilots_mode = p.i(param("FIXED_WING"))               ? ControlMode::pass
                                    : k == 2 || !p.i(param("RC_ATT_MODE")) ? ControlMode::rate
                                                                           : ControlMode::angle;
    mode[k] = pilots                                          ? pilots_mode
              : offboard.mode == ControlMode::angle && k == 2 ? ControlMode::rate
                                                              : offboard.mode;
  }
  /// The lag counts from the first deviation and restarts only after its end. At boot it runs from zero.
  bool deviated(const Params& p, const Radio& radio, std::size_t k, std::int64_t now_ms) {
    if (now_ms < since_ms_[k] + p.i(param("RC_OVRD_LAG_T"))) return true;
    if (std::abs(radio.stick[k]) <= p.f(param("RC_OVRD_DEV"))) return false;
    since_ms_[k] = now_ms;
    return true;
  }
  std::array<std::int64_t, 3> since_ms_{};
};

}  // namespace fulmar::fcu::peer
