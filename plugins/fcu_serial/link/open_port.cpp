// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>

#include "port.hpp"
#include "port_messages.hpp"
#include "serial_port.hpp"
#include "udp_port.hpp"

namespace fulmar::fcu {
namespace {

/// Boost.Asio makes the whole process ignore SIGPIPE with its first io_context. That decision belongs to the
/// host.
class KeepSigpipe {
 public:
  KeepSigpipe() { sigaction(SIGPIPE, nullptr, &before_); }
  ~KeepSigpipe() { sigaction(SIGPIPE, &before_, nullptr); }
  KeepSigpipe(const KeepSigpipe&) = delete;
  KeepSigpipe& operator=(const KeepSigpipe&) = delete;

 private:
  struct sigaction before_ {};
};

/// A port and the context that it needs.
template <class P>
class Owned final : public Port {
 public:
  template <class... Args>
  explicit Owned(const Args&... args) : io_(1), port_(io_, args...) {}
  std::size_t read(std::span<std::uint8_t> room, int timeout_ms) override {
    return port_.read(room, timeout_ms);
  }
  bool write(std::span<const std::uint8_t> bytes) noexcept override { return port_.write(bytes); }
  int descriptor() const noexcept override { return port_.descriptor(); }

 private:
  boost::asio::io_context io_;
  P port_;
};

}  // namespace

std::unique_ptr<Port> Port::open(const std::string& where, std::int64_t baud) {
  const KeepSigpipe keep;
  if (where.empty()) throw PortError(port_messages::port_missing());
  if (where.starts_with("udp:")) return std::make_unique<Owned<UdpPort>>(where);
  return std::make_unique<Owned<SerialPort>>(where, baud);
}

}  // namespace fulmar::fcu
