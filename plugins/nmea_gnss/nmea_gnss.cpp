// SPDX-License-Identifier: BSD-3-Clause
// A satellite receiver on a serial port of the companion computer, its simulated twin, and a comparison with
// the estimate.
#include "compare.hpp"
#include "receiver.hpp"
#include "twin.hpp"

using namespace fulmar::nmea;

FULMAR_PLUGIN("1.0.0", Receiver, Twin, Compare)
