// SPDX-License-Identifier: BSD-3-Clause
// International Standard Atmosphere, ISO 2533:1975: troposphere and lower stratosphere, to 20 km. Altitudes
// are geopotential, above mean sea level. Below 5 km the geometric altitude is higher by less than 0.08 %,
// which may be neglected, or converted with `geopotential_altitude`.
#pragma once
#include <cmath>
#include <limits>

namespace fulmar {

namespace isa {
inline constexpr double g0 = 9.80665;                                 ///< m/s2
inline constexpr double gas_constant = 287.05287;                     ///< J/(kg K), of dry air
inline constexpr double sea_level_temperature = 288.15;               ///< K
inline constexpr double sea_level_pressure = 101325;                  ///< Pa
inline constexpr double sea_level_density = 1.225;                    ///< kg/m3; with all digits 1.2250000181
inline constexpr double lapse_rate = 0.0065;                          ///< K/m
inline constexpr double tropopause = 11000;                           ///< m
inline constexpr double exponent = g0 / (gas_constant * lapse_rate);  ///< 5.25588
inline constexpr double earth_radius = 6356766;  ///< m, nominal, for geopotential altitudes
}  // namespace isa

/// State of the air. `S` is double, or Dual for derivatives by the altitude.
template <class S>
struct AirOf {
  S pressure_pa = isa::sea_level_pressure;
  S temperature_kelvin = isa::sea_level_temperature;
  S density_kgm3 = isa::sea_level_density;

  S speed_of_sound_mps() const {
    using std::sqrt;
    return sqrt(1.4 * isa::gas_constant * temperature_kelvin);
  }
};
using Air = AirOf<double>;

/// Density, kg/m3, of dry air as an ideal gas.
inline double air_density(double pressure_pa, double temperature_kelvin) {
  return pressure_pa / (isa::gas_constant * temperature_kelvin);
}

/// Difference of a day from the standard: temperature at every altitude, pressure at mean sea level.
struct AirOffset {
  double temperature_kelvin = 0, pressure_pa = 0;
};

/// Geopotential altitude, m, of a geometric one: that of equal air under constant gravity. U.S. Standard
/// Atmosphere 1976 (18).
inline double geopotential_altitude(double geometric_m) {
  return isa::earth_radius * geometric_m / (isa::earth_radius + geometric_m);
}

/// `standard_air` over the scalar `S`. `altitude_m`: geopotential, above mean sea level.
template <class S>
AirOf<S> standard_air_of(const S& altitude_m, const AirOffset& offset = {}) {
  using std::exp, std::pow;
  AirOf<S> air;
  if (altitude_m <= isa::tropopause) {
    const double T0 = isa::sea_level_temperature + offset.temperature_kelvin;
    air.temperature_kelvin = T0 - isa::lapse_rate * altitude_m;
    air.pressure_pa =
        (isa::sea_level_pressure + offset.pressure_pa) * pow(air.temperature_kelvin / T0, isa::exponent);
  } else {
    const AirOf<S> below = standard_air_of(S(isa::tropopause), offset);
    air.temperature_kelvin = below.temperature_kelvin;
    air.pressure_pa = below.pressure_pa * exp(-isa::g0 * (altitude_m - isa::tropopause) /
                                              (isa::gas_constant * air.temperature_kelvin));
  }
  air.density_kgm3 = air.pressure_pa / (isa::gas_constant * air.temperature_kelvin);
  return air;
}

/// Standard air at an altitude above mean sea level. With an offset, the air in hydrostatic equilibrium with
/// it: warm air has higher layers of equal pressure.
inline Air standard_air(double altitude_m, const AirOffset& offset = {}) {
  return standard_air_of(altitude_m, offset);
}

/// Density of the standard air, recomputed after a change of altitude by a metre. Accurate to 1e-4, for laws
/// that need it in each step.
class NearbyDensity {
 public:
  double at(double altitude_m) {
    if (!(std::abs(altitude_m - altitude_m_) < 1)) {  // false for the initial NaN
      altitude_m_ = altitude_m;
      density_kgm3_ = standard_air(altitude_m).density_kgm3;
    }
    return density_kgm3_;
  }

 private:
  double altitude_m_ = std::numeric_limits<double>::quiet_NaN(), density_kgm3_ = isa::sea_level_density;
};

/// Altitude at which the standard air has this pressure: the inverse of `standard_air`. The pressure must be
/// positive.
inline double pressure_altitude(double pressure_pa) {
  const double altitude_m = isa::sea_level_temperature / isa::lapse_rate *
                            (1 - std::pow(pressure_pa / isa::sea_level_pressure, 1 / isa::exponent));
  if (altitude_m <= isa::tropopause) return altitude_m;
  const Air below = standard_air(isa::tropopause);
  return isa::tropopause +
         isa::gas_constant * below.temperature_kelvin / isa::g0 * std::log(below.pressure_pa / pressure_pa);
}

/// Indicated airspeed of a differential pressure: incompressible, at sea-level density. A negative pressure
/// gives a negative speed.
inline double indicated_airspeed(double pressure_pa) {
  return std::copysign(std::sqrt(2 * std::abs(pressure_pa) / isa::sea_level_density), pressure_pa);
}

/// True airspeed of an indicated airspeed.
inline double true_airspeed(double indicated_mps, double density_kgm3) {
  return indicated_mps * std::sqrt(isa::sea_level_density / density_kgm3);
}

}  // namespace fulmar
