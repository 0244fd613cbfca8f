// SPDX-License-Identifier: BSD-3-Clause
// Source of the bytes: a device or a pipe that may appear and disappear. Source: POSIX.1-2017.
#pragma once
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "messages.hpp"

namespace fulmar::hand {

class Source {
 public:
  Source() = default;
  ~Source() { close(); }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  bool is_open() const { return fd_ >= 0 && there_; }
  /// Reason of a missing or lost device.
  const char* fault() const { return fault_; }

  void close() {
    if (fd_ < 0) return;
    if (has_settings_) tcsetattr(fd_, TCSANOW, &settings_);
    has_settings_ = false;
    ::close(fd_);
    fd_ = -1;
    there_ = false;
  }
  void close(const char* why) {
    close();
    fault_ = why;
  }

  /// Until it is closed, a terminal delivers characters as they are typed, without echo.
  bool open(const std::string& path) {
    if (fd_ >= 0 && waits_for_sender(path)) return there_;
    close();
    fd_ = ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    there_ = fd_ >= 0;
    if (!there_)
      fault_ = errno == EACCES ? joystick_messages::permission_missing.c_str() : strerrordesc_np(errno);
    if (is_open() && isatty(fd_) == 1) take_terminal();
    return is_open();
  }

  /// Reads bytes within `wait_ms`; 0 without any. Closes the device if its sender is gone.
  std::size_t read(std::span<char> room, int wait_ms) {
    pollfd one{fd_, POLLIN, 0};
    poll(&one, 1, wait_ms);
    // Called even without data: for `poll`, a pipe without a writer looks like one with a silent writer.
    const ssize_t n = ::read(fd_, room.data(), room.size());
    if (n > 0) return static_cast<std::size_t>(n);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    close_or_wait(n == 0 ? joystick_messages::sender_missing.c_str() : strerrordesc_np(errno));
    return 0;
  }

 private:
  /// This end of a pipe stays open: otherwise a writer that opens the other end at this time gets a broken
  /// pipe.
  void close_or_wait(const char* why) {
    struct stat own {};
    if (fstat(fd_, &own) != 0 || !S_ISFIFO(own.st_mode)) return close(why);
    there_ = false;
    fault_ = why;
  }

  /// True when the open pipe is still that of the path. Also updates whether it has a writer.
  bool waits_for_sender(const std::string& path) {
    struct stat own {
    }, named{};
    if (fstat(fd_, &own) != 0 || stat(path.c_str(), &named) != 0 || own.st_ino != named.st_ino ||
        own.st_dev != named.st_dev)
      return false;
    pollfd one{fd_, POLLIN, 0};
    poll(&one, 1, 0);
    there_ = (one.revents & POLLIN) != 0 || (one.revents & POLLHUP) == 0;
    return true;
  }

  /// Ctrl-C and Ctrl-Z keep their meaning.
  void take_terminal() {
    if (tcgetpgrp(fd_) != getpgrp()) return close(joystick_messages::terminal_in_use.c_str());
    has_settings_ = tcgetattr(fd_, &settings_) == 0;
    termios raw = settings_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    if (!has_settings_ || tcsetattr(fd_, TCSANOW, &raw) != 0)
      close(joystick_messages::terminal_setup_failed.c_str());
  }

  int fd_ = -1;
  bool there_ = false;  ///< a pipe has a writer
  const char* fault_ = "";
  termios settings_{};
  bool has_settings_ = false;
};

/// For `configure`. A path that does not exist yet is tried again in flight.
inline std::string checked_path(std::string_view name) {
  std::string path(name);
  if (path.empty()) throw std::runtime_error(located("device", joystick_messages::device_missing()).line());
  struct stat found {};
  if (stat(path.c_str(), &found) == 0 && !S_ISCHR(found.st_mode) && !S_ISFIFO(found.st_mode))
    throw std::runtime_error(located("device", joystick_messages::device_invalid(path)).line());
  return path;
}

/// Waits between attempts to open it.
inline void pause_ms(int ms) { poll(nullptr, 0, ms); }

}  // namespace fulmar::hand
