// SPDX-License-Identifier: BSD-3-Clause
// Thermals: Gaussian over the radius; over the height the updraft of a convective layer, w / w* =
// (z/zi)^(1/3) (1 - 1.1 z/zi). Sources: D. H. Lenschow, P. L. Stephens, Boundary-Layer Meteorology 19 (1980)
// 509-532, as in M. J. Allen, Updraft Model for Development of Autonomous Soaring Uninhabited Air Vehicles,
// AIAA 2006-1510.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fulmar/msg/thermals.hpp"

namespace fulmar::sim {

/// Fraction of the strongest updraft at the height `z`, a fraction of the layer: 1 at z = 1 / 4.4, 0 at the
/// ground and from 1 / 1.1 on.
inline double updraft_over_height(double z) {
  constexpr double strongest = 1 / 4.4;
  if (z <= 0 || z >= 1 / 1.1) return 0;
  const auto shape = [](double zeta) { return std::cbrt(zeta) * (1 - 1.1 * zeta); };
  return shape(z) / shape(strongest);
}

/// The thermals of a `Thermals` message; those with `drifts` move with the steady wind.
class Updrafts {
 public:
  Updrafts() = default;
  explicit Updrafts(const Thermals& t) : thermals_(t) {}
  bool any() const { return thermals_.thermals.count > 0; }

  /// Moves the axes by `dt`.
  void drift(double dt, const Eigen::Vector3d& steady_wind_n) {
    for (std::uint32_t i = 0; i < thermals_.thermals.count; ++i) {
      Thermal& t = thermals_.thermals.items[i];
      if (!t.drifts) continue;
      t.north_m += dt * steady_wind_n.x();
      t.east_m += dt * steady_wind_n.y();
    }
  }

  /// Updraft, m/s, at a place by north, east and down.
  double at(const Eigen::Vector3d& p_n) const {
    double up = 0;
    for (std::uint32_t i = 0; i < thermals_.thermals.count; ++i) {
      const Thermal& t = thermals_.thermals.items[i];
      const double n = p_n.x() - t.north_m, e = p_n.y() - t.east_m;
      const double part = (n * n + e * e) / (t.radius_m * t.radius_m);
      if (part < 40) up += t.strength_mps * updraft_over_height(-p_n.z() / t.top_m) * std::exp(-part);
    }
    return up;
  }

 private:
  Thermals thermals_;
};

}  // namespace fulmar::sim
