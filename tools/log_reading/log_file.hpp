// SPDX-License-Identifier: BSD-3-Clause
// A file that is named as a log, and its time.
#pragma once
#include <cstdint>
#include <string>

#include "core/log/reader.hpp"

namespace fulmar::core {

/// Throws Error that says why what is named is no log: there is none, a directory, empty.
void check_log_file(const std::string& file);

/// When flight time 0 was, in log time: what a Fulmar log says, else the first message's time.
std::uint64_t log_epoch_ns(const McapFile& log, std::uint64_t first_ns);

}  // namespace fulmar::core
