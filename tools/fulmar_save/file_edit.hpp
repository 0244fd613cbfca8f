// SPDX-License-Identifier: BSD-3-Clause
// A file before and after a change: shown as lines, and written whole.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

struct FileEdit {
  std::filesystem::path path;
  std::string name;  // for people
  std::string before, after;
};

/// The lines that change, with those that replace them: "anaconda.yaml:54" and "-", "+".
std::string diff_text(const FileEdit& edit);

/// All of the file or nothing. Throws Error, also when the file has changed since it was read.
void write_edit(const FileEdit& edit);

}  // namespace fulmar::core
