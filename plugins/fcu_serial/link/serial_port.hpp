// SPDX-License-Identifier: BSD-3-Clause
// A serial port or a pseudo-terminal: raw, exclusive, opened without side effects on the device.
#pragma once
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

#include "port.hpp"

namespace fulmar::fcu {

class SerialPort final : public Port {
 public:
  SerialPort(boost::asio::io_context& io, const std::string& path, std::int64_t baud);
  ~SerialPort() override;

  std::size_t read(std::span<std::uint8_t> room, int timeout_ms) override;
  bool write(std::span<const std::uint8_t> bytes) noexcept override;
  int descriptor() const noexcept override { return descriptor_; }

 private:
  bool write_rest() noexcept;

  std::string path_;
  boost::asio::serial_port port_;
  int descriptor_ = -1;
  std::array<std::uint8_t, 512>
      rest_{};  ///< rest of a partial write: it is sent first, so that frames stay complete
  std::size_t rest_size_ = 0;
};

/// Sets a rate that is no constant of termios, through termios2. Returns the resulting rate, 0 when the
/// driver rejects it.
unsigned set_any_rate(int descriptor, unsigned baud);

}  // namespace fulmar::fcu
