// SPDX-License-Identifier: BSD-3-Clause
// Datagrams to and from one address, for firmware in simulation.
#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "port.hpp"

namespace fulmar::fcu {

class UdpPort final : public Port {
 public:
  /// `where` as in Port::open, "udp:" included.
  UdpPort(boost::asio::io_context& io, const std::string& where);

  std::size_t read(std::span<std::uint8_t> room, int timeout_ms) override;
  bool write(std::span<const std::uint8_t> bytes) noexcept override;
  int descriptor() const noexcept override { return descriptor_; }

 private:
  boost::asio::ip::udp::socket socket_;
  int descriptor_ = -1;
};

}  // namespace fulmar::fcu
