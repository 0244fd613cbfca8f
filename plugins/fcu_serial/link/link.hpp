// SPDX-License-Identifier: BSD-3-Clause
// The link to a flight controller, as used by the loop. Packets arrive through a lock-free queue, dated in
// host time; frames are sent at once. A separate thread reads, keeps the connection, synchronises time,
// requests the watched parameters, and sends the heartbeat.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame.hpp"
#include "link_state.hpp"

namespace fulmar::fcu {

struct LinkOptions {
  std::string port = "/dev/ttyACM0";
  std::int64_t baud = 921600;
  // parameters that are read after every connection and reboot; their PARAM_VALUEs arrive as packets
  std::vector<std::string> watched;
  double time_scale = 1;  ///< ratio of host time to real time, for hardware in the loop faster than real time
};

enum class LinkEvent : std::uint8_t { packet, connected, disconnected, rebooted };

struct Received {
  LinkEvent event = LinkEvent::packet;
  std::int64_t arrived_ns = 0;  ///< host time
  std::int64_t valid_at_ns =
      0;          ///< host time: the stamp of the controller where the message has one, else the arrival
  Packet packet;  ///< of LinkEvent::packet
};

class Link {
 public:
  /// Opens the device and starts. Throws PortError.
  explicit Link(const LinkOptions& options);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  // For the thread of the loop. Only wait_imu waits, and no function allocates.
  /// Waits until an inertial sample is in the queue, which returns true, or until `until_ns` of host time. At
  /// the first call the link's thread gets the scheduling policy and priority of the caller, who waits for
  /// it.
  bool wait_imu(std::int64_t until_ns) noexcept;
  bool pop(Received& out) noexcept;
  template <class M>
  bool send(const M& message) noexcept {
    return send_frame(encode(message, next_sequence()));
  }
  bool send_frame(const Frame& frame) noexcept;
  std::uint8_t next_sequence() noexcept;
  // host time: monotonic, times time_scale, 0 at the construction of the link
  std::int64_t now_ns() const noexcept;
  LinkState state() const noexcept;
  int descriptor() const noexcept;  ///< -1 without a device

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::fcu
