// SPDX-License-Identifier: BSD-3-Clause
// Unique symbols of a shared object: of those the system's loader keeps one in the process, also for a file
// that is loaded later and has its own. Two versions of one law would share their static data.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace fulmar::core {

/// Those that the file defines, without the standard library's, which are alike in all files.
std::vector<std::string> unique_symbols(std::span<const std::byte> file);

}  // namespace fulmar::core
