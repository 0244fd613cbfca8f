// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

enum class Health : std::uint8_t { ok, degraded, failed };

/// Status of the vehicle: control, failsafe and health.
struct VehicleStatus {
  bool armed = false;                  ///< true if the motor is armed
  bool override = false;               ///< override by the pilot; commands have no effect
  bool failsafe = false;               ///< failsafe of the vehicle; commands have no effect
  bool on_ground = false;              ///< contact with the ground: true while disarmed; when armed, valid
                                       ///< if `contact_known`
  bool crashed = false;                ///< crash of the simulated airframe
  Health health = Health::ok;          ///< health of the vehicle
  std::uint32_t errors = 0;            ///< error bits of the vehicle
  double battery_volt = 0;             ///< voltage of the battery
  double battery_amp = 0;              ///< current of the battery
  double battery_frac = 1;             ///< charge left
  bool in_control = false;             ///< effect of commands on the aircraft: armed, offboard, no override,
                                       ///< no failsafe, link and radio alive
  bool offboard = false;               ///< commands from the host accepted, as reported by the vehicle
  std::uint32_t override_reasons = 0;  ///< bits of the vehicle with the reason of the override
  double rc_age_s = 1e9;               ///< time since the last frame of the pilot's radio; 1e9: never
  bool contact_known = false;          ///< true if `on_ground` is measured; a controller without a contact
                                       ///< switch has none, and a simulated one publishes the same:
                                       ///< safety/Ground estimates it
};

template <>
inline constexpr std::string_view appended_from<VehicleStatus> = "contact_known";

}  // namespace fulmar
