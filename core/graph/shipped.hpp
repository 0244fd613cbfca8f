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

/// What may be meant by the name of a file that is not there: one beside it, or one of the installation; ""
/// when none is near.
std::string file_hint(const std::filesystem::path& path, const std::string& name);

}  // namespace fulmar::core
