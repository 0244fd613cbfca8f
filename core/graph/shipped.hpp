// SPDX-License-Identifier: BSD-3-Clause
// Files that come with the installation, named from anywhere as in fulmar:missions/common.yaml: so a mission
// can be copied to another folder or machine.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

bool is_shipped_name(const std::string& name);

/// The file that `name` means to who stands in `folder`.
std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name);

/// Its name from anywhere, fulmar:missions/common.yaml; empty when it is no file of the installation.
std::string shipped_name(const std::filesystem::path& file);

/// What there is in place of a shipped file that is not there; empty when `name` is no name of one.
std::string shipped_choices(const std::string& name);

}  // namespace fulmar::core
