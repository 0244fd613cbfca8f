// SPDX-License-Identifier: BSD-3-Clause
// Selects the commands in force: computer, pilot, or failsafe of the firmware.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>

#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::sim {

/// The computer's command, while it arrives and is valid. As on ROSflight, a command that is too old counts
/// as missing.
inline std::optional<Actuators> heard_command(const Optional<Actuators>& actuators,
                                              const Optional<GroundState>& ground, std::int64_t now_ns) {
  constexpr std::int64_t patience_ns = 100'000'000;
  const auto sound = [](const Actuators& a) {
    return std::isfinite(a.throttle_frac) && std::isfinite(a.aileron_rad) && std::isfinite(a.elevator_rad) &&
           std::isfinite(a.rudder_rad);
  };
  if (!(actuators && now_ns - actuators.valid_at_ns() <= patience_ns && sound(*actuators)))
    return std::nullopt;
  Actuators command = *actuators;
  if (ground && ground->throttle_locked) command.throttle_frac = 0;
  return command;
}

class CommandSwitch {
 public:
  /// State of the pilot: override by the sticks, and the radio link of a connected transmitter.
  struct Pilot {
    bool flies = false, wired = false, link = false;
    Actuators sticks;
  };

  const Actuators& choose(const std::optional<Actuators>& computer, const Pilot& pilot, bool armed,
                          bool released) {
    const bool heard = computer.has_value(), flies = pilot.flies, lost = pilot.wired && !pilot.link;
    silent_ = !heard && pilot.link;
    failsafe_ = armed && (lost || (!heard && !flies && !silent_));
    if (lost && released)
      command_ = {};  // the firmware's failsafe, without regard to the computer
    else if (flies || silent_)
      command_ = pilot.sticks;
    else if (heard)
      command_ = *computer;
    else if (released)
      command_ = {};  // motor off, surfaces neutral
    return command_;
  }
  bool failsafe() const { return failsafe_; }
  /// True when the computer is silent: the firmware then gives the sticks control.
  bool silent() const { return silent_; }

 private:
  Actuators command_;
  bool failsafe_ = false, silent_ = false;
};

}  // namespace fulmar::sim
