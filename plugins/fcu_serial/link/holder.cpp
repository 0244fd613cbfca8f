// SPDX-License-Identifier: BSD-3-Clause
#include "holder.hpp"

#include <sys/sysmacros.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace fulmar::fcu {
namespace {

namespace fs = std::filesystem;

std::string program(long pid) {
  if (pid == getpid()) return "this program";
  std::string name;
  std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/comm"), name);
  return (name.empty() ? "a program" : name) + " (pid " + std::to_string(pid) + ")";
}

bool has_open(const fs::path& process, const struct stat& device) {
  std::error_code fault;
  for (fs::directory_iterator at(process / "fd", fault), end; !fault && at != end; at.increment(fault)) {
    std::error_code gone;
    const std::string target = fs::read_symlink(at->path(), gone).string();
    struct stat other {};
    if (target.starts_with("/dev/") && stat(target.c_str(), &other) == 0 && S_ISCHR(other.st_mode) &&
        other.st_rdev == device.st_rdev) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string lock_holder(const struct stat& file) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    // 1: FLOCK  ADVISORY  WRITE 1234 00:19:6 0 EOF, with the device in hexadecimal
    long pid = 0;
    unsigned major_number = 0, minor_number = 0;
    unsigned long inode = 0;
    if (std::sscanf(line.c_str(), "%*s FLOCK %*s %*s %ld %x:%x:%lu", &pid, &major_number, &minor_number,
                    &inode) != 4)
      continue;
    if (inode == file.st_ino && makedev(major_number, minor_number) == file.st_dev && pid > 0)
      return program(pid);
  }
  return {};
}

std::string other_user(const struct stat& device) {
  std::error_code fault;
  for (fs::directory_iterator at("/proc", fault), end; !fault && at != end; at.increment(fault)) {
    const std::string name = at->path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const long pid = std::stol(name);
    if (pid != getpid() && has_open(at->path(), device)) return program(pid);
  }
  return {};
}

}  // namespace fulmar::fcu
