// SPDX-License-Identifier: BSD-3-Clause
// Total energy control of height and airspeed, with the course hold and the take-off law that all outer loops
// share.
#include "outer.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", tecs::Outer)
