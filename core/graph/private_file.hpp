// SPDX-License-Identifier: BSD-3-Clause
// Rejects unsafe plugin files. A plugin is code that runs with the rights of its user.
#pragma once
#include <filesystem>

namespace fulmar::core {

/// Throws Error when another user than this one and root could have written the file: it is writable by all,
/// lies in a folder where all may replace it, or belongs to another user.
void check_private_file(const std::filesystem::path& file);

}  // namespace fulmar::core
