// SPDX-License-Identifier: BSD-3-Clause
// The weather: offset of the day from the standard, steady wind, and its profile over the height.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/earth/atmosphere.hpp"
#include "fulmar/flight/earth/dryden.hpp"
#include "fulmar/msg/thermals.hpp"

namespace fulmar::sim {

/// Profile of the steady wind over the height.
enum class WindProfile : std::uint8_t { constant, power, log };

/// Fraction of the steady wind at a height above the ground: 1 at the reference height, constant above 1000
/// ft, where MIL-F-8785C 3.7.3 ends its shear. Power law: E. W. Peterson, J. P. Hennessey, Journal of Applied
/// Meteorology 17 (1978) 390-394. Logarithmic law: MIL-F-8785C 3.7.3, with a roughness of 0.15 ft and 2 ft.
struct WindShear {
  static constexpr double top_m = 304.8;
  WindProfile profile = WindProfile::constant;
  double reference_m = 10;
  double exponent = 1.0 / 7;
  double roughness_m = 0.03;

  double at(double height_m) const {
    if (profile == WindProfile::constant) return 1;
    const double z = std::clamp(height_m, 0.0, top_m);
    if (profile == WindProfile::power) return std::pow(z / reference_m, exponent);
    return z > roughness_m ? std::log(z / roughness_m) / std::log(reference_m / roughness_m) : 0;
  }
};

/// Height of the turbulence: 50 m at every height, or the height of the aircraft.
enum class TurbulenceHeight : std::uint8_t { fixed, actual };

/// Wind, turbulence, thermals and the offset of the day.
struct Weather {
  Eigen::Vector3d wind_n = Eigen::Vector3d::Zero();  ///< steady wind at the reference height
  Turbulence turbulence = Turbulence::none;
  WindShear shear{};
  AirOffset offset{};
  TurbulenceHeight turbulence_height = TurbulenceHeight::fixed;
  double wind_20ft_mps = 0;  ///< above 0: sets `actual` turbulence below 1000 ft
  Thermals thermals{};
  /// Above 0: height above the ground of `fixed` turbulence (dryden_height.hpp), m.
  double fixed_height_m = 0;
  double gust_airspeed_mps = 0;  ///< above 0: airspeed of the gust filters, in place of that of the aircraft
  double gust_span_m = 0;        ///< above 0: turbulence also rotates, over a wing of this span
};

}  // namespace fulmar::sim
