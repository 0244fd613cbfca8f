// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

namespace fulmar::core {

/// Reports to the sender: "" when accepted, else the reason. Called by the loop.
using Reply = std::function<void(const char* refusal)>;

}  // namespace fulmar::core
