// SPDX-License-Identifier: BSD-3-Clause
// Searches plugin files by name.
#include "core/graph/catalogue.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/error.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

std::pair<std::string, std::string> split_use(const std::string& use) {
  if (use.ends_with(".so")) return {use, ""};
  const auto file = use.rfind(".so/");
  if (file != std::string::npos) return {use.substr(0, file + 3), use.substr(file + 4)};
  const auto slash = use.rfind('/');
  if (slash == std::string::npos) return {use, ""};
  return {use.substr(0, slash), use.substr(slash + 1)};
}

std::vector<fs::path> PluginCatalogue::folders_for(const fs::path& mission_file) {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  };
  add(mission_file.has_parent_path() ? mission_file.parent_path() : fs::path("."));
  if (const char* list = std::getenv("FULMAR_PLUGIN_PATH")) {
    std::istringstream parts(list);
    for (std::string part; std::getline(parts, part, ':');)
      if (!part.empty()) add(part);
  }
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  if (!code) add(self.parent_path().parent_path() / "lib" / "fulmar");
  return folders;
}

fs::path PluginCatalogue::find(const std::string& name) const {
  const fs::path file = name.ends_with(".so") ? name : name + ".so";
  std::error_code code;
  if (file.is_absolute()) return fs::is_regular_file(file, code) ? file : fs::path();
  for (const fs::path& folder : folders_)
    if (fs::is_regular_file(folder / file, code)) return folder / file;
  return {};
}

std::vector<std::string> PluginCatalogue::names() const {
  std::vector<std::string> names;
  for (const fs::path& folder : folders_) {
    std::error_code code;
    for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
      if (it->path().extension() == ".so") names.push_back(it->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

FoundPlugin PluginCatalogue::open(const std::string& name) {
  const fs::path file = find(name);
  if (file.empty()) {
    std::vector<std::string> searched;
    for (const fs::path& folder : folders_) searched.push_back(folder.string());
    throw Error("there is no plugin '" + name + "'. Searched in " + join(searched) + "." + choices_text(name, names()));
  }
  std::error_code code;
  fs::path key = fs::canonical(file, code);
  if (code) key = file;
  const auto it = opened_.find(key);
  if (it != opened_.end()) return it->second;
  FoundPlugin found;
  found.library = Library::open(file);
  found.info = std::make_shared<PluginInfo>(found.library->info());
  opened_.emplace(key, found);
  return found;
}

}  // namespace fulmar::core
