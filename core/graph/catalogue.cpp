// SPDX-License-Identifier: BSD-3-Clause
// Searches plugin files by name.
#include "core/graph/catalogue.hpp"

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "core/graph/messages.hpp"
#include "core/loader/home.hpp"
#include "core/loader/script.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

std::pair<std::string, std::string> split_use(const std::string& use) {
  for (const std::string suffix : {".so", ".py"}) {
    if (use.ends_with(suffix)) return {use, ""};
    const auto file = use.rfind(suffix + "/");
    if (file != std::string::npos) return {use.substr(0, file + 3), use.substr(file + 4)};
  }
  const auto slash = use.rfind('/');
  if (slash == std::string::npos) return {use, ""};
  return {use.substr(0, slash), use.substr(slash + 1)};
}

namespace {

/// Many missions have a script beside them that is no plugin.
bool uses_sdk(const fs::path& script) {
  std::ifstream in(script);
  for (std::string line; std::getline(in, line);)
    if (line.find("fulmar_plugin") != std::string::npos) return true;
  return false;
}

}  // namespace

std::vector<fs::path> PluginCatalogue::folders_for(const fs::path& mission_file) {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  };
  add(mission_file.has_parent_path() ? mission_file.parent_path() : fs::path("."));
  for (const fs::path& folder : plugin_folders()) add(folder);
  return folders;
}

fs::path PluginCatalogue::find(const std::string& name) const {
  const fs::path file = name.ends_with(".so") || !script_host(name).empty() ? name : name + ".so";
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
      if (it->path().extension() == ".so")
        names.push_back(it->path().stem().string());
      else if (!script_host(it->path()).empty() && uses_sdk(it->path()))
        names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

FoundPlugin PluginCatalogue::open(const std::string& name) {
  const fs::path file = find(name);
  if (file.empty()) {
    std::error_code none;
    if (fs::path(name).is_absolute() && !name.ends_with(".so") && script_host(name).empty())
      throw Error(graph_messages::plugin_path_invalid(
          name, fs::is_directory(name, none) ? "' is a folder" : "' is not there"));
    if (fs::path(name).is_absolute()) throw Error(graph_messages::plugin_file_missing(name));
    std::vector<std::string> searched;
    for (const fs::path& folder : folders_) searched.push_back(folder.string());
    throw Error(graph_messages::plugin_unknown(name, join(searched), choices_text(name, names())));
  }
  std::error_code code;
  fs::path key = fs::canonical(file, code);
  if (code) key = file;
  const auto it = opened_.find(key);
  if (it != opened_.end()) return it->second;
  if (admit) admit(file);
  // a script runs inside the plugin that hosts its language, so that file is also checked
  std::shared_ptr<Library> host;
  if (admit && !script_host(file).empty()) {
    admit(Library::host_of(file));
    host = Library::open(Library::host_of(file));
  }
  FoundPlugin found;
  found.library = Library::open(file);
  auto info = std::make_shared<PluginInfo>(found.library->info());
  info->path = file.string();  // of two files with equal bytes one is loaded, but each keeps its own name
  info->file = file.filename().string();
  found.info = std::move(info);
  opened_.emplace(key, found);
  return found;
}

}  // namespace fulmar::core
