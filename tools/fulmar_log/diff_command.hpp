// SPDX-License-Identifier: BSD-3-Clause
// `fulmar log diff`: how two flights differ.
#pragma once
#include <string>

namespace fulmar::core {

/// Of two logs, of two results of `fulmar run --json`, or of one of each. 0: equal, 1: not. Throws Error.
int diff_command(const std::string& a, const std::string& b, bool as_json, bool messages_only);

}  // namespace fulmar::core
