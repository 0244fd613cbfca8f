// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/home.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

void add(std::vector<fs::path>& folders, const fs::path& folder) {
  if (!folder.empty() && std::find(folders.begin(), folders.end(), folder) == folders.end())
    folders.push_back(folder);
}

fs::path running_program() {
  std::error_code fault;
  return fs::read_symlink("/proc/self/exe", fault);
}

// The file that contains this function: the program, or a module of another program.
fs::path own_file() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&home_folders), &info) == 0 || info.dli_fname == nullptr)
    return {};
  std::error_code fault;
  return fs::canonical(info.dli_fname, fault);
}

}  // namespace

bool can_run(const fs::path& file) {
  std::error_code fault;
  return fs::is_regular_file(file, fault) && ::access(file.c_str(), X_OK) == 0;
}

std::vector<fs::path> home_folders() {
  std::vector<fs::path> folders;
  const fs::path program = running_program();
  add(folders, program.parent_path().parent_path());
  const fs::path file = own_file();
  if (file.empty() || file == program) return folders;
  // <home>/lib/python/..., <home>/lib/python3/dist-packages/..., <home>/lib/python3.11/site-packages/...
  fs::path folder = file.parent_path();
  for (int up = 0; up < 4 && folder.has_relative_path(); ++up) {
    folder = folder.parent_path();
    if (can_run(folder / "bin" / "fulmar-probe")) add(folders, folder);
  }
  return folders;
}

fs::path own_program(const std::string& name, const char* variable) {
  if (const char* chosen = std::getenv(variable); chosen != nullptr && *chosen != '\0') return chosen;
  if (const fs::path beside = running_program().parent_path() / name; can_run(beside)) return beside;
  for (const fs::path& home : home_folders())
    if (can_run(home / "bin" / name)) return home / "bin" / name;
  return {};
}

fs::path page_folder() {
  std::error_code fault;
  for (const fs::path& home : home_folders())
    if (fs::is_regular_file(home / "share" / "fulmar" / "web" / "index.html", fault))
      return home / "share" / "fulmar" / "web";
  return {};
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  if (const char* list = std::getenv("FULMAR_PLUGIN_PATH")) {
    std::istringstream parts(list);
    for (std::string part; std::getline(parts, part, ':');) add(folders, part);
  }
  for (const fs::path& home : home_folders()) add(folders, home / "lib" / "fulmar");
  return folders;
}

}  // namespace fulmar::core
