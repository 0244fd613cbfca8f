// SPDX-License-Identifier: BSD-3-Clause
// Signals for identification and for step and frequency responses, added to the commands of another
// component.
#include "attitude.hpp"
#include "guidance.hpp"
#include "surfaces.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", signal::Guidance, signal::Attitude, signal::Surfaces)
