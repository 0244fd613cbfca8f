// SPDX-License-Identifier: BSD-3-Clause
// Makes a whole log of what is left of one that was cut off or damaged.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/log/mcap.hpp"
#include "core/log/reader.hpp"
#include "tools/fulmar_log/salvage.hpp"

namespace fulmar::core {

struct Recovery {
  McapWriter::Result written;
  LeftOut left_out;
  std::string fault;       // "" or why the reading ended
  bool was_whole = false;  // there was nothing to recover

  std::string left_out_text() const;  // "2 damaged chunks, 1 damaged attachment"; "": nothing
};

/// Reads `from` without what is damaged, and writes what is there to the new file `to`, or nothing when there
/// is nothing. Throws Error as McapStream and McapWriter do, when nothing is left, and for a file that is
/// still being written.
Recovery recover_log(const std::filesystem::path& from, const std::filesystem::path& to);

/// The same of a file that is opened twice, and may have grown in between: the first message that the first
/// reading did not foresee ends it.
Recovery recover_log(McapStream& first, McapStream& second, const std::filesystem::path& to);

/// The same; what was written.
McapWriter::Result recover_mcap(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace fulmar::core
