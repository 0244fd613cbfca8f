// SPDX-License-Identifier: BSD-3-Clause
// Judges a flight while it is flown.
#include "score.hpp"

using namespace fulmar::score;

FULMAR_PLUGIN("1.0.0", Score)
