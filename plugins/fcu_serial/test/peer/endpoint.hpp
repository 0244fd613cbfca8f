// SPDX-License-Identifier: BSD-3-Clause
// Where the peer is reached: a pseudo-terminal under a name of one's choice, which can be pulled out, or UDP
// as ROSflight in simulation.
#pragma once
#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace fulmar::fcu::peer {

class Endpoint {
 public:
  virtual ~Endpoint() = default;
  virtual int descriptor() const = 0;                           ///< -1 while unplugged
  virtual std::size_t read(std::span<std::uint8_t> room) = 0;   ///< 0: no data
  virtual void write(std::span<const std::uint8_t> bytes) = 0;  ///< data without a reader is lost
  virtual bool attended() const { return true; }                ///< a program has it open
  virtual void unplug() {}
  virtual void plug() {}
  virtual std::string name() const = 0;
};

class Terminal : public Endpoint {
 public:
  explicit Terminal(std::string link) : link_(std::move(link)) { plug(); }
  ~Terminal() override { unplug(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void plug() override {
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0)
      throw std::runtime_error("no pseudo-terminal to be had");
    slave_ = ::ptsname(master_);
    const int slave =
        ::open(slave_.c_str(),
               O_RDWR | O_NOCTTY |
                   O_CLOEXEC);  // raw; after its close the master can detect whether the other side is open
    termios t{};
    ::tcgetattr(slave, &t);
    ::cfmakeraw(&t);
    ::tcsetattr(slave, TCSANOW, &t);
    ::close(slave);
    if (link_.empty()) return;
    const std::string next = link_ + ".next";
    std::filesystem::remove(next);
    std::filesystem::create_symlink(slave_, next);
    std::filesystem::rename(next, link_);
  }
  void unplug() override {
    if (master_ < 0) return;
    if (!link_.empty()) std::filesystem::remove(link_);
    ::close(master_);
    master_ = -1;
  }
  int descriptor() const override { return master_; }
  bool attended() const override {
    pollfd p{master_, POLLOUT, 0};
    return master_ >= 0 && ::poll(&p, 1, 0) >= 0 && (p.revents & POLLHUP) == 0;
  }
  std::size_t read(std::span<std::uint8_t> room) override {
    const auto n = master_ < 0 ? -1 : ::read(master_, room.data(), room.size());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }
  void write(std::span<const std::uint8_t> bytes) override {
    if (master_ < 0) return;
    while (!bytes.empty()) {
      const auto n = ::write(master_, bytes.data(), bytes.size());
      if (n <= 0) return;
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
  std::string name() const override { return link_.empty() ? slave_ : link_; }

 private:
  std::string link_, slave_;
  int master_ = -1;
};

/// Replies to the last sender.
class Datagrams : public Endpoint {
 public:
  Datagrams(std::uint16_t local, std::uint16_t remote)
      : local_(local), socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_in here = address(local);
    remote_ = address(remote);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here) != 0)
      throw std::runtime_error("UDP port " + std::to_string(local) + "live.subscription_in_use(1)");
  }
  ~Datagrams() override { ::close(socket_); }
  Datagrams(const Datagrams&) = delete;
  Datagrams& operator=(const Datagrams&) = delete;

  int descriptor() const override { return socket_; }
  std::size_t read(std::span<std::uint8_t> room) override {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const auto n =
        ::recvfrom(socket_, room.data(), room.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (n <= 0) return 0;
    remote_ = from;
    return static_cast<std::size_t>(n);
  }
  void write(std::span<const std::uint8_t> bytes) override {
    [[maybe_unused]] const auto n = ::sendto(socket_, bytes.data(), bytes.size(), 0,
                                             reinterpret_cast<sockaddr*>(&remote_), sizeof remote_);
  }
  std::string name() const override { return "udp:127.0.0.1:" + std::to_string(local_); }

 private:
  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in a{};
    a.sin_family = AF_INET;
    a.sin_port = htons(port);
    a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return a;
  }
  std::uint16_t local_;
  sockaddr_in remote_{};
  int socket_;
};

}  // namespace fulmar::fcu::peer
