// SPDX-License-Identifier: BSD-3-Clause
// A ROSflight 2 flight controller as the role `vehicle`.
#include "link/link.hpp"
#include "vehicle.hpp"

namespace fulmar::fcu {
struct FlightController : Vehicle<Link> {};
}  // namespace fulmar::fcu

FULMAR_PLUGIN("1.0.0", fulmar::fcu::FlightController)
