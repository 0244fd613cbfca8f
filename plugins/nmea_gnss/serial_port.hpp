// SPDX-License-Identifier: BSD-3-Clause
// A serial port that may appear and disappear. Source: POSIX.1-2017, General Terminal Interface.
#pragma once
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace fulmar::nmea {

inline std::optional<speed_t> baud_code(std::int64_t baud) {
  constexpr std::array<std::pair<std::int64_t, speed_t>, 9> codes{{{4800, B4800},
                                                                   {9600, B9600},
                                                                   {19200, B19200},
                                                                   {38400, B38400},
                                                                   {57600, B57600},
                                                                   {115200, B115200},
                                                                   {230400, B230400},
                                                                   {460800, B460800},
                                                                   {921600, B921600}}};
  for (const auto& [rate, code] : codes) {
    if (rate == baud) return code;
  }
  return {};
}

class SerialPort {
 public:
  SerialPort() = default;
  ~SerialPort() { close(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  bool is_open() const { return fd_ >= 0; }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

  /// Eight bits, no parity, no flow control, raw mode. Returns false for a missing device or one that is no
  /// serial port.
  bool open(const std::string& path, speed_t baud) {
    close();
    fd_ = ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (is_open() && !set_up(baud)) close();
    return is_open();
  }

  /// Reads bytes within `wait_ms`; 0 without any. Closes the port if the device is gone.
  std::size_t read(std::span<char> room, int wait_ms) {
    pollfd one{fd_, POLLIN, 0};
    const int ready = poll(&one, 1, wait_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) return 0;
    const ssize_t n = ready > 0 && (one.revents & POLLIN) ? ::read(fd_, room.data(), room.size()) : -1;
    if (n > 0) return static_cast<std::size_t>(n);
    if (n < 0 && (one.revents & POLLIN) && (errno == EAGAIN || errno == EINTR)) return 0;
    close();
    return 0;
  }

 private:
  bool set_up(speed_t baud) const {
    termios settings{};
    if (tcgetattr(fd_, &settings) != 0) return false;
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    cfsetispeed(&settings, baud);
    cfsetospeed(&settings, baud);
    if (tcsetattr(fd_, TCSANOW, &settings) != 0) return false;
    ioctl(fd_, TIOCEXCL);    // two readers would each get a part of the sentences
    tcflush(fd_, TCIFLUSH);  // waiting bytes have an unknown time
    return true;
  }

  int fd_ = -1;
};

/// Waits between attempts to open a port.
inline void pause_ms(int ms) { poll(nullptr, 0, ms); }

}  // namespace fulmar::nmea
