// SPDX-License-Identifier: BSD-3-Clause
// Finds the plugin that a mission's `use:` names. An interface, so that tests and tools can provide their own
// components.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/loader/library.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

struct FoundPlugin {
  std::shared_ptr<const PluginInfo> info;
  std::shared_ptr<Library> library;  // empty when the component is described by hand
};

struct Catalogue {
  virtual ~Catalogue() = default;
  /// Called before a file is opened; throws Error to forbid it.
  std::function<void(const std::filesystem::path&)> admit;
  /// `name` is a plugin ("control_slc") or a file ("my_law.so", "build/my_law.so"). Throws Error.
  virtual FoundPlugin open(const std::string& name) = 0;
};

/// Plugin files: beside the mission, in FULMAR_PLUGIN_PATH, in <exe>/../lib/fulmar. Each file is opened once.
class PluginCatalogue : public Catalogue {
 public:
  explicit PluginCatalogue(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}
  /// The folders in which a mission's plugins are searched.
  static std::vector<std::filesystem::path> folders_for(const std::filesystem::path& mission_file);
  FoundPlugin open(const std::string& name) override;
  /// Names of the available plugins.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path find(const std::string& name) const;
  std::vector<std::filesystem::path> folders_;
  std::map<std::filesystem::path, FoundPlugin> opened_;
};

/// "control_slc/Outer" -> {"control_slc", "Outer"}, "build/law.so/Outer" -> {"build/law.so", "Outer"}; no
/// component: "".
std::pair<std::string, std::string> split_use(const std::string& use);

}  // namespace fulmar::core
