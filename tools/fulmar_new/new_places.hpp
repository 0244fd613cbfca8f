// SPDX-License-Identifier: BSD-3-Clause
// Places of templates, missions and SDK: in the prefix of the installation, or in the source tree.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

struct Places {
  std::filesystem::path missions, templates, include;
  std::filesystem::path prefix;  // for CMAKE_PREFIX_PATH: folder in which find_package(fulmar_sdk) searches
};

/// `program` is the running executable. Throws Error when no installation is found around it.
Places find_places(const std::filesystem::path& program);

/// The running executable.
std::filesystem::path this_program();

/// Name to call it: its bare name when the shell finds this file under it, else the whole path.
std::string program_word();

/// A path as a word of a shell command.
std::string shell_word(const std::string& text);

}  // namespace fulmar::core
