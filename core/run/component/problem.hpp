// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/abi.h"

namespace fulmar::core {

/// Writes a formatted sentence, cut to the room of `problem`.
[[gnu::format(printf, 2, 3)]] void put_problem(fulmar_error& problem, const char* format, ...) noexcept;

}  // namespace fulmar::core
