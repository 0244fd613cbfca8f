// SPDX-License-Identifier: BSD-3-Clause
// Leads a plan round no-fly zones by a search that takes its time, and watches that the flight keeps out of
// them.
#include "detour.hpp"
#include "watch.hpp"

using namespace fulmar::slow_planner;

FULMAR_PLUGIN("1.0.0", Detour, Watch)
