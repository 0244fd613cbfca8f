// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <memory>
#include <string>

namespace fulmar::core {

struct SourceFile {
  std::filesystem::path path;  // to open what the file names, relative to its folder
  std::string name;            // as people wrote it: what faults say
  std::string text;
};
using FilePtr = std::shared_ptr<const SourceFile>;

}  // namespace fulmar::core
