// SPDX-License-Identifier: BSD-3-Clause
// The parameters of the weather: the steady wind, its profile, the turbulence, and the deviation from the
// standard atmosphere.
#pragma once
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "figures.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/sim/weather.hpp"
#include "messages.hpp"
#include "surroundings.hpp"

namespace fulmar::sim {

constexpr double full_turn = 2 * std::numbers::pi;  ///< rad

struct WindParams {
  Vector<Ned> wind_ned{{0, 0, 0}, "m/s", -50, 50, "steady velocity of the air"};
  Param wind_speed{-1, "m/s", -1, 50,
                   "speed of a steady level wind, in place of wind_ned; below 0: wind_ned is used"};
  Param wind_from{0, "rad", -full_turn, full_turn,
                  "direction from which wind_speed blows: from north, clockwise"};
  Choice<WindProfile> wind_profile{WindProfile::constant, "height profile of the steady wind", setup};
  Param wind_reference{10,   "m", 0.1, 300, "reference height of wind_ned and wind_speed in the profile",
                       setup};
  Param wind_exponent{1.0 / 7, "", 0, 1, "exponent of the power profile", setup};
  Param wind_roughness{
      0.03, "m", 1e-4, 5, "roughness length of the log profile: 0.03 grass, 0.6 trees and houses", setup};
  Choice<Turbulence> turbulence{Turbulence::none, "strength of the turbulence, Dryden model at 50 m", setup};
  Param temperature_offset{
      0, "K", -60, 60, "offset of the air temperature at every altitude; 0: standard atmosphere", setup};
  Param pressure_offset{
      0, "Pa", -10000, 10000, "offset of the air pressure at mean sea level; 0: standard atmosphere", setup};
};

/// Velocity of the air, NED, m/s: a wind from the west blows to the east.
inline Eigen::Vector3d steady_wind(const WindParams& p) {
  if (p.wind_speed < 0) return eigen(p.wind_ned.value);
  return -p.wind_speed * Eigen::Vector3d(std::cos(p.wind_from), std::sin(p.wind_from), 0);
}

inline Weather weather(const WindParams& p, const AirParams& air) {
  if (p.wind_profile == WindProfile::log && p.wind_reference <= p.wind_roughness)
    throw std::runtime_error(
        located("wind_reference",
                sim_aero_messages::wind_reference_low(figures(p.wind_reference), figures(p.wind_roughness)))
            .line());
  return {steady_wind(p),
          p.turbulence,
          {p.wind_profile, p.wind_reference, p.wind_exponent, p.wind_roughness},
          {p.temperature_offset, p.pressure_offset},
          air.turbulence_height,
          air.turbulence_wind,
          *air.thermals};
}

}  // namespace fulmar::sim
