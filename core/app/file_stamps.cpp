// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/file_stamps.hpp"

#include <chrono>
#include <thread>

namespace fulmar::core {
namespace fs = std::filesystem;

std::map<fs::path, FileStamps::Stamp> FileStamps::read() const {
  std::map<fs::path, Stamp> stamps;
  for (const fs::path& file : files_) {
    std::error_code fault;
    const fs::file_time_type time = fs::last_write_time(file, fault);
    const std::uintmax_t size = fault ? 0 : fs::file_size(file, fault);
    if (!fault)
      stamps[file] = {time, size};  // without size or time it is being replaced and will exist
                                    // again
  }
  return stamps;
}

std::vector<fs::path> FileStamps::changed() {
  std::map<fs::path, Stamp> now = read();
  if (now == stamps_ || now.size() < stamps_.size()) return {};
  for (std::map<fs::path, Stamp> before; before != now;) {  // until the files stop changing
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    before = std::exchange(now, read());
  }
  std::vector<fs::path> changed;
  for (const auto& [file, stamp] : now) {
    const auto was = stamps_.find(file);
    if (was == stamps_.end() || was->second != stamp) changed.push_back(file);
  }
  stamps_ = std::move(now);
  return changed;
}

fs::path FileStamps::missing() const {
  const std::map<fs::path, Stamp> now = read();
  for (const auto& [file, stamp] : stamps_)
    if (!now.contains(file)) return file;
  return {};
}

}  // namespace fulmar::core
