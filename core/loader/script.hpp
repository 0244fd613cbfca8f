// SPDX-License-Identifier: BSD-3-Clause
// A file in another language, opened by the plugin that hosts that language. Links the C library alone:
// children open scripts too.
#pragma once
#include <filesystem>
#include <string>

#include "fulmar/abi.h"

namespace fulmar::core {

/// Name of the plugin that hosts the language of a file: "python" for "my_law.py". "" for anything else.
std::string script_host(const std::filesystem::path& file);

/// An open script. The hosting plugin must outlive it.
class Script {
 public:
  /// `host` is the entry of the hosting plugin. `text` is executed; `file`, the original path, is for
  /// messages and for files that the script loads from its folder. Throws Error.
  Script(const fulmar_plugin& host, const std::string& file, const std::string& text);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// Unchecked: see read_entry.
  const fulmar_plugin& entry() const { return *entry_; }

 private:
  const fulmar_plugin& host_;
  const fulmar_plugin* entry_ = nullptr;
};

/// The text of a script's private copy. Throws Error.
std::string read_script(const std::filesystem::path& copy);

}  // namespace fulmar::core
