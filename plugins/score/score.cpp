// SPDX-License-Identifier: BSD-3-Clause
// Evaluates a flight while it runs.
#include "score.hpp"

using namespace fulmar::score;

FULMAR_PLUGIN("1.0.0", Score)
