// SPDX-License-Identifier: BSD-3-Clause
// Where Fulmar's own files lie: the folders whose bin/ and lib/fulmar hold its programs and plugins.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace fulmar::core {

/// That of the running program first; then, when the host is a library inside another program, that of the
/// library.
std::vector<std::filesystem::path> home_folders();

/// Whether it is a file that may be executed.
bool can_run(const std::filesystem::path& file);

/// A program that belongs to the host, "fulmar-probe": what the environment's `variable` says, else beside
/// the running program, or in bin/ of a home folder. Empty when it is missing.
std::filesystem::path own_program(const std::string& name, const char* variable = "");

/// The folder of the page that a browser gets from a flight, share/fulmar/web of a home folder. Empty when
/// Fulmar was built without it.
std::filesystem::path page_folder();

/// The folders of FULMAR_PLUGIN_PATH (separated by ':'), then lib/fulmar of each home folder.
std::vector<std::filesystem::path> plugin_folders();

}  // namespace fulmar::core
