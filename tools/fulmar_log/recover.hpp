// SPDX-License-Identifier: BSD-3-Clause
// Makes a complete log of the remains of one that was cut off or damaged.
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
  std::string fault;       // "" or the reason why the reading ended
  bool was_whole = false;  // the log is complete

  std::string left_out_text() const;  // "2 damaged chunks, 1 damaged attachment"; "": none
};

/// Copies the undamaged parts of `from` to the new file `to`; a complete log is not copied. Throws Error as
/// McapStream and McapWriter do, without any undamaged part, and for a file that is still being written.
Recovery recover_log(const std::filesystem::path& from, const std::filesystem::path& to);

/// The same for a file that is opened twice and may have grown in between: the copy ends at the first message
/// that is new. `name`: the log in the refusal.
Recovery recover_log(McapStream& first, McapStream& second, const std::filesystem::path& to,
                     const std::string& name = "");

/// The same; returns the result of the writer.
McapWriter::Result recover_mcap(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace fulmar::core
