// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Health : std::uint8_t { ok, degraded, failed };

/// What the vehicle says of itself: who is in control, and whether it can fly.
struct VehicleStatus {
  bool armed = false;
  bool override = false;   ///< the pilot flies; commands have no effect
  bool failsafe = false;   ///< the vehicle flies by its own failsafe; commands have no effect
  bool on_ground = false;  ///< disarmed. Armed: `contact_known` says whether this means anything
  bool crashed = false;    ///< simulation: the airframe hit the ground
  Health health = Health::ok;
  std::uint32_t errors = 0;  ///< the vehicle's own error bits
  double battery_volt = 0;
  double battery_amp = 0;
  double battery_frac = 1;  ///< charge left
  bool in_control =
      false;  ///< commands move the aircraft: armed, offboard, no override, no failsafe, link and radio alive
  bool offboard = false;               ///< the vehicle takes commands from the host, as far as it says
  std::uint32_t override_reasons = 0;  ///< the vehicle's own bits: why the pilot flies
  double rc_age_s = 1e9;               ///< since the pilot's radio was last heard; 1e9: never
  /// Whether `on_ground` is measured. A controller without a contact switch has none, and a simulated one
  /// publishes the same: safety/Ground estimates it.
  bool contact_known = false;
};

template <>
inline constexpr std::string_view appended_from<VehicleStatus> = "contact_known";

}  // namespace fulmar
