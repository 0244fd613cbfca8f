// SPDX-License-Identifier: BSD-3-Clause
// The build that `--watch --build` runs.
#pragma once
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace fulmar::core {

/// Source files (.cpp .cc .c .hpp .h .py CMakeLists.txt) below a folder; hidden folders and build folders are
/// passed over.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& folder);

/// Runs a command of the user's through the shell, its output on standard error. True when it exits with 0;
/// ended, with all that it has begun, when `interrupted`.
bool run_build(const std::string& command, const std::atomic<int>& interrupted);

}  // namespace fulmar::core
