// SPDX-License-Identifier: BSD-3-Clause
// The build that `--watch --build` runs.
#pragma once
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace fulmar::core {

/// Source files (.cpp .cc .c .hpp .h .py CMakeLists.txt) below a folder, without hidden folders and build
/// folders.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& folder);

/// Runs a command of the user through the shell, with its output on standard error. Returns true when it
/// exits with 0. When `interrupted`, it is ended with all its children.
bool run_build(const std::string& command, const std::atomic<int>& interrupted);

}  // namespace fulmar::core
