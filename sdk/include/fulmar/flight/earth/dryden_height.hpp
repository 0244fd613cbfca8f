// SPDX-License-Identifier: BSD-3-Clause
// Scale lengths and standard deviations of Dryden turbulence over the height above the ground. Source:
// MIL-F-8785C 3.7.2 (medium and high altitude) and 3.7.3 (low altitude), figures 7, 10 and 11.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fulmar/flight/earth/dryden.hpp"

namespace fulmar {

namespace mil8785c {
inline constexpr double foot = 0.3048;         ///< m
inline constexpr double knot = 1852.0 / 3600;  ///< m/s
inline constexpr double lowest_ft = 10, low_top_ft = 1000, medium_base_ft = 2000;
inline constexpr double high_length_ft = 1750;  ///< 3.7.2.1, Dryden form

/// Wind at 20 ft of each strength, 3.7.3.4: 15, 30 and 45 knots.
constexpr double wind_20ft(Turbulence strength) { return 15 * knot * static_cast<double>(strength); }

/// Root mean square over altitude, figure 7, ft/s: exceeded with a probability of 1e-2 (light), 1e-3
/// (moderate) and 1e-5 (severe).
inline constexpr std::array<double, 6> altitude_ft{500, 1750, 3750, 7500, 15000, 25000};
inline constexpr std::array<std::array<double, 6>, 3> sigma_fps{
    {{6.6, 6.9, 7.4, 6.7, 4.6, 2.7}, {8.6, 9.6, 10.6, 10.1, 8.0, 6.6}, {15.6, 17.6, 23.0, 23.6, 22.1, 20.0}}};

/// Standard deviation, m/s; linear between the points of the figure, constant beyond them.
inline double high_sigma(Turbulence strength, double h_ft) {
  const auto& s = sigma_fps[static_cast<std::size_t>(strength) - 1];
  const double h = std::clamp(h_ft, altitude_ft.front(), altitude_ft.back());
  std::size_t i = 1;
  while (i + 1 < altitude_ft.size() && h > altitude_ft[i]) ++i;
  const double part = (h - altitude_ft[i - 1]) / (altitude_ft[i] - altitude_ft[i - 1]);
  return foot * (s[i - 1] + part * (s[i] - s[i - 1]));
}

/// Scales up to 1000 ft. Lengths: figure 10; standard deviations: figure 11, sigma_w = 0.1 of the wind at 20
/// ft.
inline DrydenScales low_altitude(double h_ft, double wind_20ft_mps) {
  const double h = std::clamp(h_ft, lowest_ft, low_top_ft), k = 0.177 + 0.000823 * h;
  const double L = foot * h / std::pow(k, 1.2);
  const double sigma_w = 0.1 * wind_20ft_mps, sigma_u = sigma_w / std::pow(k, 0.4);
  return {{L, L, foot * h}, {sigma_u, sigma_u, sigma_w}};
}
}  // namespace mil8785c

/// Scales at `height_m` above the ground: the low-altitude model below 1000 ft, the medium-altitude model
/// from 2000 ft on, linear in between. `wind_20ft_mps` above 0 replaces 15, 30 or 45 knots in the
/// low-altitude part.
inline DrydenScales dryden_scales_at(Turbulence strength, double height_m, double wind_20ft_mps = 0) {
  using namespace mil8785c;
  DrydenScales scales;
  if (strength == Turbulence::none) return scales;
  const double h = height_m / foot;
  const double part = std::clamp((h - low_top_ft) / (medium_base_ft - low_top_ft), 0.0, 1.0);
  scales = low_altitude(h, wind_20ft_mps > 0 ? wind_20ft_mps : wind_20ft(strength));
  if (part == 0) return scales;
  const Eigen::Vector3d L = Eigen::Vector3d::Constant(foot * high_length_ft);
  const Eigen::Vector3d sigma = Eigen::Vector3d::Constant(high_sigma(strength, std::max(h, medium_base_ft)));
  scales.length += part * (L - scales.length);
  scales.sigma += part * (sigma - scales.sigma);
  return scales;
}

}  // namespace fulmar
