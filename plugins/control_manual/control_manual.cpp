// SPDX-License-Identifier: BSD-3-Clause
// Pilot commands within the autopilot: from surfaces to increments of course, height and airspeed, each axis
// separately.
#include "guide.hpp"
#include "inner.hpp"
#include "outer.hpp"
#include "pilot.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", manual::Outer, manual::Guide, manual::Inner, manual::Pilot)
