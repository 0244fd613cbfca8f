// SPDX-License-Identifier: BSD-3-Clause
// A joystick for the tests that can be plugged in and pulled out: a named pipe.
#pragma once
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>

class Pipe {
 public:
  Pipe() : folder_(std::filesystem::temp_directory_path() / ("fulmar_hand_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Pipe() {
    pull();
    std::filesystem::remove_all(folder_);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void plug() {
    make();
    end_ = open(path().c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(end_ >= 0);
  }
  /// A pipe without a program at its other end.
  void make() const { REQUIRE(mkfifo(path().c_str(), 0600) == 0); }
  void pull() {
    if (end_ >= 0) close(end_);
    end_ = -1;
    std::filesystem::remove(path());
  }
  /// Writes at most the capacity of the pipe.
  void write(const std::string& bytes) const {
    REQUIRE(::write(end_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  std::string path() const { return (folder_ / "js0").string(); }

 private:
  std::filesystem::path folder_;
  int end_ = -1;
};

/// A record as the kernel writes it: struct js_event of linux/joystick.h, little endian.
inline std::string record(int type, int number, int value, std::uint32_t time_ms = 0) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(time_ms >> 8 * i & 0xff);
  bytes += static_cast<char>(value & 0xff);
  bytes += static_cast<char>(value >> 8 & 0xff);
  bytes += static_cast<char>(type);
  bytes += static_cast<char>(number);
  return bytes;
}
inline std::string axis(int number, int value) { return record(2, number, value); }
inline std::string button(int number, bool down) { return record(1, number, down ? 1 : 0); }
