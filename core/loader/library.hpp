// SPDX-License-Identifier: BSD-3-Clause
// Opens plugin files: probed in a child process, loaded from a private content-addressed copy, unloaded for
// certain.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/loader/file_sum.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// A loaded plugin. The last owner unloads it; the host verifies that it is gone.
class Library {
 public:
  /// Probes and loads `file`. Throws Error with a sentence: no such file, not a plugin, wrong ABI, wrong
  /// architecture, missing dependency, unknown port kind, contradictory table, floating-point flags, crash or
  /// time-out in the probing child. A
  /// script is opened by the plugin that hosts its language, found by host_of.
  static std::shared_ptr<Library> open(const std::filesystem::path& file);
  /// The plugin file that hosts the language of a script. Throws Error when there is none.
  static std::filesystem::path host_of(const std::filesystem::path& script);
  ~Library();

  const PluginInfo& info() const { return info_; }
  /// The functions of info().components[i].
  const fulmar_component& functions(std::size_t i) const;
  /// Where the private copy lies (debuggers want to know).
  const std::filesystem::path& copy() const { return copy_; }

  /// Unloads now, when nobody else holds it. Throws Error "... is still resident after unloading" if code
  /// stays mapped.
  static void unload(std::shared_ptr<Library>&& library);

 private:
  Library() = default;
  struct Handle;
  std::unique_ptr<Handle> handle_;
  PluginInfo info_;
  std::filesystem::path copy_;
  std::string key_;  // in the registry
};

/// Reads a plugin's entry in the calling process; the probing child and `Library` share it. Throws Error.
PluginInfo read_entry(const fulmar_plugin& entry, const std::string& file_name);

}  // namespace fulmar::core
