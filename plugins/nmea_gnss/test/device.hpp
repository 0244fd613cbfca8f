// SPDX-License-Identifier: BSD-3-Clause
// A serial device for the tests that can be plugged in and pulled out: a link to a pseudo-terminal.
#pragma once
#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <filesystem>
#include <string>

class Device {
 public:
  Device() : link_(std::filesystem::temp_directory_path() / ("fulmar_gnss_" + std::to_string(getpid()))) { std::filesystem::remove(link_); }
  ~Device() { pull(); }
  void plug() {
    int slave = -1;
    REQUIRE(openpty(&master_, &slave, nullptr, nullptr, nullptr) == 0);
    std::filesystem::create_symlink(ttyname(slave), link_);
    slave_ = slave;
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  void pull() {
    if (master_ >= 0) close(master_), close(slave_);
    master_ = slave_ = -1;
    std::filesystem::remove(link_);
  }
  void write(const std::string& text) const { REQUIRE(::write(master_, text.data(), text.size()) == static_cast<ssize_t>(text.size())); }
  /// What nobody reads is lost, as on a wire.
  void try_write(const std::string& text) const {
    if (::write(master_, text.data(), text.size()) < 0) return;
  }
  std::string path() const { return link_.string(); }

 private:
  std::filesystem::path link_;
  int master_ = -1, slave_ = -1;
};
