// SPDX-License-Identifier: BSD-3-Clause
// Shape of a pilot's stick.
#pragma once
#include <algorithm>
#include <cmath>

namespace fulmar {

/// Dead zone, then exponential: low gain at the centre, full throw at the end. `x` is in [-1, 1].
inline double shaped(double x, double dead_zone, double expo) {
  const double y = std::copysign(std::max(0.0, std::abs(x) - dead_zone) / (1 - dead_zone), x);
  return (1 - expo) * y + expo * y * y * y;
}

}  // namespace fulmar
