// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_campaign/build.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "core/loader/process.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

std::vector<fs::path> source_files(const fs::path& folder) {
  static const std::set<std::string> kinds{".cpp", ".cc", ".c", ".hpp", ".h", ".py"};
  std::vector<fs::path> files;
  std::error_code fault;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, fault), end;
       !fault && it != end; it.increment(fault)) {
    const fs::path& path = it->path();
    const std::string name = path.filename().string(), kind = path.extension().string();
    if (it->is_directory(fault)) {
      if (name.starts_with(".") || fs::exists(path / "CMakeCache.txt", fault) || it.depth() > 6)
        it.disable_recursion_pending();
      continue;
    }
    if (kinds.contains(kind) || name == "CMakeLists.txt") files.push_back(path);
    if (files.size() > 10000) break;
  }
  return files;
}

/// In a separate process group: the terminal's interrupt reaches the host, which then ends the whole build.
bool run_build(const std::string& command, const std::atomic<int>& interrupted) {
  pid_t child = -1;
  try {
    child = spawn("/bin/sh", {"-c", command}, {STDIN_FILENO, STDERR_FILENO, STDERR_FILENO, -1, true});
  } catch (const Error&) {
    return false;
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (interrupted.load() != 0) {
      kill(-child, SIGTERM);
      waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace fulmar::core
