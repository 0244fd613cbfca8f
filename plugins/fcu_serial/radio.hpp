// SPDX-License-Identifier: BSD-3-Clause
// The pilot's sticks and switches, by the channel map of the controller. Source: ROSflight firmware 2.0,
// rc.cpp: a channel is (us - 1000) / 1000, a stick is 2 (v - 0.5), the throttle is v.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "commands.hpp"
#include "fulmar/msg/rc.hpp"
#include "link/messages.hpp"

namespace fulmar::fcu {

/// A parameter's name in a message: all 16 characters, or up to the first NUL.
inline std::string_view id_of(const std::array<char, 16>& id) {
  return {id.data(), static_cast<std::size_t>(std::find(id.begin(), id.end(), '\0') - id.begin())};
}

/// The value of an integer parameter; a real one is rounded towards zero.
inline std::int32_t integer_of(const ParamValue& p) {
  if (p.param_type == param_int32) return std::bit_cast<std::int32_t>(p.param_value);
  const float value = std::bit_cast<float>(p.param_value);
  return value > -1e6f && value < 1e6f ? static_cast<std::int32_t>(value) : 0;
}

/// Channel of each stick and switch, from 0. The values are the firmware's defaults.
struct RcMap {
  std::int32_t x = 0, y = 1, z = 3, f = 2;

  void take(std::string_view name, std::int32_t value) {
    if (name == "RC_X_CHN") x = value;
    if (name == "RC_Y_CHN") y = value;
    if (name == "RC_Z_CHN") z = value;
    if (name == "RC_F_CHN") f = value;
  }
};

inline std::array<std::uint16_t, 8> channels_of(const RcChannels& m) {
  return {m.chan1_raw, m.chan2_raw, m.chan3_raw, m.chan4_raw,
          m.chan5_raw, m.chan6_raw, m.chan7_raw, m.chan8_raw};
}

/// Sticks and switches for the aircraft. The firmware passes sticks on like commands, so the sign of a stick
/// is that of the surface command: a positive elevator is nose down, a positive rudder nose left. The
/// switches are the channels 5 to 8, lower end -1. A missing channel is in the middle; a missing throttle is
/// closed.
inline Rc to_rc(const RcChannels& m, const RcMap& map, const Throws& throws, bool link) {
  const std::array<std::uint16_t, 8> us = channels_of(m);
  const auto there = [&](std::int32_t i) {
    return i >= 0 && i < 8 && us[static_cast<std::size_t>(i)] >= 500 &&
           us[static_cast<std::size_t>(i)] <= 2500;
  };
  const auto stick = [&](std::int32_t i) {
    return there(i) ? std::clamp((us[static_cast<std::size_t>(i)] - 1500) / 500.0, -1.0, 1.0) : 0.0;
  };
  const double throttle =
      there(map.f) ? std::clamp((us[static_cast<std::size_t>(map.f)] - 1000) / 1000.0, 0.0, 1.0) : 0.0;
  const auto sign = [](double full_throw) { return full_throw < 0 ? -1.0 : 1.0; };
  const double roll = sign(throws.aileron) * stick(map.x), pitch = -sign(throws.elevator) * stick(map.y),
               yaw = -sign(throws.rudder) * stick(map.z);
  return {roll, pitch, yaw, throttle, stick(4), stick(5), stick(6), stick(7), link};
}

}  // namespace fulmar::fcu
