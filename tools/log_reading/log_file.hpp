// SPDX-License-Identifier: BSD-3-Clause
// Check of a log's file name, and its time.
#pragma once
#include <cstdint>
#include <string>

#include "core/log/reader.hpp"

namespace fulmar::core {

/// Throws Error with the reason why the file is no log: missing, a directory, empty.
void check_log_file(const std::string& file);

/// Log time of flight time 0: from a Fulmar log's attachments, else the time of the first message.
std::uint64_t log_epoch_ns(const McapFile& log, std::uint64_t first_ns);

}  // namespace fulmar::core
