// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/watch.hpp"

#include <cstdlib>
#include <thread>
#include <utility>

namespace fulmar::core {
namespace fs = std::filesystem;

std::map<fs::path, FileStamps::Stamp> FileStamps::read() const {
  std::map<fs::path, Stamp> stamps;
  for (const fs::path& file : files_) {
    std::error_code fault;
    Stamp stamp;
    stamp.time = fs::last_write_time(file, fault);
    if (fault) continue;  // being replaced: it will be there again
    stamp.size = fs::file_size(file, fault);
    if (!fault) stamps[file] = stamp;
  }
  return stamps;
}

std::vector<fs::path> FileStamps::changed() {
  std::map<fs::path, Stamp> now = read();
  if (now == stamps_ || now.size() < stamps_.size()) return {};
  for (std::map<fs::path, Stamp> before; before != now;) {  // until nobody writes any more
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

std::vector<fs::path> source_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code fault;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, fault), end; !fault && it != end;
       it.increment(fault)) {
    const fs::path& path = it->path();
    const std::string name = path.filename().string(), kind = path.extension().string();
    if (it->is_directory(fault)) {
      if (name.starts_with(".") || fs::exists(path / "CMakeCache.txt", fault) || it.depth() > 6) it.disable_recursion_pending();
      continue;
    }
    for (const char* wanted : {".cpp", ".cc", ".c", ".hpp", ".h", ".py"})
      if (kind == wanted) files.push_back(path);
    if (name == "CMakeLists.txt") files.push_back(path);
    if (files.size() > 10000) break;
  }
  return files;
}

bool run_build(const std::string& command) {
  return std::system(("( " + command + " ) 1>&2").c_str()) == 0;
}  // NOLINT(cert-env33-c): it is the user's own

}  // namespace fulmar::core
