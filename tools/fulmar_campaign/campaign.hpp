// SPDX-License-Identifier: BSD-3-Clause
// Several flights of one mission: with other seeds, repeated, or after a change.
#pragma once
#include "core/app/run_options.hpp"

namespace fulmar::core {

/// Runs the flights; prints each one and the statistics. Returns the exit code. Throws Error, and
/// CLI::ValidationError (wrong usage).
int fly_campaign(RunOptions options, const ManyOptions& many);

}  // namespace fulmar::core
