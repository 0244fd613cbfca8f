// SPDX-License-Identifier: BSD-3-Clause
// Folders of Fulmar's own files: their bin/ and lib/fulmar hold its programs and plugins.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace fulmar::core {

/// The folder of the running program first. When the host is a library inside another program, the folder of
/// the library follows.
std::vector<std::filesystem::path> home_folders();

/// Whether the file is executable.
bool can_run(const std::filesystem::path& file);

/// A program of the host, such as "fulmar-probe": the path in the environment's `variable`, else beside the
/// running program, or in bin/ of a home folder. Empty when it is missing.
std::filesystem::path own_program(const std::string& name, const char* variable = "");

/// Folder of the page that a flight serves to a browser, share/fulmar/web of a home folder. Empty when Fulmar
/// was built without it.
std::filesystem::path page_folder();

/// The folders of FULMAR_PLUGIN_PATH (separated by ':'), then lib/fulmar of each home folder.
std::vector<std::filesystem::path> plugin_folders();

}  // namespace fulmar::core
