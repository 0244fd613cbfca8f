// SPDX-License-Identifier: BSD-3-Clause
// Runs `fulmar report`, the program that makes a page of a log, and waits for it.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

/// Throws Error when no report can be made: the program or its page template is missing.
void check_report_program();

/// Writes `out`, which must not exist. `result`: output of `fulmar run --json` for the flight; "" for none.
/// Waits for the program's end. Throws Error; the program prints the reason on standard error.
void make_report(const std::filesystem::path& log, const std::filesystem::path& out,
                 const std::string& result);

/// "flight.mcap" and "flight.mcap.part" -> "flight.html", in the same folder.
std::filesystem::path report_beside(const std::filesystem::path& log);

}  // namespace fulmar::core
