// SPDX-License-Identifier: BSD-3-Clause
// `fulmar log diff`: differences between two flights.
#pragma once
#include <string>

namespace fulmar::core {

/// Compares two logs, two results of `fulmar run --json`, or one of each. Returns 0: equal, 1: different.
/// Throws Error.
int diff_command(const std::string& a, const std::string& b, bool as_json, bool messages_only);

}  // namespace fulmar::core
