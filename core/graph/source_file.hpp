// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <memory>
#include <string>

namespace fulmar::core {

struct SourceFile {
  std::filesystem::path path;  // for files that it names, relative to its folder
  std::string name;            // as written by the user; used in faults
  std::string text;
};
using FilePtr = std::shared_ptr<const SourceFile>;

}  // namespace fulmar::core
