// SPDX-License-Identifier: BSD-3-Clause
// Reroutes a plan around no-fly zones by a slow search, and monitors the clearance of the flight.
#include "detour.hpp"
#include "watch.hpp"

using namespace fulmar::slow_planner;

FULMAR_PLUGIN("1.0.0", Detour, Watch)
