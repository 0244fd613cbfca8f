// SPDX-License-Identifier: BSD-3-Clause
#include "radar_altimeter.hpp"
#include "radar_navigator.hpp"

FULMAR_PLUGIN("1.0.0", RadarAltimeter, RadarNavigator)
