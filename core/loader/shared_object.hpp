// SPDX-License-Identifier: BSD-3-Clause
// The one way in which the host, its probing child and its isolated children open a plugin's file: Boost.DLL.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "fulmar/abi.h"

namespace fulmar::core {

/// A shared object that is open in this process, its symbols its own.
class SharedObject {
 public:
  SharedObject();
  ~SharedObject();

  /// Throws Error with a sentence about `name`: what the file needs and does not find.
  void load(const std::filesystem::path& file, const std::string& name);
  /// Of a file that has been loaded: the address of what it exports under that name, nullptr without it.
  const void* find(const char* symbol) const;
  /// Of a file that has been loaded. Throws Error when it is no plugin.
  const fulmar_plugin& entry(const std::string& name) const;
  void unload();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A sentence made of what the system's loader says (glibc's wording, dlerror(3)): "my_law.so needs
/// libfoo.so.1, which is not there".
std::string load_fault(const std::string& name, const char* dlerror_text);

/// Whether the file is still mapped into this process, by whomever: what it holds would not be loaded anew.
bool is_mapped(const std::filesystem::path& file);

}  // namespace fulmar::core
