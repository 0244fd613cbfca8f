// SPDX-License-Identifier: BSD-3-Clause
// A simulated aircraft (Beard & McLain, chapters 3, 4, 7), and its truth as navigation state. See README.md.
#include "aircraft.hpp"
#include "truth_state.hpp"

FULMAR_PLUGIN("1.0.0", fulmar::sim::Aircraft, fulmar::sim::TruthState)
