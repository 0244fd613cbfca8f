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

/// A script that is open. Closed with the object, which the hosting plugin outlives.
class Script {
 public:
  /// `host` is the entry of the hosting plugin. `text` is what is run; `file`, where the author keeps it, is
  /// for messages and for what the script itself loads from beside it. Throws Error with a sentence.
  Script(const fulmar_plugin& host, const std::string& file, const std::string& text);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// Checked by nobody yet: see read_entry.
  const fulmar_plugin& entry() const { return *entry_; }

 private:
  const fulmar_plugin& host_;
  const fulmar_plugin* entry_ = nullptr;
};

/// The text of a script's private copy. Throws Error.
std::string read_script(const std::filesystem::path& copy);

}  // namespace fulmar::core
