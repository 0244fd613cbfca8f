// SPDX-License-Identifier: BSD-3-Clause
// Several flights of one mission: with other seeds, repeated, or with what has changed.
#pragma once
#include "core/app/run_options.hpp"

namespace fulmar::core {

/// Flies; prints each flight and what they have in common. Returns the exit code. Throws Error, and
/// CLI::ValidationError (wrong usage).
int fly_campaign(RunOptions options, const ManyOptions& many);

}  // namespace fulmar::core
