// SPDX-License-Identifier: BSD-3-Clause
// A file before and after a change: shown as lines, and written completely.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

struct FileEdit {
  std::filesystem::path path;
  std::string name;  // displayed name
  std::string before, after;
};

/// The changed lines: "anaconda.yaml:54", then old lines with "-" and new ones with "+".
std::string diff_text(const FileEdit& edit);

/// Writes the complete file or nothing. Throws Error, also when the file has changed since it was read.
void write_edit(const FileEdit& edit);

}  // namespace fulmar::core
