// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Static pressure.
struct Baro {
  double pressure_pa = 0;              ///< absolute static pressure
  double temperature_kelvin = 288.15;  ///< temperature of the sensor, not of the air
};

}  // namespace fulmar
