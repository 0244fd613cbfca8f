// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Differential pressure of a pitot tube, and the indicated airspeed that it means at sea-level density
/// (1.225 kg/m3).
struct Pitot {
  double pressure_pa = 0;  ///< total minus static; negative values are noise around zero, or a swapped tube
  double indicated_airspeed_mps = 0;
  double temperature_kelvin = 288.15;  ///< of the sensor
};

}  // namespace fulmar
