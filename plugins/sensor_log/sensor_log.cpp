// SPDX-License-Identifier: BSD-3-Clause
// The sensors of a recorded flight as a vehicle.
#include "recorded.hpp"

using fulmar::sensor_log::Recorded;

FULMAR_PLUGIN("1.0.0", Recorded)
