// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/words.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "plugins/fcu_serial/link/messages.hpp"

namespace fulmar::fcu {

std::vector<std::string> override_words(std::uint16_t bits) {
  static constexpr std::array<std::pair<std::uint16_t, const char*>, 7> words{{
      {override_attitude_switch, "attitude override switch on"},
      {override_throttle_switch, "throttle override switch on"},
      {override_stick_x, "roll stick moved"},
      {override_stick_y, "pitch stick moved"},
      {override_stick_z, "yaw stick moved"},
      {override_min_throttle, "throttle stick below the commanded throttle"},
      {override_inactive, "no command from a computer"},
  }};
  std::vector<std::string> out;
  for (const auto& [mask, word] : words)
    if ((bits & mask) != 0) out.emplace_back(word);
  const auto inactive = static_cast<std::uint16_t>(bits & override_inactive);
  if (inactive != 0 && inactive != override_inactive) {
    out.back() = "no command from a computer for";
    static constexpr std::array<const char*, 4> axes{" roll", " pitch", " yaw", " throttle"};
    for (std::size_t i = 0; i < axes.size(); ++i)
      if ((inactive & (override_offboard_x_inactive << i)) != 0) out.back() += axes[i];
  }
  return out;
}

std::vector<std::string> error_words(std::uint8_t bits) {
  static constexpr std::array<std::pair<std::uint8_t, const char*>, 8> words{{
      {error_invalid_mixer, "no valid mixer"},
      {error_imu_not_responding, "IMU does not respond"},
      {error_rc_lost, "radio lost"},
      {error_unhealthy_estimator, "estimator unhealthy"},
      {error_time_backwards, "time went backwards"},
      {error_uncalibrated_imu, "IMU not calibrated"},
      {error_buffer_overrun, "buffer overrun"},
      {error_invalid_failsafe, "failsafe throttle invalid"},
  }};
  std::vector<std::string> out;
  for (const auto& [mask, word] : words)
    if ((bits & mask) != 0) out.emplace_back(word);
  return out;
}

std::string fix_words(std::uint8_t fix_type) {
  // u-blox UBX-NAV-PVT fixType; 6 and 7 are added by the board
  static constexpr std::array<const char*, 8> words{
      "no fix",    "dead reckoning", "2D fix",   "3D fix", "3D fix and dead reckoning",
      "time only", "RTK float",      "RTK fixed"};
  return fix_type < words.size() ? words[fix_type] : "fix type " + std::to_string(fix_type);
}

std::string severity_word(std::uint8_t severity) {
  static constexpr std::array<const char*, 8> words{"emergency", "alert",  "critical", "error",
                                                    "warning",   "notice", "info",     "debug"};
  return severity < words.size() ? words[severity] : "severity " + std::to_string(severity);
}

std::string fixed(double value, int digits) {
  const double half = 0.5 * std::pow(10.0, -digits);
  std::array<char, 400> room{};
  std::snprintf(room.data(), room.size(), "%.*f", digits, std::fabs(value) < half ? 0.0 : value);
  return room.data();
}

}  // namespace fulmar::fcu
