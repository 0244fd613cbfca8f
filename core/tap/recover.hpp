// SPDX-License-Identifier: BSD-3-Clause
// Makes a whole log of what is left of one that was cut off.
#pragma once
#include <filesystem>

#include "core/tap/mcap.hpp"

namespace fulmar::core {

/// Reads `from`, as far as it can be read, and writes what is there to the new file `to`. Throws Error as read_mcap and McapWriter do.
McapWriter::Result recover_mcap(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace fulmar::core
