// SPDX-License-Identifier: BSD-3-Clause
// Files of the installation, named from any folder as in fulmar:missions/common.yaml. So a mission can be
// copied to another folder or machine.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

bool is_shipped_name(const std::string& name);

/// Path of the file that `name` means, relative to `folder`.
std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name);

/// Its name of the form fulmar:missions/common.yaml; empty when it is no file of the installation.
std::string shipped_name(const std::filesystem::path& file);

/// Suggestion for the name of a missing file: one beside it, or one of the installation; "" when none is
/// near.
std::string file_hint(const std::filesystem::path& path, const std::string& name);

}  // namespace fulmar::core
