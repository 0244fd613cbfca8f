// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// One sample of an inertial measurement unit, in body axes at the centre of gravity.
struct Imu {
  Vec3<Body> specific_force_mps2;      ///< specific force, as an accelerometer measures it: (0, 0, -9.81) at
                                       ///< rest and level
  Vec3<Body> rate_radps;               ///< body rate
  double temperature_kelvin = 288.15;  ///< temperature of the sensor
};

}  // namespace fulmar
