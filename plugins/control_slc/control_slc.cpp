// SPDX-License-Identifier: BSD-3-Clause
// Successive loop closure: the outer and the inner loops of a fixed-wing autopilot. Beard & McLain (2012),
// chapter 6.
#include "airspeed.hpp"
#include "autotune.hpp"
#include "inner.hpp"
#include "outer.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", slc::Outer, slc::Inner, slc::Airspeed, slc::Autotune)
