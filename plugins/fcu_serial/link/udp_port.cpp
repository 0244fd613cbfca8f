// SPDX-License-Identifier: BSD-3-Clause
#include "udp_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <vector>

#include "port_messages.hpp"

namespace fulmar::fcu {
namespace {

using boost::asio::ip::udp;

constexpr unsigned short companion_port = 14520;  // destination port of firmware in simulation

struct Address {
  std::string remote;
  unsigned short remote_port = 0, local_port = companion_port;
};

[[noreturn]] void refuse_address(const std::string& where) {
  throw PortError(port_messages::udp_address_invalid(where));
}

unsigned short port_number(const std::string& text, const std::string& where) {
  unsigned short number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc{} || end != text.data() + text.size() || number == 0) refuse_address(where);
  return number;
}

Address parse(const std::string& where) {
  std::vector<std::string> parts{""};
  for (const char c : where) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (parts.size() < 3 || parts.size() > 4 || parts[1].empty()) refuse_address(where);
  Address out{parts[1], port_number(parts[2], where)};
  if (parts.size() == 4) out.local_port = port_number(parts[3], where);
  return out;
}

/// Numeric addresses only: a name lookup may take too long.
udp::endpoint endpoint(const Address& address, const std::string& where) {
  boost::system::error_code fault;
  const std::string number = address.remote == "localhost" ? "127.0.0.1" : address.remote;
  const auto host = boost::asio::ip::make_address_v4(number, fault);
  if (fault) throw PortError(port_messages::ip_address_invalid(address.remote, where));
  return {host, address.remote_port};
}

}  // namespace

UdpPort::UdpPort(boost::asio::io_context& io, const std::string& where) : socket_(io) {
  const Address address = parse(where);
  const udp::endpoint remote = endpoint(address, where);
  // For a remote on this machine the local socket is bound to the loopback interface.
  const udp::endpoint local(remote.address().is_loopback()
                                ? remote.address()
                                : boost::asio::ip::address(boost::asio::ip::address_v4::any()),
                            address.local_port);
  boost::system::error_code fault;
  socket_.open(udp::v4(), fault);
  if (!fault) fcntl(socket_.native_handle(), F_SETFD, FD_CLOEXEC);
  if (!fault) socket_.bind(local, fault);
  if (fault == boost::asio::error::address_in_use) {
    throw PortError(port_messages::udp_port_in_use(address.local_port, address.remote, address.remote_port));
  }
  if (!fault) socket_.connect(remote, fault);  // packets of other senders are then ignored
  if (fault) throw PortError(port_messages::device_not_openable(where, fault.message()));
  descriptor_ = socket_.native_handle();
}

std::size_t UdpPort::read(std::span<std::uint8_t> room, int timeout_ms) {
  pollfd one{descriptor_, POLLIN, 0};
  if (poll(&one, 1, timeout_ms) <= 0) return 0;
  // connection refused: the remote is not there yet
  const ssize_t n = recv(descriptor_, room.data(), room.size(), MSG_DONTWAIT);
  return n > 0 ? static_cast<std::size_t>(n) : 0;
}

bool UdpPort::write(std::span<const std::uint8_t> bytes) noexcept {
  for (int attempt = 0; attempt < 2; ++attempt) {  // the first call may report the error of the one before
    if (send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) return true;
    if (errno != ECONNREFUSED) return false;
  }
  return false;
}

}  // namespace fulmar::fcu
