// SPDX-License-Identifier: BSD-3-Clause
// A serial device for the tests that can be plugged in and pulled out: a link to a pseudo-terminal.
#pragma once
#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>

class Device {
 public:
  Device() : link_(std::filesystem::temp_directory_path() / ("fulmar_gnss_" + std::to_string(getpid()))) {
    std::filesystem::remove(link_);
  }
  ~Device() { pull(); }
  void plug() {
    int slave = -1;
    REQUIRE(openpty(&master_, &slave, nullptr, nullptr, nullptr) == 0);
    std::filesystem::create_symlink(ttyname(slave), link_);
    slave_ = slave;
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  void pull() {
    if (master_ >= 0) {
      close(master_);
      close(slave_);
    }
    master_ = slave_ = -1;
    std::filesystem::remove(link_);
  }
  void write(std::string text) const {
    while (!text.empty()) {
      const ssize_t n = ::write(master_, text.data(), text.size());
      REQUIRE((n > 0 || errno == EAGAIN));
      if (n > 0) text.erase(0, static_cast<std::size_t>(n));
      if (n < 0) usleep(1000);  // full: the reader comes
    }
  }
  /// Data without a reader is lost, as on a wire.
  void try_write(const std::string& text) const {
    if (::write(master_, text.data(), text.size()) < 0) return;
  }
  std::string path() const { return link_.string(); }

 private:
  std::filesystem::path link_;
  int master_ = -1, slave_ = -1;
};
