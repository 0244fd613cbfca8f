// SPDX-License-Identifier: BSD-3-Clause
// Opens plugin files: probes them in a child process, loads a private content-addressed copy, and verifies
// the unload.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/loader/file_sum.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// A loaded plugin. The last owner unloads it; the host verifies the unload.
class Library {
 public:
  /// Probes and loads `file`. Throws Error: no such file, not a plugin, wrong ABI, wrong architecture,
  /// missing dependency, unknown port kind, contradictory table, floating-point flags, crash or time-out in
  /// the probing child. The plugin that hosts a script's language opens the script, see host_of.
  static std::shared_ptr<Library> open(const std::filesystem::path& file);
  /// The plugin file that hosts the language of a script. Throws Error when there is none.
  static std::filesystem::path host_of(const std::filesystem::path& script);
  ~Library();

  const PluginInfo& info() const { return info_; }
  /// The functions of info().components[i].
  const fulmar_component& functions(std::size_t i) const;
  /// Path of the private copy, for debuggers.
  const std::filesystem::path& copy() const { return copy_; }

  /// Unloads now, if there is no other owner. Throws Error "... is still resident after unloading" if code
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

/// Reads a plugin's entry in the calling process; used by the probing child and by `Library`. Throws Error.
PluginInfo read_entry(const fulmar_plugin& entry, const std::string& file_name);

}  // namespace fulmar::core
