// SPDX-License-Identifier: BSD-3-Clause
// A device for tests that can be plugged in and pulled out: a pseudo-terminal and a link to it, which keeps
// its name.
#pragma once
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace fulmar::fcu::testing {

class Pty {
 public:
  Pty() {
    static std::atomic<int> count{0};
    link_ = std::filesystem::temp_directory_path() /
            ("fulmar_fcu_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::remove(link_);
    plug();
  }
  ~Pty() { pull(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  /// The name stays over pull() and plug(); its target changes.
  std::string name() const { return link_.string(); }
  /// The device itself, as /dev/pts/3.
  const std::string& device() const { return device_; }
  /// The end of the controller.
  int master() const { return master_; }

  void plug() {
    pull();
    std::array<char, 64> path{};
    int slave = -1;
    if (openpty(&master_, &slave, path.data(), nullptr, nullptr) != 0)
      throw std::runtime_error("no pseudo-terminal");
    fcntl(master_, F_SETFL, O_NONBLOCK);
    fcntl(master_, F_SETFD, FD_CLOEXEC);
    // Raw from the start: before the other side sets it up, the line discipline would echo all data.
    termios settings{};
    tcgetattr(slave, &settings);
    cfmakeraw(&settings);
    tcsetattr(slave, TCSANOW, &settings);
    // Kept open: for the master, a terminal that is not open looks unplugged.
    slave_ = slave;
    fcntl(slave_, F_SETFD, FD_CLOEXEC);
    device_ = path.data();
    const std::filesystem::path fresh = link_.string() + ".new";
    std::filesystem::remove(fresh);
    std::filesystem::create_symlink(device_, fresh);
    std::filesystem::rename(fresh, link_);
  }
  void pull() {
    std::error_code fault;
    std::filesystem::remove(link_, fault);
    if (master_ >= 0) {
      close(master_);
      close(slave_);
    }
    master_ = slave_ = -1;
  }

  /// All that the host has sent within `wait_ms`, at least one byte if any comes.
  std::size_t read(std::span<std::uint8_t> room, int wait_ms) const {
    pollfd one{master_, POLLIN, 0};
    if (poll(&one, 1, wait_ms) <= 0) return 0;
    const ssize_t n = ::read(master_, room.data(), room.size());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }
  /// All or nothing: data without room is lost, as on a wire, but a part of a frame is followed by its rest.
  bool write(std::span<const std::uint8_t> bytes) const {
    std::size_t done = 0;
    for (int tries = 0; done < bytes.size() && tries < 1000; ++tries) {
      const ssize_t n = ::write(master_, bytes.data() + done, bytes.size() - done);
      if (n > 0)
        done += static_cast<std::size_t>(n);
      else if (done == 0)
        return false;
      else
        usleep(1000);
    }
    return done == bytes.size();
  }

 private:
  std::filesystem::path link_;
  std::string device_;
  int master_ = -1, slave_ = -1;
};

}  // namespace fulmar::fcu::testing
