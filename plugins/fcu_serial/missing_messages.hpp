// SPDX-License-Identifier: BSD-3-Clause
// Conditions that are missing before a flight. Short codes: a notice lists several in its 95 characters.
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::missing_messages {

inline constexpr MessageText airspeed_zero{"missing.airspeed_zero", "airspeed not zeroed yet"};
inline constexpr MessageText attitude{"missing.attitude", "no attitude with heading"};
inline constexpr MessageText barometer{"missing.barometer", "no barometer"};
inline constexpr MessageText gnss_fix{"missing.gnss_fix", "no GNSS fix"};
inline constexpr MessageText height{"missing.height", "no height"};
inline constexpr MessageText inertial_samples{"missing.inertial_samples", "no inertial samples"};
inline constexpr MessageText link{"missing.link", "the flight controller is silent"};
inline constexpr MessageText magnetometer{"missing.magnetometer", "no magnetometer"};
inline constexpr MessageText path{"missing.path", "no path to fly"};
inline constexpr MessageText pitot{"missing.pitot", "no pitot"};
inline constexpr MessageText position{"missing.position", "no position"};
inline constexpr MessageText right_airspeed_zero{"missing.right_airspeed_zero", "airspeed zeroed wrong"};
inline constexpr MessageText velocity{"missing.velocity", "no velocity"};

}  // namespace fulmar::missing_messages
