// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/message.hpp"

namespace fulmar {

/// Magnetic field in body axes.
struct Mag {
  Vec3<Body> field_tesla;  ///< magnetic field at the sensor
};

}  // namespace fulmar
