// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the estimates of a flight and of its replay. The host has no notion of a state: the table
// comes from `fulmar-log`.
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
