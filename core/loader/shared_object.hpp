// SPDX-License-Identifier: BSD-3-Clause
// Opens a plugin's file, for the host, its probing child and its isolated children: Boost.DLL.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "fulmar/abi.h"

namespace fulmar::core {

/// A shared object that is open in this process, with local symbols.
class SharedObject {
 public:
  SharedObject();
  ~SharedObject();

  /// Throws Error about `name`: the missing dependency of the file.
  void load(const std::filesystem::path& file, const std::string& name);
  /// Address of an exported symbol of the loaded file, nullptr without it.
  const void* find(const char* symbol) const;
  /// Entry of the loaded file. Throws Error when it is no plugin.
  const fulmar_plugin& entry(const std::string& name) const;
  void unload();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Message made from the text of the system's loader (glibc's wording, dlerror(3)): "my_law.so needs
/// libfoo.so.1, which is not there".
std::string load_fault(const std::string& name, const char* dlerror_text);

/// Whether the file is still mapped into this process. Then a second load would return the old code.
bool is_mapped(const std::filesystem::path& file);

}  // namespace fulmar::core
