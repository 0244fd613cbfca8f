// SPDX-License-Identifier: BSD-3-Clause
// Total energy control of height and airspeed, by rates and by errors, with the course hold and the take-off
// law that all outer loops share.
#include "error_law.hpp"
#include "outer.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", tecs::Outer, tecs::ErrorLaw)
