// SPDX-License-Identifier: BSD-3-Clause
// The device: a serial port (raw, 8 data bits, no parity, 1 stop bit, any rate) or a UDP address.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "fulmar/diagnostic.hpp"

namespace fulmar::fcu {

/// Fault of a device with its remedy, in one sentence.
struct PortError : std::runtime_error {
  explicit PortError(Diagnostic message)
      : std::runtime_error(message.line()), diagnostic(std::move(message)) {}
  Diagnostic diagnostic;
};

class Port {
 public:
  /// "/dev/ttyACM0", or "udp:REMOTE:PORT" and "udp:REMOTE:PORT:LOCAL_PORT" for firmware in simulation
  /// ("udp:127.0.0.1:14525" binds 14520).
  /// Throws PortError: no such device, no permission, held by another program, no serial port, an impossible
  /// rate, an address in use.
  static std::unique_ptr<Port> open(const std::string& where, std::int64_t baud = 921600);
  virtual ~Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Reads bytes within `timeout_ms`, 0 without any. Throws PortError when the device is gone.
  virtual std::size_t read(std::span<std::uint8_t> room, int timeout_ms) = 0;
  /// Writes all bytes or none; never waits. Returns false without room or device. Async-signal-safe.
  virtual bool write(std::span<const std::uint8_t> bytes) noexcept = 0;
  /// For the failsafe of a crashing host: one write of one frame to it reaches the device. -1 without a
  /// device.
  virtual int descriptor() const noexcept = 0;

 protected:
  Port() = default;
};

}  // namespace fulmar::fcu
