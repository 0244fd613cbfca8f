// SPDX-License-Identifier: BSD-3-Clause
// First checks of a device: a flight controller of this type, a supported version, and a set-up for a fixed
// wing.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware_version.hpp"
#include "link/link.hpp"
#include "messages.hpp"
#include "pitot_zero.hpp"
#include "radio.hpp"

namespace fulmar::fcu {

inline constexpr std::int64_t silence_patience_ns = 3'500'000'000;  ///< time-out of the first frame
inline constexpr std::int64_t noise_patience_ns = 2'000'000'000;    ///< the same while other bytes arrive
inline constexpr std::uint64_t noise_bytes = 200;                   ///< more than two of the longest frames
inline constexpr std::int64_t answer_patience_ns =
    2'000'000'000;  ///< time-out of all answers, from the first frame on
inline constexpr std::int64_t greeting_patience_ns = 4'500'000'000;  ///< time-out of the whole greeting

/// Parameters of the controller that this plugin needs.
inline constexpr std::array<std::string_view, 9> watched_parameters{
    "FIXED_WING",  "RC_X_CHN",     "RC_Y_CHN",   "RC_Z_CHN", "RC_F_CHN",
    "REV_AILERON", "REV_ELEVATOR", "REV_RUDDER", pitot_zero};

/// A watched parameter as 32 bits: an integer, or the float of the pitot's zero.
inline std::int32_t watched_bits(std::string_view name, const ParamValue& p) {
  return name == pitot_zero ? std::bit_cast<std::int32_t>(p.param_value) : integer_of(p);
}

/// State of the greeting.
struct Greeting {
  std::string version;
  bool imu = false, versioned = false, refused = false, armed = false;
  std::uint16_t parameter_count = 0;
  std::int32_t autopilot = -1;  ///< from heartbeats; ROSflight: 0
  std::array<std::optional<std::int32_t>, watched_parameters.size()> parameters;

  void take(const Packet& packet) {
    if (packet.is<SmallImu>()) imu = true;
    if (packet.is<Heartbeat>()) autopilot = packet.as<Heartbeat>().autopilot;
    if (packet.is<RosflightStatus>()) armed = packet.as<RosflightStatus>().armed != 0;
    if (packet.is<RosflightVersion>()) {
      const auto text = packet.as<RosflightVersion>().version;
      version.assign(text.begin(), std::find(text.begin(), text.end(), '\0'));
      versioned = true;
    }
    if (packet.is<RosflightCmdAck>()) {
      const auto ack = packet.as<RosflightCmdAck>();
      if (ack.command == static_cast<std::uint8_t>(Command::send_version) && ack.success == 0) refused = true;
    }
    if (packet.is<ParamValue>()) {
      const ParamValue p = packet.as<ParamValue>();
      parameter_count = p.param_count;
      for (std::size_t i = 0; i < parameters.size(); ++i)
        if (id_of(p.param_id) == watched_parameters[i])
          parameters[i] = watched_bits(watched_parameters[i], p);
    }
  }
  bool complete() const {
    const bool all =
        std::all_of(parameters.begin(), parameters.end(), [](const auto& p) { return p.has_value(); });
    // an armed controller does not answer the request for its version
    return imu && all && (versioned || (refused && armed));
  }
  std::int32_t parameter(std::string_view name, std::int32_t unknown = -1) const {
    const auto at =
        std::find(watched_parameters.begin(), watched_parameters.end(), name) - watched_parameters.begin();
    return parameters[static_cast<std::size_t>(at)].value_or(unknown);
  }
};

/// Reason why this device cannot be used, with the remedy, in one sentence; "" for none.
inline std::string objection(const Greeting& g, const LinkState& link, const std::string& port,
                             std::int64_t baud) {
  const bool serial = port.rfind("udp:", 0) != 0;
  if (link.frames == 0 && link.bytes == 0) return fcu_serial_messages::device_silent(port);
  if (link.frames == 0 && link.text_bytes * 20 >= link.bytes * 19)
    return fcu_serial_messages::text_received(port);
  if (link.frames == 0 && talks_mavlink_2(link.modern, link.bytes))
    return fcu_serial_messages::mavlink_2(port);
  if (link.frames == 0 && serial) return fcu_serial_messages::frames_missing_at_baud(link.bytes, port, baud);
  if (link.frames == 0) return fcu_serial_messages::frames_missing(link.bytes, port);
  if (g.autopilot > 0) return fcu_serial_messages::other_autopilot(port, g.autopilot);
  if (const auto major = major_version(g.version); g.versioned && major && *major < oldest_firmware)
    return fcu_serial_messages::firmware_too_old(port, g.version);
  if (!g.imu) return fcu_serial_messages::imu_missing(port);
  if (!g.versioned && !g.armed) return fcu_serial_messages::version_missing(port);
  if (g.parameter("FIXED_WING") == 0) return fcu_serial_messages::not_fixed_wing(port);
  return "";
}

}  // namespace fulmar::fcu
