// SPDX-License-Identifier: BSD-3-Clause
// The estimates of a flight and of its replay side by side. The host knows no state of an aircraft: who does
// is `fulmar-log`, whose table this is.
#pragma once
#include <atomic>
#include <filesystem>
#include <string>

namespace fulmar::core {

/// Output of `fulmar log compare` for estimates that differ between two logs; "" after a fault, which is
/// reported. `stop` ends it.
std::string compared_estimates(const std::filesystem::path& before, const std::filesystem::path& now,
                               bool json, const std::atomic<bool>& stop);

}  // namespace fulmar::core
