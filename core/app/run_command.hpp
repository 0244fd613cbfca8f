// SPDX-License-Identifier: BSD-3-Clause
// `fulmar run`: one flight and its restarts.
#pragma once
#include "core/app/run_options.hpp"

namespace fulmar::core {

/// Flies; prints progress, then a table or JSON. Returns the exit code.
int run_command(const RunOptions& options);

}  // namespace fulmar::core
