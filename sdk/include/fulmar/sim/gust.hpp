// SPDX-License-Identifier: BSD-3-Clause
// A discrete gust with the shape 1 - cos. Sources: MIL-F-8785C 3.7.1.3 (rise to a constant value), CS-23.333
// (c) and CS-25.341 (a) (rise and fall).
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace fulmar::sim {

/// `pulse` rises and falls, `rise` stays at its peak.
enum class GustShape : std::uint8_t { pulse, rise };

/// A gust that `Gust::fire` starts.
struct GustSpec {
  Eigen::Vector3d velocity_b = Eigen::Vector3d::Zero();  ///< velocity of the air at the peak, body axes, m/s
  double length_m = 30;  ///< distance through the air from the edge to the peak
  GustShape shape = GustShape::pulse;
};

/// Fraction of the peak, `s` metres behind the edge.
inline double gust_part(GustShape shape, double length_m, double s) {
  if (s <= 0) return 0;
  if (s >= (shape == GustShape::pulse ? 2 : 1) * length_m) return shape == GustShape::pulse ? 0 : 1;
  return 0.5 * (1 - std::cos(std::numbers::pi * s / length_m));
}

/// One gust, from its start until the aircraft has passed it. A new one replaces it.
class Gust {
 public:
  void fire(const GustSpec& spec) {
    spec_ = spec;
    flown_m_ = 0;
    active_ = spec.velocity_b != Eigen::Vector3d::Zero();
  }
  bool active() const { return active_; }

  /// Velocity of the air after another `dt` at airspeed `Va`: the gust is fixed in the air mass.
  Eigen::Vector3d advance(double dt, double Va) {
    if (!active_) return Eigen::Vector3d::Zero();
    flown_m_ += Va * dt;
    active_ = spec_.shape == GustShape::rise || flown_m_ < 2 * spec_.length_m;
    return gust_part(spec_.shape, spec_.length_m, flown_m_) * spec_.velocity_b;
  }

 private:
  GustSpec spec_;
  double flown_m_ = 0;
  bool active_ = false;
};

}  // namespace fulmar::sim
