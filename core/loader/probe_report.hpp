// SPDX-License-Identifier: BSD-3-Clause
// Report of fulmar-probe to the host, one line each. Lines of an exit without `report_good` mean that the
// plugin ended the process.
#pragma once
#include <string_view>

namespace fulmar::core {

inline constexpr std::string_view report_process = "process: ";  // the plugin's loader process; its number
                                                                 // follows
inline constexpr std::string_view report_loaded = "stage: loaded\n";
inline constexpr std::string_view report_read = "stage: read\n";
inline constexpr std::string_view report_stays = "stays mapped\n";  // after it was closed
inline constexpr std::string_view report_good = "good\n";
inline constexpr std::string_view report_fault = "fault: ";  // the message follows

}  // namespace fulmar::core
