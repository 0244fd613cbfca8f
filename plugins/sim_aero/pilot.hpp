// SPDX-License-Identifier: BSD-3-Clause
// The radio between a pilot and the simulated aircraft. Its receiver and override are those of a ROSflight
// board: firmware 2.0, rc.cpp and state_manager.cpp.
#pragma once
#include <cmath>
#include <cstdint>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/rc.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::sim {

/// Sticks and switches of a pilot without a transmitter.
struct StickParams {
  Flag pilot_flies{false, "override by the pilot: the sticks below move surfaces and motor"};
  Param stick_roll{0, "", -1, 1, "roll stick of the pilot; right is positive"};
  Param stick_pitch{0, "", -1, 1, "pitch stick of the pilot; nose up is positive"};
  Param stick_yaw{0, "", -1, 1, "yaw stick of the pilot; nose right is positive"};
  Param stick_throttle{0, "", 0, 1, "throttle stick of the pilot"};
  Param aux1{0, "", -1, 1, "first switch of the pilot"};
  Param aux2{0, "", -1, 1, "second switch of the pilot"};
  Param aux3{0, "", -1, 1, "third switch of the pilot"};
  Param aux4{0, "", -1, 1, "fourth switch of the pilot"};
};

inline Rc rc_of(const StickParams& p) {
  return {p.stick_roll, p.stick_pitch, p.stick_yaw, p.stick_throttle, p.aux1, p.aux2, p.aux3, p.aux4, true};
}

/// Commands of the firmware while the sticks are in control.
inline Actuators by_hand(const Rc& rc, const Airframe& a) {
  return {rc.throttle_frac, rc.roll_frac * a.aileron.limit_rad, -rc.pitch_frac * a.elevator.limit_rad,
          -rc.yaw_frac * a.rudder.limit_rad};
}

struct PilotParams {
  Count override_switch{0, 0, 4, "aux channel for the override by the wired pilot, on above 0.6; 0: none",
                        setup};
  Count arm_switch{0, 0, 4, "aux channel that arms and disarms when it changes, of the wired pilot; 0: none",
                   setup};
};

/// Reception of a transmitter that is connected to the input `pilot`.
class PilotRadio {
 public:
  /// A transmitter sends 50 frames a second.
  static constexpr std::int64_t patience_ns = 500'000'000;
  static constexpr double on_above = 0.6;  ///< of -1 to 1; 0.8 of 0 to 1 in the firmware

  /// [write] `carries`: no fault of the radio is in force.
  void hear(const Optional<Rc>& pilot, bool carries, std::int64_t now_ns) {
    if (!pilot) {  // without a sample, or when the host no longer passes one, there are no frames
      if (now_ns - heard_ns_ > patience_ns) link_ = false;
      return;
    }
    wired_ = true;
    const bool frames = pilot->link && now_ns - pilot.valid_at_ns() <= patience_ns && finite(*pilot);
    link_ = frames && carries;
    if (!link_) return;
    rc_ = *pilot;
    heard_ns_ = now_ns;
  }

  /// True with a connected transmitter: it replaces the parameters.
  bool wired() const { return wired_; }
  bool link() const { return link_; }
  /// Sticks and switches last received.
  const Rc& rc() const { return rc_; }
  bool overrides(const PilotParams& p) const { return link_ && lever(p.override_switch) > on_above; }

  enum class Arming : std::uint8_t { stays, arm, disarm };
  /// A switch that is on at its first reception must be turned off before it arms.
  Arming arming(const PilotParams& p) {
    if (!link_ || p.arm_switch == 0) return Arming::stays;
    const bool on = lever(p.arm_switch) > on_above, was = was_armed_;
    was_armed_ = on;
    return on == was ? Arming::stays : on ? Arming::arm : Arming::disarm;
  }

 private:
  static bool finite(const Rc& r) {
    return std::isfinite(r.roll_frac + r.pitch_frac + r.yaw_frac + r.throttle_frac + r.aux1_frac +
                         r.aux2_frac + r.aux3_frac + r.aux4_frac);
  }
  double lever(std::int64_t number) const {
    switch (number) {
      case 1: return rc_.aux1_frac;
      case 2: return rc_.aux2_frac;
      case 3: return rc_.aux3_frac;
      case 4: return rc_.aux4_frac;
      default: return -1;
    }
  }

  Rc rc_;
  std::int64_t heard_ns_ = 0;
  bool wired_ = false, link_ = false;
  bool was_armed_ = true;  ///< last known state of the switch
};

}  // namespace fulmar::sim
