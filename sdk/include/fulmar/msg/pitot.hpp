// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Differential pressure of a pitot, and its indicated airspeed at sea-level density (1.225 kg/m3).
struct Pitot {
  double pressure_pa = 0;              ///< total minus static pressure; negative values are noise around
                                       ///< zero, or swapped hoses
  double indicated_airspeed_mps = 0;   ///< indicated airspeed
  double temperature_kelvin = 288.15;  ///< temperature of the sensor
};

}  // namespace fulmar
