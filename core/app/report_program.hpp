// SPDX-License-Identifier: BSD-3-Clause
// The program that makes a page of a log, `fulmar report`, for those who need the page at once.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

/// Throws Error where none can be made: the program is missing, or the page that it fills.
void check_report_program();

/// Makes `out`, which must not exist. `result`: what `fulmar run --json` prints of the flight; "" for
/// nothing. Waits for its end. Throws Error; why it failed the program has said on standard error.
void make_report(const std::filesystem::path& log, const std::filesystem::path& out,
                 const std::string& result);

/// "flight.mcap" and "flight.mcap.part" -> "flight.html", in the same folder.
std::filesystem::path report_beside(const std::filesystem::path& log);

}  // namespace fulmar::core
