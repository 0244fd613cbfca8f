// SPDX-License-Identifier: BSD-3-Clause
// Angles on the circle: wrapping, differences, and a smooth step for blends.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fulmar {

/// The same angle in [-pi, pi]. An angle in this range is returned unchanged, bit for bit.
inline double wrap_pi(double angle_rad) {
  if (std::abs(angle_rad) <= std::numbers::pi) return angle_rad;
  return std::remainder(angle_rad, 2 * std::numbers::pi);
}

/// The same angle in [0, 2 pi).
inline double wrap_2pi(double angle_rad) {
  double wrapped = wrap_pi(angle_rad);
  if (wrapped < 0) wrapped += 2 * std::numbers::pi;
  return wrapped < 2 * std::numbers::pi ? wrapped : 0;  // a tiny negative angle rounds up to 2 pi
}

/// Shorter angle from `from` to `to`, in [-pi, pi], as for a course error.
inline double angle_difference(double to_rad, double from_rad) { return wrap_pi(to_rad - from_rad); }

/// 0 below `from`, 1 above `to`, between them 3 t^2 - 2 t^3: value and slope are continuous. With `from`
/// above `to` it falls.
inline double smoothly(double x, double from, double to) {
  if (from == to) return x < from ? 0 : 1;
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace fulmar
