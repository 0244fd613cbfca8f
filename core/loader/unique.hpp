// SPDX-License-Identifier: BSD-3-Clause
// Unique symbols of a shared object (STB_GNU_UNIQUE). The system's loader keeps one instance in the process,
// even for a file loaded later that has its own. Two versions of one law would share their static data.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace fulmar::core {

/// Unique symbols that the file defines, without those of the standard library, which are equal in all files.
std::vector<std::string> unique_symbols(std::span<const std::byte> file);

}  // namespace fulmar::core
