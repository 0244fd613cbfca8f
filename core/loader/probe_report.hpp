// SPDX-License-Identifier: BSD-3-Clause
// What fulmar-probe tells the host, one line each. Lines of an exit without `report_good` mean that the
// plugin ended the process.
#pragma once
#include <string_view>

namespace fulmar::core {

inline constexpr std::string_view report_process = "process: ";  // that loads the plugin: its number follows
inline constexpr std::string_view report_loaded = "stage: loaded\n";
inline constexpr std::string_view report_read = "stage: read\n";
inline constexpr std::string_view report_stays = "stays mapped\n";  // after it was closed
inline constexpr std::string_view report_good = "good\n";
inline constexpr std::string_view report_fault = "fault: ";  // the sentence follows

}  // namespace fulmar::core
