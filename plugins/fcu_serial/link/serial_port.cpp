// SPDX-License-Identifier: BSD-3-Clause
#include "serial_port.hpp"

#include <fcntl.h>
#include <grp.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "holder.hpp"
#include "port_messages.hpp"

namespace fulmar::fcu {
namespace {

namespace fs = std::filesystem;
namespace asio = boost::asio;

/// Serial devices present, for the message about a missing one.
std::string candidates() {
  std::vector<std::string> found;
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator("/dev", fault)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("ttyACM") || name.starts_with("ttyUSB")) found.push_back(entry.path().string());
  }
  if (found.empty()) return port_messages::usb_device_missing().line();
  std::sort(found.begin(), found.end());
  std::string list;
  for (const std::string& name : found) list += (list.empty() ? "" : ", ") + name;
  return "there is " + list;
}

std::string group_of(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return "dialout";
  const group* owner = getgrgid(info.st_gid);
  return owner != nullptr && info.st_gid != 0 ? owner->gr_name : "dialout";
}

Diagnostic held(const std::string& path, const std::string& by) {
  return port_messages::port_in_use(path, by.empty()             ? "another program"
                                          : by == "this program" ? by
                                                                 : "another program, " + by);
}

[[noreturn]] void refuse_open(const std::string& path, int fault) {
  if (fault == ENOENT || fault == ENXIO || fault == ENODEV) {
    throw PortError(port_messages::device_missing(path, candidates()));
  }
  if (fault == EACCES || fault == EPERM) {
    throw PortError(port_messages::device_access_denied(path, group_of(path)));
  }
  struct stat info {};
  if (fault == EBUSY) throw PortError(held(path, stat(path.c_str(), &info) == 0 ? other_user(info) : ""));
  throw PortError(port_messages::device_not_openable(path, std::strerror(fault)));
}

void refuse_kind(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) refuse_open(path, errno);
  if (S_ISCHR(info.st_mode)) return;
  throw PortError(port_messages::path_not_port(path, S_ISDIR(info.st_mode) ? " is a folder" : " is a file"));
}

/// TIOCEXCL does not stop root, and flock stops only programs that use it.
void hold_alone(int descriptor, const std::string& path) {
  struct stat info {};
  if (fstat(descriptor, &info) != 0) refuse_open(path, errno);
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) throw PortError(held(path, lock_holder(info)));
  // The creator of a pseudo-terminal may keep this end open, too.
  const unsigned kind = major(info.st_rdev);
  const bool pseudo = kind >= 136 && kind <= 143;
  if (const std::string holder = pseudo ? "" : other_user(info); !holder.empty())
    throw PortError(held(path, holder));
  ioctl(descriptor, TIOCEXCL);
}

/// Raw mode. Without HUPCL, closing leaves the modem lines unchanged: on some boards they are wired to reset.
void make_raw(int descriptor, const std::string& path) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) throw PortError(port_messages::device_not_serial(path));
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  settings.c_cc[VMIN] = 1;  // with O_NONBLOCK, no data is EAGAIN, and 0 bytes mean that the device is gone
  settings.c_cc[VTIME] = 0;
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0)
    throw PortError(port_messages::port_setup_failed(path, std::strerror(errno)));
}

void set_format(asio::serial_port& port, const std::string& path, std::int64_t baud) {
  using base = asio::serial_port_base;
  boost::system::error_code fault;
  port.set_option(base::character_size(8), fault);
  if (!fault) port.set_option(base::parity(base::parity::none), fault);
  if (!fault) port.set_option(base::stop_bits(base::stop_bits::one), fault);
  if (!fault) port.set_option(base::flow_control(base::flow_control::none), fault);
  if (fault) throw PortError(port_messages::format_setup_failed(path, fault.message()));
  port.set_option(base::baud_rate(static_cast<unsigned>(baud)), fault);
  if (!fault) return;
  const auto wanted = static_cast<unsigned>(baud), got = set_any_rate(port.native_handle(), wanted);
  const bool near = got > wanted - wanted / 30 &&
                    got < wanted + wanted / 30;  // a UART samples ten bits with one start edge
  if (!near) throw PortError(port_messages::baud_unsupported(path, baud));
}

/// Some adapters (FTDI) keep bytes for 16 ms by default. Devices without the setting reject it, which has no
/// effect.
void deliver_at_once(int descriptor) {
  serial_struct settings{};
  if (ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ioctl(descriptor, TIOCSSERIAL, &settings);
}

}  // namespace

SerialPort::SerialPort(asio::io_context& io, const std::string& path, std::int64_t baud)
    : path_(path), port_(io) {
  if (baud < 50 || baud > 50'000'000) {
    throw PortError(port_messages::baud_out_of_range(baud));
  }
  refuse_kind(path);
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) refuse_open(path, errno);
  boost::system::error_code fault;
  port_.assign(fd, fault);  // closes it from here on
  if (fault) {
    ::close(fd);
    throw PortError(port_messages::device_not_openable(path, fault.message()));
  }
  make_raw(fd, path);
  hold_alone(fd, path);
  set_format(port_, path, baud);
  deliver_at_once(fd);
  tcflush(fd, TCIFLUSH);  // waiting bytes have an unknown time
  descriptor_ = fd;
}

SerialPort::~SerialPort() {
  if (port_.is_open())
    ioctl(port_.native_handle(), TIOCNXCL);  // otherwise it lasts as long as any program has the device open
}

std::size_t SerialPort::read(std::span<std::uint8_t> room, int timeout_ms) {
  pollfd one{descriptor_, POLLIN, 0};
  const int ready = poll(&one, 1, timeout_ms);
  if (ready == 0 || (ready < 0 && errno == EINTR)) return 0;
  const ssize_t n = ready > 0 ? ::read(descriptor_, room.data(), room.size()) : -1;
  if (n > 0) return static_cast<std::size_t>(n);
  if (n < 0 && (errno == EAGAIN || errno == EINTR) && (one.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0)
    return 0;
  tcflush(descriptor_, TCOFLUSH);  // otherwise closing may wait for a reader of the remaining bytes
  throw PortError(port_messages::device_lost(path_));
}

bool SerialPort::write_rest() noexcept {
  if (rest_size_ == 0) return true;
  const ssize_t n = ::write(descriptor_, rest_.data(), rest_size_);
  if (n <= 0) return false;
  rest_size_ -= static_cast<std::size_t>(n);
  std::memmove(rest_.data(), rest_.data() + n, rest_size_);
  return rest_size_ == 0;
}

bool SerialPort::write(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() > rest_.size() || !write_rest()) return false;
  const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
  if (n <= 0) return false;
  rest_size_ = bytes.size() - static_cast<std::size_t>(n);
  std::memcpy(rest_.data(), bytes.data() + n, rest_size_);
  return true;
}

}  // namespace fulmar::fcu
